#include "cli/report/tables/report_tables.h"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/report/number_text.h"
#include "cli/report/plot.h"

namespace errmap::report {
namespace {

std::string ErrorHead(const ReportView& view, const std::string& what) {
  return WithUnit(what, view.shown_unit);
}

double ShareOf(const std::optional<models::BiasRecord>& bias) {
  return bias ? kPercent * bias->explained : models::kNotKnown;
}

Cell TestOf(const std::optional<models::BiasRecord>& bias) {
  if (!bias) return {};
  return Statistic{bias->test.value.f, bias->test.value.p};
}

void MarkIfRecommended(const ReportView& view,
                       const std::string& model,
                       Table* table) {
  if (model == view.recommended) table->marked = table->rows.size();
}

void SayIfEmpty(const std::string& why, Table* table) {
  if (table->rows.empty()) table->missing = why;
}

// A row of each model that has results under the hold-out.
using RowOf = std::vector<Cell>(const std::string& model,
                                const ResultRecord& result);

void AddRowsOfModels(const ReportView& view,
                     const std::string& holdout,
                     RowOf* row_of,
                     Table* table) {
  for (const ModelRecord* model : view.models) {
    const ResultRecord* const result = ResultOf(*model, holdout);
    if (result == nullptr) continue;
    MarkIfRecommended(view, model->name, table);
    table->rows.push_back(row_of(model->name, *result));
  }
  SayIfEmpty("No model has results under this hold-out.", table);
}

std::vector<Cell> ErrorsRow(const std::string& model,
                            const ResultRecord& result) {
  const models::MetricsRecord& test = result.test;
  std::vector<Cell> row{model, test.n};
  for (const double value : {test.mean,
                             test.sd,
                             test.min,
                             test.max,
                             test.range,
                             test.rmse,
                             test.mae}) {
    row.push_back(Error{value});
  }
  row.push_back(Fixed{test.r2, 4});
  row.push_back(Error{result.train.rmse});
  return row;
}

std::vector<Cell> NormalityRow(const std::string& model,
                               const ResultRecord& result) {
  const models::NormalityRecord& tests = result.normality;
  return {model,
          Statistic{tests.ks.d, tests.ks.p_given},
          Statistic{tests.lilliefors.d, tests.lilliefors.p},
          Statistic{tests.shapiro_wilk.w, tests.shapiro_wilk.p},
          Statistic{tests.anderson_darling.a2, tests.anderson_darling.p},
          Statistic{tests.jarque_bera.jb, tests.jarque_bera.p},
          Number{tests.ppcc.lambda, 3},
          Number{tests.ppcc.r_max},
          Number{tests.ppcc.r_normal},
          Number{tests.skewness, 3},
          Number{tests.kurtosis, 3}};
}

std::vector<Cell> IndependenceRow(const std::string& model,
                                  const ResultRecord& result) {
  const models::RandomnessRecord& tests = result.randomness;
  const models::SerialRecord& order = tests.in_order;
  const auto& spread = tests.breusch_pagan;
  return {
      model,
      Statistic{order.runs.test.value.z, order.runs.test.value.p},
      Statistic{order.lag1.test.value.r, order.lag1.test.value.p},
      Statistic{order.durbin_watson.d, order.durbin_watson.p},
      Statistic{order.ljung_box.test.value.q, order.ljung_box.test.value.p},
      Number{ShareOf(tests.by_group), 3},
      TestOf(tests.by_group),
      Number{ShareOf(tests.by_position), 3},
      TestOf(tests.by_position),
      spread ? Statistic{spread->test.value.lm, spread->test.value.p} : Cell()};
}

}  // namespace

Table GapTable(const ReportView& view) {
  Table table{.title = "What knowing the neighbours is worth"};
  table.error = ErrorTextOf(view);
  const models::GapRecord gap =
      view.component->gap.value_or(models::GapRecord());
  table.columns = {{"model", false},
                   {ErrorHead(view, gap.neighbours + " RMSE")},
                   {ErrorHead(view, gap.unseen + " RMSE")},
                   {"ratio"},
                   {"flattered", false}};
  for (const ModelRecord* viewed : view.models) {
    for (const models::GapModelRecord& model : gap.models) {
      if (model.model != viewed->name) continue;
      MarkIfRecommended(view, viewed->name, &table);
      table.rows.push_back({viewed->name,
                            Error{model.neighbours_rmse},
                            Error{model.unseen_rmse},
                            Number{model.ratio, 3},
                            model.flatters ? "yes" : "no"});
    }
  }
  SayIfEmpty(
      "There is no gap to show: it needs a hold-out of neighbours and one of "
      "whole groups.",
      &table);
  return table;
}

Table ComparisonTable(const ReportView& view, const std::string& holdout) {
  Table table{.title = "Differences from the recommended model, " + holdout};
  table.error = ErrorTextOf(view);
  table.note =
      "Difference of RMSE, other model less the recommended one, with its 95 % "
      "interval; one mean loss difference per unit of analysis. All pairs are "
      "in results.json.";
  table.columns = {{"other model", false},
                   {ErrorHead(view, "difference")},
                   {"p", true, "sign-flip permutation"},
                   {"p (Holm)"},
                   {"p Wilcoxon"},
                   {"p corrected t", true, "Nadeau and Bengio"},
                   {"p Diebold-Mariano"},
                   {"units"},
                   {"lag-1", true, "correlation of one unit with the next"},
                   {"established", false}};
  for (const ModelRecord* model : view.models) {
    if (model->name == view.recommended) continue;
    const models::PairRecord* pair =
        FindPair(*view.component, holdout, view.recommended, model->name);
    if (pair == nullptr) continue;
    // The pair may stand the other way round.
    const double sign = pair->a == view.recommended ? 1.0 : -1.0;
    const double difference = sign * (pair->rmse_b - pair->rmse_a);
    // The interval is that of "difference", whichever way that was taken.
    const bool same = pair->difference * difference >= 0.0;
    const models::IntervalRecord interval =
        same ? pair->ci95
             : models::IntervalRecord{-pair->ci95[1], -pair->ci95[0]};
    const auto p_of = [](const std::optional<models::MeanTestRecord>& test) {
      return P{test ? test->p : models::kNotKnown};
    };
    table.rows.push_back({model->name,
                          Interval{interval, difference},
                          P{pair->p},
                          P{pair->p_holm},
                          P{pair->tests.wilcoxon.p},
                          p_of(pair->tests.corrected_t),
                          p_of(pair->tests.diebold_mariano),
                          pair->units,
                          Number{pair->lag1, 2},
                          pair->established ? "yes" : "no"});
  }
  SayIfEmpty("Differences between models were not tested.", &table);
  return table;
}

Table StabilityTable(const ReportView& view) {
  Table table{.title = "Would other cuts choose the same?"};
  table.columns = {
      {"hold-out", false}, {"repeats"}, {"model", false}, {"share of wins, %"}};
  for (const models::StabilityRecord& entry : view.component->stability) {
    for (const models::WinRecord& win : entry.wins) {
      table.rows.push_back({entry.holdout,
                            entry.repeats,
                            win.model,
                            Number{kPercent * win.share, 3}});
    }
  }
  SayIfEmpty(
      "The groups were cut once only; --holdout groups:5:repeats=20 tells how "
      "stable the choice is.",
      &table);
  return table;
}

Table ResidualTable(const ReportView& view, const std::string& holdout) {
  Table table{.title = "Residual statistics, " + holdout};
  table.error = ErrorTextOf(view);
  table.note = fmt::format(
      "Residual = measured - predicted on the rows held out, sd with n - 1{}. "
      "R2 is about the training rows' mean.",
      view.shown_unit.empty() ? "" : ", in " + view.shown_unit);
  table.columns = {{"model", false},
                   {"rows"},
                   {"mean"},
                   {"sd"},
                   {"min"},
                   {"max"},
                   {"range"},
                   {"RMSE"},
                   {"MAE"},
                   {"R2"},
                   {"training RMSE"}};
  AddRowsOfModels(view, holdout, ErrorsRow, &table);
  return table;
}

Table SinceStartTable(const ReportView& view) {
  constexpr double kMinute = 60.0;
  Table table{.title = "Error since the start of a session, " +
                       view.recommended + ", " + view.decisive};
  table.columns = {{"from, min"}, {"to, min"}, {"rows"}, {"mean"}, {"RMSE"}};
  if (view.component->recommendation) {
    for (const models::SinceStartRecord& part :
         view.component->recommendation->since_start) {
      table.rows.push_back({Number{part.from / kMinute, 3},
                            Number{part.until / kMinute, 3},
                            part.n,
                            Error{part.mean},
                            Error{part.rmse}});
    }
  }
  return table;
}

Table NormalityTable(const ReportView& view, const std::string& holdout) {
  Table table{.title = "Are the residuals normal? " + holdout};
  table.note =
      "Statistic and p. The p of Eq. 140 takes mean and sd as given though "
      "they were estimated: Lilliefors' is the right one.";
  table.columns = {{"model", false},
                   {"K-S D (p of Eq. 140)"},
                   {"Lilliefors (p)"},
                   {"Shapiro-Wilk (p)"},
                   {"Anderson-Darling (p)"},
                   {"Jarque-Bera (p)"},
                   {"PPCC lambda"},
                   {"PPCC r"},
                   {"r normal"},
                   {"skewness"},
                   {"kurtosis"}};
  AddRowsOfModels(view, holdout, NormalityRow, &table);
  return table;
}

Table IndependenceTable(const ReportView& view, const std::string& holdout) {
  Table table{.title = "Are the residuals random? " + holdout};
  table.note =
      "Statistic and p, in the file's order; then the share of the residuals' "
      "variance that lies between groups and between positions.";
  table.columns = {{"model", false},
                   {"runs z (p)"},
                   {"lag-1 r (p)"},
                   {"Durbin-Watson (p)"},
                   {"Ljung-Box (p)"},
                   {"between groups, %"},
                   {"F (p)"},
                   {"between positions, %"},
                   {"F (p)"},
                   {"Breusch-Pagan (p)"}};
  AddRowsOfModels(view, holdout, IndependenceRow, &table);
  return table;
}

}  // namespace errmap::report
