#include "cli/report/report_tables.h"

#include <cmath>

#include <fmt/format.h>

#include "cli/report/verdict_text.h"

namespace errmap::cli {
namespace {

std::string ErrorHead(const ReportView& view, const std::string& what) {
  return WithUnit(what, view.shown_unit);
}

std::string ErrorOrDash(const ErrorText& error, double value) {
  return std::isfinite(value) ? error(value) : "-";
}

// "0.938 (0.81 to 1.06)"
std::string WithInterval(const ErrorText& error,
                         double value,
                         const models::IntervalRecord& ends) {
  std::string text = ErrorOrDash(error, value);
  if (std::isfinite(ends[0]) && std::isfinite(ends[1])) {
    text += fmt::format(" ({} to {})", error(ends[0]), error(ends[1]));
  }
  return text;
}

// The pair of two models under a hold-out, or null.
const models::PairRecord* PairOf(const ReportView& view,
                                 const std::string& one,
                                 const std::string& other,
                                 const std::string& holdout) {
  for (const models::PairRecord& pair : view.component->comparisons) {
    if (pair.holdout == holdout && ((pair.a == one && pair.b == other) ||
                                    (pair.a == other && pair.b == one))) {
      return &pair;
    }
  }
  return nullptr;
}

std::string GoalText(const ReportView& view, const std::string& model) {
  switch (GoalOf(view, model).standing) {
    case models::GoalStanding::kMet:
      return "yes";
    case models::GoalStanding::kMetAfterRezeroing:
      return "after re-zeroing";
    case models::GoalStanding::kMissed:
      return "no";
    default:
      return "-";
  }
}

std::string DifferenceText(const ReportView& view, const std::string& model) {
  if (model == view.recommended) return "recommended";
  const models::PairRecord* pair =
      PairOf(view, view.recommended, model, view.decisive);
  if (pair == nullptr || !std::isfinite(pair->p_holm)) return "-";
  return PText(pair->p_holm) + (pair->established ? ", established" : "");
}

std::string TestText(double statistic, double p) {
  if (!std::isfinite(statistic)) return "-";
  return FigureText(statistic) + " (" + PText(p) + ")";
}

double ShareOf(const std::optional<models::BiasRecord>& bias) {
  constexpr double kPercent = 100.0;
  return bias ? kPercent * bias->explained : models::kNotKnown;
}

std::string TestText(const std::optional<models::BiasRecord>& bias) {
  return bias ? TestText(bias->test.value.f, bias->test.value.p) : "-";
}

void MarkIfRecommended(const ReportView& view,
                       const std::string& model,
                       ReportTable* table) {
  if (model == view.recommended) table->marked = table->rows.size();
}

void SayIfEmpty(const std::string& why, ReportTable* table) {
  if (table->rows.empty()) table->missing = why;
}

constexpr const char* kNoResults = "No model has results under this hold-out.";

}  // namespace

std::string FigureText(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : "-";
}

std::string FixedText(double value, int decimals) {
  constexpr double kTooLarge = 1e6;
  if (!std::isfinite(value)) return "-";
  if (std::abs(value) >= kTooLarge) return FigureText(value);
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  // No minus before nothing.
  return text.find_first_of("123456789") == std::string::npos &&
                 text.starts_with('-')
             ? text.substr(1)
             : text;
}

std::string PText(double p) {
  constexpr double kSmallest = 1e-4;
  if (!std::isfinite(p)) return "-";
  return p < kSmallest ? "<0.0001" : fmt::format("{:.4f}", p);
}

std::string CountText(std::int64_t value) { return std::to_string(value); }

std::string CountText(const std::optional<std::int64_t>& value) {
  return value ? CountText(*value) : "-";
}

ReportTable LeaderboardTable(const ReportView& view) {
  const ErrorText error = ErrorTextOf(view);
  ReportTable table{.title = "Leaderboard"};
  table.columns = {{"model", false}, {"tier"}};
  table.columns.push_back(
      {fmt::format("{} RMSE{}",
                   view.decisive,
                   view.shown_unit.empty() ? "" : ", " + view.shown_unit),
       true,
       view.decisive_is_unseen ? "on whole groups never seen; 95 % interval"
                               : "on rows held out; 95 % interval"});
  for (const std::string& holdout : view.holdouts) {
    if (holdout == view.decisive) continue;
    table.columns.push_back(
        {fmt::format("{} RMSE{}",
                     holdout,
                     view.shown_unit.empty() ? "" : ", " + view.shown_unit)});
  }
  table.columns.insert(table.columns.end(),
                       {{"meets goal", false},
                        {"p against recommended", true, "Holm over all pairs"},
                        {"sensors"},
                        {"parameters"},
                        {"predict, ns"}});
  for (const ModelRecord* model : view.models) {
    MarkIfRecommended(view, model->name, &table);
    const ResultRecord* decisive = ResultOf(*model, view.decisive);
    std::string judged = "-";
    if (decisive != nullptr) {
      judged = WithInterval(error, decisive->test.rmse, decisive->ci95);
    } else if (model->status == models::ModelStatus::kFailed) {
      judged = "failed";
    }
    std::vector<std::string> row{
        model->name,
        decisive != nullptr ? CountText(decisive->tier) : "-",
        std::move(judged)};
    for (const std::string& holdout : view.holdouts) {
      if (holdout == view.decisive) continue;
      row.push_back(ErrorOrDash(error, TestRmse(*model, holdout)));
    }
    row.insert(row.end(),
               {GoalText(view, model->name),
                DifferenceText(view, model->name),
                model->sensors ? std::to_string(model->sensors->size()) : "-",
                CountText(model->parameters),
                std::isfinite(model->predict_ns)
                    ? fmt::format("{:.0f}", model->predict_ns)
                    : "-"});
    table.rows.push_back(std::move(row));
    if (model->why) {
      table.note += fmt::format("{}{} failed: {}.",
                                table.note.empty() ? "" : " ",
                                model->name,
                                *model->why);
    }
  }
  table.note +=
      fmt::format("{}{}.", table.note.empty() ? "" : " ", kIntervalCoverage);
  SayIfEmpty("No model was fitted.", &table);
  return table;
}

ReportTable GapTable(const ReportView& view) {
  const ErrorText error = ErrorTextOf(view);
  ReportTable table{.title = "What knowing the neighbours is worth"};
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
                            ErrorOrDash(error, model.neighbours_rmse),
                            ErrorOrDash(error, model.unseen_rmse),
                            FigureText(model.ratio, 3),
                            model.flatters ? "yes" : "no"});
    }
  }
  SayIfEmpty(
      "There is no gap to show: it needs a hold-out of neighbours and one of "
      "whole groups.",
      &table);
  return table;
}

