#include "cli/commands/maps/learning_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "cli/report/figures/svg.h"
#include "cli/report/plot.h"
#include "cli/shell/number_text.h"
#include "data/text.h"

namespace errmap::cli {
namespace {

using Eigen::Index;

constexpr double kPercent = 100.0;

Json NumberOrNull(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Json QuantilesJson(const models::PowerLaw::Quantiles& quantiles) {
  return {NumberOrNull(quantiles.low),
          NumberOrNull(quantiles.median),
          NumberOrNull(quantiles.high)};
}

Json LawJson(const models::LearningPlan& plan,
             const models::PowerLaw& law,
             double goal) {
  const auto size = static_cast<double>(plan.num_units);
  Json json = {{"exponent", QuantilesJson(law.Exponent())},
               {"floor", QuantilesJson(law.Floor())},
               {"at_all_units", QuantilesJson(law.ErrorAt(size))},
               {"at_twice_the_units", QuantilesJson(law.ErrorAt(2.0 * size))},
               {"units_for_goal", nullptr},
               {"never_reaches_goal", nullptr}};
  if (std::isfinite(goal)) {
    json["units_for_goal"] = QuantilesJson(law.UnitsFor(goal));
    json["never_reaches_goal"] = law.NeverReaches(goal);
  }
  return json;
}

std::string WordsOfGoal(const models::LearningPlan& plan,
                        const models::PowerLaw& law,
                        double goal,
                        const ErrorText& error) {
  constexpr double kSure = 0.9;
  constexpr double kTooMany = 20.0;
  const double never = law.NeverReaches(goal);
  const std::string wanted = error.WithUnit(goal);
  if (never >= kSure) {
    return fmt::format(
        "{} is not reached however many are measured ({:.0f} % "
        "sure)",
        wanted,
        kPercent * never);
  }
  const models::PowerLaw::Quantiles units = law.UnitsFor(goal);
  const auto have = static_cast<double>(plan.num_units);
  if (units.median <= have) {
    return fmt::format("{} is reached with about {:.0f} of the {:.0f}",
                       wanted,
                       units.median,
                       have);
  }
  if (!(units.median <= kTooMany * have)) {
    return fmt::format("{} is hardly reached: the floor of the law is {} to {}",
                       wanted,
                       error(law.Floor().low),
                       error.WithUnit(law.Floor().high));
  }
  return fmt::format(
      "about {:.0f} more to reach {} ({:.0f} at least{}; {:.0f} "
      "% that it is never reached)",
      units.median - have,
      wanted,
      std::max(0.0, units.low - have),
      std::isfinite(units.high)
          ? fmt::format(", {:.0f} at most", units.high - have)
          : "",
      kPercent * never);
}

double SmallestError(const std::vector<models::LearningCurve>& curves) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const models::LearningCurve& curve : curves) {
    for (const auto& point : curve.points) {
      smallest = std::min(smallest, point.rmse);
    }
  }
  return std::isfinite(smallest) ? smallest : 1.0;
}

std::string CurveText(const models::LearningPlan& plan,
                      const models::LearningCurve& curve,
                      double goal,
                      const ErrorText& error) {
  std::string text = data::Printable(curve.model, curve.model.size()) + "\n";
  if (curve.points.empty()) {
    return text + "  failed: " + curve.why_failed + "\n";
  }
  for (const auto& point : curve.points) {
    text += fmt::format("  {:4}  {:>9}  {:>9} to {}\n",
                        point.size,
                        error(point.rmse),
                        error(point.low),
                        error(point.high));
  }
  if (!curve.law) return text;
  const auto all = static_cast<double>(plan.num_units);
  const models::PowerLaw::Quantiles at_all = curve.law->ErrorAt(all);
  text += fmt::format("  with all {:.0f}: {} expected ({} to {})",
                      all,
                      error.WithUnit(at_all.median),
                      error(at_all.low),
                      error(at_all.high));
  if (std::isfinite(goal)) {
    text += "; " + WordsOfGoal(plan, *curve.law, goal, error);
  }
  return text + "\n";
}

// Told apart in every kind of colour vision (Okabe & Ito 2008).
constexpr std::array<const char*, 6> kColours = {
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"};

std::string_view ViewWords(models::View view) {
  switch (view) {
    case models::View::kRaw:
      return "as they are";
    case models::View::kHistory:
      return "as they are and through filters";
    case models::View::kZero:
      return "each less its session's first value";
    case models::View::kHistoryAndZero:
      return "through filters, each less its session's first value";
  }
  return "";
}

}  // namespace

Json CurvesJson(const models::LearningPlan& plan,
                const std::vector<models::LearningCurve>& curves,
                double goal) {
  Json models = Json::array();
  for (const models::LearningCurve& curve : curves) {
    Json points = Json::array();
    for (const auto& point : curve.points) {
      points.push_back({{"units", point.size},
                        {"rmse", point.rmse},
                        {"low", NumberOrNull(point.low)},
                        {"high", NumberOrNull(point.high)}});
    }
    models.push_back(
        {{"model", curve.model},
         {"why_failed",
          curve.why_failed.empty() ? Json() : Json(curve.why_failed)},
         {"points", std::move(points)},
         {"law", curve.law ? LawJson(plan, *curve.law, goal) : Json()}});
  }
  return {{"unit", plan.unit},
          {"units", plan.num_units},
          {"goal", NumberOrNull(goal)},
          {"models", std::move(models)}};
}

std::string CurvesText(const models::LearningPlan& plan,
                       const std::vector<models::LearningCurve>& curves,
                       double goal,
                       const data::Unit& unit) {
  const ErrorText error(unit, SmallestError(curves));
  std::string text = fmt::format(
      "RMSE ({}) on an unseen {} against the number learnt from, of {} in "
      "all; 90 % interval over them\n",
      error.symbol(),
      plan.unit,
      plan.num_units);
  for (const models::LearningCurve& curve : curves) {
    text += CurveText(plan, curve, goal, error);
  }
  return text;
}

std::string CurvesSvg(const models::LearningPlan& plan,
                      const std::vector<models::LearningCurve>& curves,
                      const data::Unit& unit) {
  Plot plot{
      .name = "learning-curve",
      .x = {.quantity = "number of " + plan.unit + " learnt from", .low = 0.0},
      .y = {.quantity = "RMSE on an unseen " + plan.unit,
            .unit = unit.display_symbol,
            .low = 0.0},
      .colour = {},
      .series = {}};
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const char* colour = kColours[i % kColours.size()];
    Series line{.label = curves[i].model,
                .mark = Mark::kLine,
                .columns = {{}, {}},
                .colour = colour};
    for (const auto& point : curves[i].points) {
      line.columns[0].push_back(static_cast<double>(point.size));
      line.columns[1].push_back(unit.display_scale * point.rmse);
    }
    Series dots{
        .mark = Mark::kPoints, .columns = line.columns, .colour = colour};
    plot.series.push_back(std::move(line));
    plot.series.push_back(std::move(dots));
  }
  return SvgFile(Svg(plot,
                     "Learning curves",
                     "Error on unseen units against the number learnt from"));
}

