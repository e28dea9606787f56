#include "models/study/judgement/worth_of_sensors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "models/study/judgement/recommendation.h"

namespace errmap::models {
namespace {

bool HasSensors(const ModelResult& model) {
  return model.final_fit.has_value() && !SensorsOf(*model.final_fit).empty();
}

bool IsWorthMore(std::size_t model,
                 std::size_t baseline,
                 const HoldoutComparison& comparison) {
  constexpr double kLeastGain = 0.9;
  if (!(RmseOf(comparison, model) <
        kLeastGain * RmseOf(comparison, baseline))) {
    return false;
  }
  constexpr double kLeastRmse = std::numeric_limits<double>::min();
  const auto logs_of = [&](std::size_t of) {
    return comparison.unit_rmse.col(*comparison.PlaceOf(of))
        .array()
        .max(kLeastRmse)
        .log()
        .eval();
  };
  const Eigen::ArrayXd ratio = logs_of(model) - logs_of(baseline);
  const auto count = static_cast<double>(ratio.size());
  if (count < 2.0) return true;
  const double variance = (ratio - ratio.mean()).square().sum() / (count - 1.0);
  return ratio.mean() < -std::sqrt(variance / count);
}

}  // namespace

std::optional<std::size_t> BetterWithoutSensors(
    std::size_t model,
    const HoldoutComparison& comparison,
    const StudyResult& study,
    const Wanted& is_map) {
  if (!HasSensors(study.models[model])) return std::nullopt;
  const Wanted is_free = [&](std::size_t other) {
    return is_map(other) && study.models[other].baseline &&
           !HasSensors(study.models[other]);
  };
  const auto passed = [&](std::size_t other) {
    return !is_free(other) || IsWorthMore(model, other, comparison);
  };
  if (std::ranges::all_of(comparison.models, passed)) return std::nullopt;
  return BestWhere(comparison, is_free);
}

}  // namespace errmap::models