ReportTable ComparisonTable(const ReportView& view,
                            const std::string& holdout) {
  const ErrorText error = ErrorTextOf(view);
  ReportTable table{.title =
                        "Differences from the recommended model, " + holdout};
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
        PairOf(view, view.recommended, model->name, holdout);
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
      return PText(test ? test->p : models::kNotKnown);
    };
    table.rows.push_back({model->name,
                          WithInterval(error, difference, interval),
                          PText(pair->p),
                          PText(pair->p_holm),
                          PText(pair->tests.wilcoxon.p),
                          p_of(pair->tests.corrected_t),
                          p_of(pair->tests.diebold_mariano),
                          CountText(pair->units),
                          FigureText(pair->lag1, 2),
                          pair->established ? "yes" : "no"});
  }
  SayIfEmpty("Differences between models were not tested.", &table);
  return table;
}

ReportTable StabilityTable(const ReportView& view) {
  ReportTable table{.title = "Would other cuts choose the same?"};
  table.columns = {
      {"hold-out", false}, {"repeats"}, {"model", false}, {"share of wins, %"}};
  for (const models::StabilityRecord& entry : view.component->stability) {
    for (const models::WinRecord& win : entry.wins) {
      constexpr double kPercent = 100.0;
      table.rows.push_back({entry.holdout,
                            CountText(entry.repeats),
                            win.model,
                            FigureText(kPercent * win.share, 3)});
    }
  }
  SayIfEmpty(
      "The groups were cut once only; --holdout groups:5:repeats=20 tells how "
      "stable the choice is.",
      &table);
  return table;
}