Json SensorsJson(const models::SensorCurve& curve) {
  Json points = Json::array();
  for (const auto& point : curve.points) {
    points.push_back({{"sensors", point.sensors}, {"rmse", point.rmse}});
  }
  Json sensors = Json::array();
  for (const auto& chosen : curve.chosen) {
    sensors.push_back({{"sensor", chosen.sensor},
                       {"stability", chosen.stability},
                       {"substitutes", chosen.substitutes}});
  }
  return {{"held_out", curve.unit},
          {"view", ToString(curve.view)},
          {"points", std::move(points)},
          {"all", {{"sensors", curve.all_sensors}, {"rmse", curve.all_rmse}}},
          {"enough", curve.enough < 0 ? Json() : Json(curve.enough)},
          {"chosen", std::move(sensors)}};
}

std::string SensorsText(const models::SensorCurve& curve,
                        const data::Unit& unit) {
  constexpr std::size_t kMostSubstitutes = 4;
  double smallest = curve.all_rmse;
  for (const auto& point : curve.points) {
    smallest = std::min(smallest, point.rmse);
  }
  const ErrorText error(unit, smallest);
  std::string text =
      fmt::format("RMSE ({}) held out ({}) against the number of sensors, {}\n",
                  error.symbol(),
                  curve.unit,
                  ViewWords(curve.view));
  for (const auto& point : curve.points) {
    text += fmt::format("  {:4}  {:>9}{}\n",
                        point.sensors,
                        error(point.rmse),
                        point.sensors == curve.enough ? "  enough" : "");
  }
  text +=
      fmt::format("  all {}  {}\n", curve.all_sensors, error(curve.all_rmse));
  text += curve.enough >= 0
              ? fmt::format("{} of {} sensors do it, within 5 % of all:\n",
                            curve.enough,
                            curve.all_sensors)
              : fmt::format(
                    "No choice of {} comes within 5 % of all; the best "
                    "of so many:\n",
                    curve.chosen.size());
  for (const auto& chosen : curve.chosen) {
    text += fmt::format("  {} (in {:.0f} % of the folds)",
                        data::Printable(chosen.sensor, chosen.sensor.size()),
                        kPercent * chosen.stability);
    for (std::size_t s = 0;
         s < std::min(kMostSubstitutes, chosen.substitutes.size());
         ++s) {
      text += fmt::format(
          "{}{}",
          s == 0 ? ", or instead " : ", ",
          data::Printable(chosen.substitutes[s], chosen.substitutes[s].size()));
    }
    text += "\n";
  }
  return text;
}

