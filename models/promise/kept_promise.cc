#include "models/promise/kept_promise.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "models/map_experience.h"
#include "models/promise/session_check.h"
#include "stats/error_metrics.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double ShareWithin(const FittedModel& fitted,
                   std::size_t level,
                   const VectorXd& residuals) {
  if (!fitted.interval) return kNaN;
  const double half_width = fitted.interval->levels[level].half_width;
  if (!std::isfinite(half_width)) return kNaN;
  return static_cast<double>((residuals.array().abs() <= half_width).count()) /
         static_cast<double>(residuals.size());
}

// Above kOffRatio times the promise the map is off here, as in CheckSession.
ErrorShape ShapeOf(const KeptPromise& kept) {
  if (kept.found <= kOffRatio * kept.promised) return ErrorShape::kWithin;
  return OffsetExplains(kept.mean, kept.found, kept.promised)
             ? ErrorShape::kOffset
             : ErrorShape::kShape;
}

}  // namespace

std::string_view ToString(ErrorShape shape) {
  switch (shape) {
    case ErrorShape::kWithin:
      return "within";
    case ErrorShape::kOffset:
      return "offset";
    case ErrorShape::kShape:
      return "shape";
  }
  return "";
}

KeptPromise HoldToPromise(const FittedModel& fitted,
                          const VectorXd& targets,
                          const VectorXd& predicted) {
  if (targets.size() == 0 || targets.size() != predicted.size()) {
    throw std::invalid_argument(
        "HoldToPromise: needs one prediction for each of at least one target");
  }
  const VectorXd residuals = targets - predicted;
  KeptPromise kept;
  kept.found = stats::RootMeanSquare(residuals);
  kept.within_90 = ShareWithin(fitted, 0, residuals);
  kept.within_95 = ShareWithin(fitted, 1, residuals);
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