ReportTable ResidualTable(const ReportView& view, const std::string& holdout) {
  const ErrorText error = ErrorTextOf(view);
  ReportTable table{.title = "Residual statistics, " + holdout};
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
  for (const ModelRecord* model : view.models) {
    const ResultRecord* result = ResultOf(*model, holdout);
    if (result == nullptr) continue;
    MarkIfRecommended(view, model->name, &table);
    const models::MetricsRecord& test = result->test;
    std::vector<std::string> row{model->name, CountText(test.n)};
    for (const double value : {test.mean,
                               test.sd,
                               test.min,
                               test.max,
                               test.range,
                               test.rmse,
                               test.mae}) {
      row.push_back(ErrorOrDash(error, value));
    }
    row.push_back(FixedText(test.r2, 4));
    row.push_back(ErrorOrDash(error, result->train.rmse));
    table.rows.push_back(std::move(row));
  }
  SayIfEmpty(kNoResults, &table);
  return table;
}

ReportTable NormalityTable(const ReportView& view, const std::string& holdout) {
  ReportTable table{.title = "Are the residuals normal? " + holdout};
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
  for (const ModelRecord* model : view.models) {
    const ResultRecord* result = ResultOf(*model, holdout);
    if (result == nullptr) continue;
    MarkIfRecommended(view, model->name, &table);
    const models::NormalityRecord& tests = result->normality;
    table.rows.push_back(
        {model->name,
         TestText(tests.ks.d, tests.ks.p_given),
         TestText(tests.lilliefors.d, tests.lilliefors.p),
         TestText(tests.shapiro_wilk.w, tests.shapiro_wilk.p),
         TestText(tests.anderson_darling.a2, tests.anderson_darling.p),
         TestText(tests.jarque_bera.jb, tests.jarque_bera.p),
         FigureText(tests.ppcc.lambda, 3),
         FigureText(tests.ppcc.r_max),
         FigureText(tests.ppcc.r_normal),
         FigureText(tests.skewness, 3),
         FigureText(tests.kurtosis, 3)});
  }
  SayIfEmpty(kNoResults, &table);
  return table;
}

ReportTable IndependenceTable(const ReportView& view,
                              const std::string& holdout) {
  ReportTable table{.title = "Are the residuals random? " + holdout};
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
  for (const ModelRecord* model : view.models) {
    const ResultRecord* result = ResultOf(*model, holdout);
    if (result == nullptr) continue;
    MarkIfRecommended(view, model->name, &table);
    const models::RandomnessRecord& tests = result->randomness;
    const models::SerialRecord& order = tests.in_order;
    const auto& spread = tests.breusch_pagan;
    table.rows.push_back(
        {model->name,
         TestText(order.runs.test.value.z, order.runs.test.value.p),
         TestText(order.lag1.test.value.r, order.lag1.test.value.p),
         TestText(order.durbin_watson.d, order.durbin_watson.p),
         TestText(order.ljung_box.test.value.q, order.ljung_box.test.value.p),
         FigureText(ShareOf(tests.by_group), 3),
         TestText(tests.by_group),
         FigureText(ShareOf(tests.by_position), 3),
         TestText(tests.by_position),
         spread ? TestText(spread->test.value.lm, spread->test.value.p) : "-"});
  }
  SayIfEmpty(kNoResults, &table);
  return table;
}

}  // namespace errmap::cli
