#include "models/session/calibration_check.h"

#include <array>
#include <stdexcept>

#include "data/text.h"
#include "models/session/session_check.h"
#include "stats/error_metrics.h"

namespace errmap::models {
namespace {

double ShareWithin(const FittedModel& fitted,
                   std::size_t level,
                   const VectorXd& residuals,
                   const std::vector<RowFlag>& flags) {
  if (!fitted.interval) return stats::kNaN;
  const PredictionInterval::Level& promised = fitted.interval->levels[level];
  if (!std::isfinite(promised.half_width)) return stats::kNaN;
  Index within = 0;
  for (Index row = 0; row < residuals.size(); ++row) {
    const bool outside =
        !flags.empty() && flags[static_cast<std::size_t>(row)].outside();
    if (std::abs(residuals[row]) <=
        (outside ? promised.outside : promised.inside)) {
      ++within;
    }
  }
  return static_cast<double>(within) / static_cast<double>(residuals.size());
}

// Above kOffRatio times the promise the map is off here, as in CheckSession.
ErrorShape ShapeOf(const CalibrationCheck& kept) {
  if (kept.found <= kOffRatio * kept.promised) return ErrorShape::kWithin;
  return OffsetExplains(kept.mean, kept.found, kept.promised)
             ? ErrorShape::kOffset
             : ErrorShape::kShape;
}

}  // namespace

std::string_view ToString(ErrorShape shape) {
  constexpr auto kNames =
      std::to_array<std::string_view>({"within", "offset", "shape"});
  return data::NameOf(kNames, shape);
}

CalibrationCheck CheckCalibration(const FittedModel& fitted,
                                  const VectorXd& targets,
                                  const VectorXd& predicted,
                                  const std::vector<RowFlag>& flags) {
  if (targets.size() == 0 || targets.size() != predicted.size()) {
    throw std::invalid_argument(
        "CheckCalibration: needs one prediction for each of at least one "
        "target");
  }
  const VectorXd residuals = targets - predicted;
  CalibrationCheck kept;
  kept.found = stats::RootMeanSquare(residuals);
  kept.within_90 = ShareWithin(fitted, 0, residuals, flags);
  kept.within_95 = ShareWithin(fitted, 1, residuals, flags);
  kept.uncompensated = stats::RootMeanSquare(targets);
  kept.constant = stats::RootMeanSquare(targets.array() - targets.mean());
  kept.mean = residuals.mean();
  kept.offset_share =
      kept.found > 0.0 ? std::pow(kept.mean / kept.found, 2) : 0.0;
  if (fitted.held_out) {
    kept.promised = fitted.held_out->rmse;
    kept.shape = ShapeOf(kept);
  }
  return kept;
}

}  // namespace errmap::models
