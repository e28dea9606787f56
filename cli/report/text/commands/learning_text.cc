#include "cli/report/text/commands/learning_text.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "cli/report/learning_words.h"
#include "cli/report/number_text.h"
#include "cli/report/text/answers/component_numbers.h"
#include "data/text.h"

namespace errmap::report {
namespace {

std::string_view ViewWords(const std::string& view) {
  if (view == "history") return "raw and filtered";
  if (view == "zero") return "minus each session's first value";
  if (view == "history+zero") {
    return "through filters, minus each session's first value";
  }
  return "raw";
}

std::string CurveText(const models::LearningCurvesRecord& curves,
                      const models::LearningModelRecord& model,
                      const ErrorText& error) {
  std::string text = data::Printable(model.model) + "\n";
  if (model.points.empty()) {
    return text + "  failed: " + model.why_failed.value_or("") + "\n";
  }
  for (const models::LearningPointRecord& point : model.points) {
    text += fmt::format("  {:4}  {:>9}  {:>9} to {}\n",
                        point.units,
                        error(point.rmse),
                        error(point.low),
                        error(point.high));
  }
  const std::string words = LawWords(curves, model, error);
  return words.empty() ? text : text + "  " + words + "\n";
}

}  // namespace

std::string CurvesText(const models::LearningCurvesRecord& curves,
                       const data::Unit& unit) {
  const ErrorText error = ErrorTextOf(curves, unit);
  std::string text = fmt::format(
      "RMSE ({}) on an unseen {}, by the number of {} learnt from; {} in all; "
      "90 % "
      "interval\n",
      error.symbol(),
      curves.unit,
      PluralOf(curves.unit),
      curves.units);
  for (const models::LearningModelRecord& model : curves.models) {
    text += CurveText(curves, model, error);
  }
  return text;
}

std::string SensorsText(const models::SensorCurve& curve,
                        const data::Unit& unit) {
  constexpr std::size_t kMostSubstitutes = 4;
  const ErrorText error = ErrorTextOf(curve, unit);
  std::string text =
      fmt::format("Held-out RMSE ({}), {}, by the number of sensors, {}\n",
                  error.symbol(),
                  curve.held_out,
                  ViewWords(curve.view));
  for (const models::SensorCurve::Point& point : curve.points) {
    text += fmt::format("  {:4}  {:>9}{}\n",
                        point.sensors,
                        error(point.rmse),
                        point.sensors == curve.enough ? "  enough" : "");
  }
  text += fmt::format("  {:>4}  {:>9}\n", "all", error(curve.all.rmse));
  text += EnoughWords(curve) + (curve.enough ? ":\n" : "; the best choice:\n");
  for (const models::SensorCurve::Chosen& chosen : curve.chosen) {
    text += "  " + data::Printable(chosen.sensor);
    if (std::isfinite(chosen.replaced_cost)) {
      text += fmt::format(" ({:+.0f} % with another in its place)",
                          kPercent * chosen.replaced_cost);
    }
    for (std::size_t s = 0;
         s < std::min(kMostSubstitutes, chosen.substitutes.size());
         ++s) {
      text += fmt::format("{}{}",
                          s == 0 ? ", or instead " : ", ",
                          data::Printable(chosen.substitutes[s]));
    }
    text += "\n";
  }
  return text;
}

std::string NextText(const std::vector<models::NextState>& chosen) {
  std::string text =
      "Measure these data rows next, in this order. % is the mean variance of "
      "the\npredictions left, then comes the distance to the nearest measured "
      "state.\n";
  for (const models::NextState& state : chosen) {
    text += fmt::format("  row {:4}  {:3.0f} %  {:.1f}\n",
                        state.row,
                        kPercent * state.variance_left,
                        state.distance);
  }
  return text;
}

}  // namespace errmap::report
