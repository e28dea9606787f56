#include "cli/report/learning_words.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "data/text.h"
#include "models/learning/sensor_curve.h"

namespace errmap::report {
namespace {

std::string GoalWords(const models::LearningCurvesRecord& curves,
                      const models::LearningLawRecord& law,
                      const ErrorText& error) {
  constexpr double kSure = 0.9;
  constexpr double kTooMany = 20.0;
  const double never = law.never_reaches_goal;
  const std::string wanted = error.WithUnit(curves.goal);
  if (never >= kSure) {
    constexpr double kMostSure = 99.0;  // that the law itself holds is not
    return fmt::format(
        "{} is not reached with any number ({}{:.0f} % sure, if the curve goes "
        "on like this)",
        wanted,
        kPercent * never > kMostSure ? "over " : "",
        std::min(kMostSure, kPercent * never));
  }
  const auto [low, median, high] = *law.units_for_goal;
  const auto have = static_cast<double>(curves.units);
  if (low < high && high <= have) {
    return fmt::format("{} is reached with {:.0f} to {:.0f} of the {:.0f}",
                       wanted,
                       low,
                       high,
                       have);
  }
  if (median <= have) {
    return fmt::format(
        "{} is reached with about {:.0f} of the {:.0f}", wanted, median, have);
  }
  if (!(median <= kTooMany * have)) {
    return fmt::format("{} is hardly reached: the error levels off at {} to {}",
                       wanted,
                       error(law.floor[0]),
                       error.WithUnit(law.floor[2]));
  }
  return fmt::format(
      "about {:.0f} more to reach {} ({:.0f} at least{}; {:.0f} "
      "% that it is never reached)",
      median - have,
      wanted,
      std::max(0.0, low - have),
      std::isfinite(high) ? fmt::format(", {:.0f} at most", high - have) : "",
      kPercent * never);
}

}  // namespace

std::string LawWords(const models::LearningCurvesRecord& curves,
                     const models::LearningModelRecord& model,
                     const ErrorText& error) {
  if (!model.law) return "";
  const models::QuantilesRecord& at_all = model.law->at_all_units;
  std::string words = fmt::format("with all {}: {} expected ({} to {})",
                                  curves.units,
                                  error.WithUnit(at_all[1]),
                                  error(at_all[0]),
                                  error(at_all[2]));
  if (std::isfinite(curves.goal) && model.law->units_for_goal) {
    words += "; " + GoalWords(curves, *model.law, error);
  }
  return words;
}

std::string EnoughWords(const models::SensorCurve& curve) {
  const double percent = kPercent * (models::SensorCurve::kTolerance - 1.0);
  if (curve.enough == curve.all.sensors) {
    return fmt::format(
        "All {} sensors are needed; fewer add over {:.0f} % "
        "to the error",
        curve.all.sensors,
        percent);
  }
  return curve.enough
             ? fmt::format(
                   "{} of {} sensors are enough, within {:.0f} % of all",
                   *curve.enough,
                   curve.all.sensors,
                   percent)
             : fmt::format("No choice of {} comes within {:.0f} % of all {}",
                           curve.chosen.size(),
                           percent,
                           curve.all.sensors);
}

std::string SensorWords(const models::SensorCurve& curve,
                        const ErrorText& error) {
  constexpr std::size_t kMostSubstitutes = 4;
  std::vector<std::string> sensors;
  for (const models::SensorCurve::Chosen& chosen : curve.chosen) {
    std::vector<std::string> substitutes = chosen.substitutes;
    substitutes.resize(std::min(kMostSubstitutes, substitutes.size()));
    sensors.push_back(substitutes.empty()
                          ? chosen.sensor
                          : fmt::format("{} (or {})",
                                        chosen.sensor,
                                        data::JoinWords(substitutes, ", ")));
  }
  const auto number = std::ssize(curve.chosen);
  const auto point = std::ranges::find(
      curve.points, number, &models::SensorCurve::Point::sensors);
  return fmt::format(
      "{}: {} with {}, {} with all{}{}.",
      EnoughWords(curve),
      point == curve.points.end() ? "not known" : error.WithUnit(point->rmse),
      number == 1 ? "it" : "them",
      error.WithUnit(curve.all.rmse),
      sensors.empty() ? "" : ". ",
      data::Printable(data::JoinWords(sensors, ", ")));
}

ErrorText ErrorTextOf(const models::LearningCurvesRecord& curves,
                      const data::Unit& unit) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const models::LearningModelRecord& model : curves.models) {
    for (const auto& point : model.points) {
      smallest = std::min(smallest, point.rmse);
    }
  }
  return {unit, std::isfinite(smallest) ? smallest : 1.0};
}

ErrorText ErrorTextOf(const models::SensorCurve& curve,
                      const data::Unit& unit) {
  double smallest = curve.all.rmse;
  for (const auto& point : curve.points) {
    smallest = std::min(smallest, point.rmse);
  }
  return {unit, smallest};
}

}  // namespace errmap::report
