#include "cli/report/tables/report_tables.h"

#include <vector>

#include <fmt/format.h>

#include "cli/report/number_text.h"
#include "cli/report/plot.h"
#include "stats/error_metrics.h"

namespace errmap::report {
namespace {

using Named = Table::Named;

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

// A row of each model that has results under the hold-out.
using RowOf = std::vector<Named>(const std::string& model,
                                 const ResultRecord& result);

void AddRowsOfModels(const ReportView& view,
                     const std::string& holdout,
                     RowOf* row_of,
                     Table* table) {
  for (const ModelRecord* model : view.models) {
    const ResultRecord* const result = ResultOf(*model, holdout);
    if (result == nullptr) continue;
    MarkIfRecommended(view, model->name, table);
    table->Add(row_of(model->name, *result));
  }
  table->SayIfEmpty("No model has results under this hold-out.");
}

std::vector<Named> ErrorsRow(const std::string& model,
                             const ResultRecord& result) {
  const stats::ErrorMetrics& test = result.test;
  return {{{"model", false}, model},
          {{"rows"}, test.n},
          {{"mean"}, Error{test.mean}},
          {{"sd"}, Error{test.sd}},
          {{"min"}, Error{test.min}},
          {{"max"}, Error{test.max}},
          {{"range"}, Error{test.range}},
          {{"RMSE"}, Error{test.rmse}},
          {{"MAE"}, Error{test.mae}},
          {{"R2"}, Fixed{test.r2, 4}},
          {{"training RMSE"}, Error{result.train.rmse}}};
}

std::vector<Named> NormalityRow(const std::string& model,
                                const ResultRecord& result) {
  const models::NormalityRecord& tests = result.normality;
  return {
      {{"model", false}, model},
      {{"K-S D (p of Eq. 140)"}, Statistic{tests.ks.d, tests.ks.p_given}},
      {{"Lilliefors (p)"}, Statistic{tests.lilliefors.d, tests.lilliefors.p}},
      {{"Shapiro-Wilk (p)"},
       Statistic{tests.shapiro_wilk.w, tests.shapiro_wilk.p}},
      {{"Anderson-Darling (p)"},
       Statistic{tests.anderson_darling.a2, tests.anderson_darling.p}},
      {{"Jarque-Bera (p)"},
       Statistic{tests.jarque_bera.jb, tests.jarque_bera.p}},
      {{"PPCC lambda"}, Number{tests.ppcc.lambda, 3}},
      {{"PPCC r"}, Number{tests.ppcc.r_max}},
      {{"r normal"}, Number{tests.ppcc.r_normal}},
      {{"skewness"}, Number{tests.skewness, 3}},
      {{"kurtosis"}, Number{tests.kurtosis, 3}}};
}

std::vector<Named> IndependenceRow(const std::string& model,
                                   const ResultRecord& result) {
  const models::RandomnessRecord& tests = result.randomness;
  const models::SerialRecord& order = tests.in_order;
  const auto& spread = tests.breusch_pagan;
  return {
      {{"model", false}, model},
      {{"runs z (p)"},
       Statistic{order.runs.test.value.z, order.runs.test.value.p}},
      {{"lag-1 autocorrelation (p)"},
       Statistic{order.lag1.test.value.r, order.lag1.test.value.p}},
      {{"Durbin-Watson (p)"},
       Statistic{order.durbin_watson.d, order.durbin_watson.p}},
      {{"Ljung-Box (p)"},
       Statistic{order.ljung_box.test.value.q, order.ljung_box.test.value.p}},
      {{"between groups, %"}, Number{ShareOf(tests.by_group), 3}},
      {{"F (p)"}, TestOf(tests.by_group)},
      {{"between positions, %"}, Number{ShareOf(tests.by_position), 3}},
      {{"F (p)"}, TestOf(tests.by_position)},
      {{"Breusch-Pagan (p)"},
       spread ? Statistic{spread->test.value.lm, spread->test.value.p}
              : Cell()}};
}

}  // namespace

Table GapTable(const ReportView& view) {
  Table table{.title = "The gain from known neighbours"};
  table.error = ErrorTextOf(view);
  const models::InterpolationGap gap =
      view.component->gap.value_or(models::InterpolationGap());
  for (const ModelRecord* viewed : view.models) {
    for (const models::InterpolationGap::Row& model : gap.models) {
      if (model.model != viewed->name) continue;
      MarkIfRecommended(view, viewed->name, &table);
      table.Add(
          {{{"model", false}, viewed->name},
           {{ErrorHead(view, gap.neighbours + " RMSE")},
            Error{model.neighbours_rmse}},
           {{ErrorHead(view, gap.unseen + " RMSE")}, Error{model.unseen_rmse}},
           {{"ratio"}, Number{model.ratio, 3}},
           {{"flattered", false}, model.flatters ? "yes" : "no"}});
    }
  }
  table.SayIfEmpty(
      "There is no gap to show: it needs a hold-out of neighbours and one of "
      "whole groups.");
  return table;
}

Table ComparisonTable(const ReportView& view, const std::string& holdout) {
  Table table{.title = "Differences from the recommended model, " + holdout};
  table.error = ErrorTextOf(view);
  table.note =
      "Difference of RMSE, other model minus the recommended one, with its 95 "
      "% "
      "interval; one mean loss difference per unit of analysis. p (Holm) is "
      "one-sided against a baseline, p is two-sided. All pairs are "
      "in results.json.";
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
    table.Add(
        {{{"other model", false}, model->name},
         {{ErrorHead(view, "difference")}, Interval{interval, difference}},
         {{"p", true, "sign-flip test"}, P{pair->p}},
         {{"p (Holm)", true, "- if the units are too few for so many pairs"},
          CorrectedP(*pair)},
         {{"p Wilcoxon"}, P{pair->tests.wilcoxon.p}},
         {{"p corrected t", true, "Nadeau and Bengio"},
          p_of(pair->tests.corrected_t)},
         {{"p Diebold-Mariano"}, p_of(pair->tests.diebold_mariano)},
         {{"units"}, pair->units},
         {{"lag-1 autocorrelation"}, Number{pair->lag1, 2}},
         {{"established", false},
          pair->established
              ? "yes"
              : fmt::format("no: {}", models::ToString(pair->confidence))}});
  }
  table.SayIfEmpty("Differences between models were not tested.");
  return table;
}