std::string SensorsSvg(const models::SensorCurve& curve,
                       const data::Unit& unit) {
  Plot plot{.name = "sensor-curve",
            .x = {.quantity = "number of sensors", .low = 0.0},
            .y = {.quantity = "RMSE held out",
                  .unit = unit.display_symbol,
                  .low = 0.0},
            .colour = {},
            .series = {}};
  Series line{.label = "chosen",
              .mark = Mark::kLine,
              .columns = {{}, {}},
              .colour = kColours[0]};
  for (const auto& point : curve.points) {
    line.columns[0].push_back(static_cast<double>(point.sensors));
    line.columns[1].push_back(unit.display_scale * point.rmse);
  }
  const double last = curve.points.empty()
                          ? 1.0
                          : static_cast<double>(curve.points.back().sensors);
  Series all{.label = fmt::format("all {}", curve.all_sensors),
             .mark = Mark::kLine,
             .columns = {{0.0, last},
                         {unit.display_scale * curve.all_rmse,
                          unit.display_scale * curve.all_rmse}},
             .colour = kColours[1],
             .dashed = true};
  plot.series.push_back(std::move(line));
  plot.series.push_back(std::move(all));
  return SvgFile(Svg(plot,
                     "Error against the number of sensors",
                     "Held-out error with chosen sensors, and with "
                     "all of them"));
}

Json NextJson(const std::vector<models::NextState>& chosen) {
  Json json = Json::array();
  for (const models::NextState& state : chosen) {
    json.push_back({{"row", state.candidate},
                    {"variance_left", state.variance_left},
                    {"distance", state.distance}});
  }
  return json;
}

std::string NextText(const std::vector<models::NextState>& chosen) {
  std::string text =
      "Measure next, in this order (data rows of the candidates; mean variance "
      "of predictions left, and distance to the nearest measured state):\n";
  for (const models::NextState& state : chosen) {
    text += fmt::format("  row {:4}  {:3.0f} %  {:.1f}\n",
                        state.candidate,
                        kPercent * state.variance_left,
                        state.distance);
  }
  return text;
}

}  // namespace errmap::cli
