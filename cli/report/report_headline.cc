#include "cli/report/report_headline.h"

#include <cctype>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/report/report_tables.h"
#include "cli/report/verdict_text.h"

namespace errmap::cli {

const char* const kSignConvention =
    "Error = actual - nominal: compensate by minus the predicted error. "
    "Residual = measured - predicted error.";

namespace {

std::string ErrorWithInterval(const ReportView& view,
                              const ErrorText& error,
                              Headline* headline) {
  const Json& recommendation = At(*view.component, "recommendation");
  const Json& result = ResultOf(view, view.recommended, view.decisive);
  double rmse = NumberOf(At(result, {"test", "rmse"}));
  if (!std::isfinite(rmse)) rmse = NumberAt(recommendation, "rmse");
  if (!std::isfinite(rmse)) return "";
  std::vector<double> ends = NumbersOf(At(result, "ci95"));
  if (ends.size() != 2) ends = NumbersOf(At(recommendation, "ci95"));
  if (ends.size() == 2 && std::isfinite(ends[0]) && std::isfinite(ends[1])) {
    headline->interval = fmt::format(
        "95 % interval {} to {}", error(ends[0]), error.WithUnit(ends[1]));
  }
  return error.WithUnit(rmse);
}

void SayGoal(const ReportView& view, const ErrorText& error, Headline* line) {
  if (!std::isfinite(view.goal)) {
    line->goal = "No goal was set; --goal sets one.";
    return;
  }
  const models::GoalJudgement judged = GoalOf(view, view.recommended);
  line->goal_standing = judged.standing;
  const std::string goal = fmt::format("{:.3g}{}{}",
                                       view.goal * view.scale,
                                       view.shown_unit.empty() ? "" : " ",
                                       view.shown_unit);
  std::string standing(models::ToString(judged.standing));
  standing.front() =
      static_cast<char>(std::toupper(static_cast<unsigned char>(standing[0])));
  line->goal = fmt::format("Goal: RMSE at most {}. {}: {}.",
                           goal,
                           standing,
                           GoalFigures(judged, error));
}

std::string CostWords(const ReportView& view) {
  const Json& model =
      Find(At(*view.component, "models"), "name", view.recommended);
  std::vector<std::string> parts;
  const Json& sensors = At(model, "sensors");
  if (sensors.is_array()) {
    parts.push_back(
        sensors.empty()
            ? "No temperature sensor"
            : Count(static_cast<long long>(sensors.size()), "sensor"));
  }
  const double parameters = NumberAt(model, "parameters");
  if (std::isfinite(parameters)) {
    parts.push_back(Count(std::llround(parameters), "parameter"));
  }
  const double time = NumberAt(model, "predict_ns");
  if (std::isfinite(time)) {
    parts.push_back(fmt::format("{:.0f} ns per prediction", time));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string FallbackSentence(const ReportView& view, const Headline& line) {
  if (view.recommended.empty()) {
    return "No map can be recommended: no model was fitted and judged.";
  }
  return fmt::format(
      "Use {}.{}",
      view.recommended,
      line.error.empty()
          ? ""
          : fmt::format(" Expect {} {}.", line.error, line.where));
}

}  // namespace

Headline HeadlineOf(const ReportView& view) {
  Headline line;
  const Json& recommendation = At(*view.component, "recommendation");
  const ErrorText error = ErrorTextOf(view);
  line.where = fmt::format(
      "RMSE on {} ({})",
      view.decisive_is_unseen ? "whole groups never seen" : "rows held out",
      view.decisive);
  if (!view.recommended.empty()) {
    line.error = ErrorWithInterval(view, error, &line);
    const double other = TestRmse(view, view.recommended, view.neighbours);
    if (std::isfinite(other)) {
      line.beside =
          fmt::format("{} under {}", error.WithUnit(other), view.neighbours);
      if (view.decisive_is_unseen) {
        line.beside += ", where rows of the same group are known";
      }
    }
    SayGoal(view, error, &line);
    line.cost = CostWords(view);
    line.sensors = fmt::format(
        "{}", fmt::join(TextsOf(At(recommendation, "sensors")), ", "));
  }
  line.sentence = TextAt(recommendation, "sentence");
  if (line.sentence.empty()) line.sentence = FallbackSentence(view, line);
  line.why = TextAt(recommendation, "why");
  // The reasons have a list of their own.
  if (line.why == line.sentence || !At(recommendation, "reasons").empty()) {
    line.why.clear();
  }
  line.reasons = TextsOf(At(recommendation, "reasons"));
  line.caveats = TextsOf(At(recommendation, "caveats"));
  return line;
}

}  // namespace errmap::cli