Table StabilityTable(const ReportView& view) {
  Table table{.title = "Would other splits choose the same?"};
  for (const models::StabilityRecord& entry : view.component->stability) {
    for (const models::WinShare& win : entry.wins) {
      table.Add({{{"hold-out", false}, entry.holdout},
                 {{"repeats"}, entry.repeats},
                 {{"model", false}, win.model},
                 {{"share of wins, %"}, Number{kPercent * win.share, 3}}});
    }
  }
  table.SayIfEmpty(
      "The groups were split only once; --holdout groups:5:repeats=20 shows "
      "how stable the choice is.");
  return table;
}

Table ResidualTable(const ReportView& view, const std::string& holdout) {
  Table table{.title = "Residual statistics, " + holdout};
  table.error = ErrorTextOf(view);
  table.note = fmt::format(
      "Residual = measured - predicted on the rows held out, sd with n - 1{}. "
      "R2 is about the training rows' mean.",
      view.shown_unit.empty() ? "" : ", in " + view.shown_unit);
  AddRowsOfModels(view, holdout, ErrorsRow, &table);
  return table;
}

Table SinceStartTable(const ReportView& view) {
  constexpr double kMinute = 60.0;
  Table table{.title = "Error since the start of a session, " +
                       view.recommended + ", " + view.decisive};
  table.error = ErrorTextOf(view);
  if (view.component->recommendation) {
    for (const models::SinceStartRecord& part :
         view.component->recommendation->since_start) {
      table.Add({{{"from, min"}, Number{part.from / kMinute, 3}},
                 {{"to, min"}, Number{part.until / kMinute, 3}},
                 {{"rows"}, part.n},
                 {{ErrorHead(view, "mean")}, Error{part.mean}},
                 {{ErrorHead(view, "RMSE")}, Error{part.rmse}}});
    }
  }
  return table;
}

Table NormalityTable(const ReportView& view, const std::string& holdout) {
  Table table{.title = "Are the residuals normal? " + holdout};
  table.note =
      "Statistic and p. The p of Eq. 140 assumes a given mean and sd. Here "
      "both are estimated; Lilliefors' p allows for that. All p assume "
      "independent rows.";
  AddRowsOfModels(view, holdout, NormalityRow, &table);
  return table;
}

Table IndependenceTable(const ReportView& view, const std::string& holdout) {
  Table table{.title = "Are the residuals random? " + holdout};
  table.note =
      "Statistic and p, in the file's order; then the share of the residuals' "
      "variance that lies between groups and between positions.";
  AddRowsOfModels(view, holdout, IndependenceRow, &table);
  return table;
}

}  // namespace errmap::report
