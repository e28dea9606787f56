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
                         const Json& interval) {
  const std::vector<double> ends = NumbersOf(interval);
  std::string text = ErrorOrDash(error, value);
  if (ends.size() == 2 && std::isfinite(ends[0]) && std::isfinite(ends[1])) {
    text += fmt::format(" ({} to {})", error(ends[0]), error(ends[1]));
  }
  return text;
}

// The pair of two models under a hold-out, or null.
const Json& PairOf(const ReportView& view,
                   const std::string& one,
                   const std::string& other,
                   const std::string& holdout) {
  static const Json nothing;
  const Json& pairs = At(*view.component, "comparisons");
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Json& pair = At(pairs, i);
    const std::string a = TextAt(pair, "a");
    const std::string b = TextAt(pair, "b");
    if (TextAt(pair, "holdout") == holdout &&
        ((a == one && b == other) || (a == other && b == one))) {
      return pair;
    }
  }
  return nothing;
}

std::string TierText(const ReportView& view, const std::string& model) {
  const double own = NumberAt(ResultOf(view, model, view.decisive), "tier");
  if (std::isfinite(own)) return CountText(own);
  const Json& tiers = At(At(*view.component, "tiers"), view.decisive);
  for (std::size_t i = 0; i < tiers.size(); ++i) {
    for (const std::string& name : TextsOf(At(tiers, i))) {
      if (name == model) return std::to_string(i + 1);
    }
  }
  return "-";
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

std::string SensorCount(const ViewedModel& model) {
  const Json& sensors = At(*model.json, "sensors");
  return sensors.is_array() ? std::to_string(sensors.size()) : "-";
}

std::string DifferenceText(const ReportView& view, const std::string& model) {
  if (model == view.recommended) return "recommended";
  const Json& pair = PairOf(view, view.recommended, model, view.decisive);
  const double p = NumberAt(pair, "p_holm");
  if (!std::isfinite(p)) return "-";
  return PText(p) + (IsTrue(pair, "established") ? ", established" : "");
}

std::string TestText(const Json& test, const char* statistic) {
  const double value = NumberAt(test, statistic);
  if (!std::isfinite(value)) return "-";
  return FigureText(value) + " (" + PText(NumberAt(test, "p")) + ")";
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

std::string CountText(double value) {
  return std::isfinite(value) ? fmt::format("{:.0f}", value) : "-";
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
  for (const ViewedModel& model : view.models) {
    MarkIfRecommended(view, model.name, &table);
    const Json& decisive = ResultOf(view, model.name, view.decisive);
    std::vector<std::string> row{
        model.name,
        TierText(view, model.name),
        model.ok || decisive.is_object()
            ? WithInterval(error,
                           NumberOf(At(decisive, {"test", "rmse"})),
                           At(decisive, "ci95"))
            : "failed"};
    for (const std::string& holdout : view.holdouts) {
      if (holdout == view.decisive) continue;
      row.push_back(ErrorOrDash(error, TestRmse(view, model.name, holdout)));
    }
    row.insert(row.end(),
               {GoalText(view, model.name),
                DifferenceText(view, model.name),
                SensorCount(model),
                CountText(NumberAt(*model.json, "parameters")),
                CountText(NumberAt(*model.json, "predict_ns"))});
    table.rows.push_back(std::move(row));
    const std::string why = TextAt(*model.json, "why");
    if (!why.empty()) {
      table.note += fmt::format(
          "{}{} failed: {}.", table.note.empty() ? "" : " ", model.name, why);
    }
  }
  table.note +=
      fmt::format("{}{}.", table.note.empty() ? "" : " ", kIntervalCoverage);
  SayIfEmpty("No model was fitted.", &table);
  return table;
}

ReportTable GapTable(const ReportView& view) {
  const ErrorText error = ErrorTextOf(view);
  const Json& gap = At(*view.component, "gap");
  ReportTable table{.title = "What knowing the neighbours is worth"};
  const std::string neighbours = TextAt(gap, "neighbours");
  const std::string unseen = TextAt(gap, "unseen");
  table.columns = {{"model", false},
                   {ErrorHead(view, neighbours + " RMSE")},
                   {ErrorHead(view, unseen + " RMSE")},
                   {"ratio"},
                   {"flattered", false}};
  for (const ViewedModel& viewed : view.models) {
    const Json& model = Find(At(gap, "models"), "model", viewed.name);
    if (!model.is_object()) continue;
    MarkIfRecommended(view, viewed.name, &table);
    table.rows.push_back(
        {viewed.name,
         ErrorOrDash(error, NumberAt(model, "neighbours_rmse")),
         ErrorOrDash(error, NumberAt(model, "unseen_rmse")),
         FigureText(NumberAt(model, "ratio"), 3),
         IsTrue(model, "flatters") ? "yes" : "no"});
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
  for (const ViewedModel& model : view.models) {
    if (model.name == view.recommended) continue;
    const Json& pair = PairOf(view, view.recommended, model.name, holdout);
    if (!pair.is_object()) continue;
    // The pair may stand the other way round.
    const double sign = TextAt(pair, "a") == view.recommended ? 1.0 : -1.0;
    const double difference =
        sign * (NumberAt(pair, "rmse_b") - NumberAt(pair, "rmse_a"));
    const std::vector<double> ends = NumbersOf(At(pair, "ci95"));
    Json interval;
    if (ends.size() == 2) {
      // It is that of "difference", whichever way that was taken.
      const bool same = NumberAt(pair, "difference") * difference >= 0.0;
      interval = same ? Json{ends[0], ends[1]} : Json{-ends[1], -ends[0]};
    }
    table.rows.push_back(
        {model.name,
         WithInterval(error, difference, interval),
         PText(NumberAt(pair, "p")),
         PText(NumberAt(pair, "p_holm")),
         PText(NumberOf(At(pair, {"tests", "wilcoxon", "p"}))),
         PText(NumberOf(At(pair, {"tests", "corrected_t", "p"}))),
         PText(NumberOf(At(pair, {"tests", "diebold_mariano", "p"}))),
         CountText(NumberAt(pair, "units")),
         FigureText(NumberAt(pair, "lag1"), 2),
         IsTrue(pair, "established") ? "yes" : "no"});
  }
  SayIfEmpty("Differences between models were not tested.", &table);
  return table;
}

ReportTable StabilityTable(const ReportView& view) {
  ReportTable table{.title = "Would other cuts choose the same?"};
  table.columns = {
      {"hold-out", false}, {"repeats"}, {"model", false}, {"share of wins, %"}};
  const Json& stability = At(*view.component, "stability");
  for (std::size_t i = 0; i < stability.size(); ++i) {
    const Json& entry = At(stability, i);
    const Json& wins = At(entry, "wins");
    for (std::size_t j = 0; j < wins.size(); ++j) {
      constexpr double kPercent = 100.0;
      table.rows.push_back(
          {TextAt(entry, "holdout"),
           CountText(NumberAt(entry, "repeats")),
           TextAt(At(wins, j), "model"),
           FigureText(kPercent * NumberAt(At(wins, j), "share"), 3)});
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
  for (const ViewedModel& model : view.models) {
    const Json& result = ResultOf(view, model.name, holdout);
    const Json& test = At(result, "test");
    if (!test.is_object()) continue;
    MarkIfRecommended(view, model.name, &table);
    std::vector<std::string> row{model.name, CountText(NumberAt(test, "n"))};
    for (const char* key :
         {"mean", "sd", "min", "max", "range", "rmse", "mae"}) {
      row.push_back(ErrorOrDash(error, NumberAt(test, key)));
    }
    row.push_back(FixedText(NumberAt(test, "r2"), 4));
    row.push_back(ErrorOrDash(error, NumberOf(At(result, {"train", "rmse"}))));
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
  for (const ViewedModel& model : view.models) {
    const Json& tests = At(ResultOf(view, model.name, holdout), "normality");
    if (!tests.is_object()) continue;
    MarkIfRecommended(view, model.name, &table);
    const Json& ks = At(tests, "ks");
    const double d = NumberAt(ks, "d");
    table.rows.push_back(
        {model.name,
         std::isfinite(d)
             ? FigureText(d) + " (" + PText(NumberAt(ks, "p_given")) + ")"
             : "-",
         TestText(At(tests, "lilliefors"), "d"),
         TestText(At(tests, "shapiro_wilk"), "w"),
         TestText(At(tests, "anderson_darling"), "a2"),
         TestText(At(tests, "jarque_bera"), "jb"),
         FigureText(NumberOf(At(tests, {"ppcc", "lambda"})), 3),
         FigureText(NumberOf(At(tests, {"ppcc", "r_max"}))),
         FigureText(NumberOf(At(tests, {"ppcc", "r_normal"}))),
         FigureText(NumberAt(tests, "skewness"), 3),
         FigureText(NumberAt(tests, "kurtosis"), 3)});
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
  for (const ViewedModel& model : view.models) {
    const Json& tests = At(ResultOf(view, model.name, holdout), "randomness");
    if (!tests.is_object()) continue;
    MarkIfRecommended(view, model.name, &table);
    const Json& order = At(tests, "in_order");
    const Json& group = At(tests, "by_group");
    const Json& position = At(tests, "by_position");
    constexpr double kPercent = 100.0;
    table.rows.push_back(
        {model.name,
         TestText(At(order, "runs"), "z"),
         TestText(At(order, "lag1"), "r"),
         TestText(At(order, "durbin_watson"), "d"),
         TestText(At(order, "ljung_box"), "q"),
         FigureText(kPercent * NumberAt(group, "explained"), 3),
         TestText(group, "f"),
         FigureText(kPercent * NumberAt(position, "explained"), 3),
         TestText(position, "f"),
         TestText(At(tests, "breusch_pagan"), "lm")});
  }
  SayIfEmpty(kNoResults, &table);
  return table;
}

}  // namespace errmap::cli
