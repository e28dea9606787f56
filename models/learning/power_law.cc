#include "models/learning/power_law.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "fitting/least_squares/decompositions.h"

namespace errmap::models {
namespace {

// The grid: exponents, the error at the last size, and how much of its square
// is floor.
constexpr int kExponents = 20;
constexpr double kLeastExponent = 0.5;
constexpr double kMostExponent = 3.0;
constexpr int kLevels = 61;
constexpr double kFarthestLevel = 1.5;  // e-folds from the error seen there
constexpr int kFloors = 40;
// A curve through few points is never known better than this.
constexpr double kLeastRelativeError = 0.03;
// In variances of a point's error by the units' scatter: the part that all
// sizes have in common, and that of each alone. The first is large since a few
// units tell little of the scatter, and those to come scatter too.
constexpr double kCommon = 4.0;
constexpr double kAlone = 0.2;
// Relative error of the law itself by each e-fold that a size is below the
// last. Chosen with these by 354 simulated curves of 4, 6 and 10 days
// (tests/benchmarks/learning_law.py).
constexpr double kMisfit = 1.0;

// Inverse covariance of the logarithms of the points' errors.
MatrixXd PrecisionOf(const std::vector<LearningPoint>& points, double last) {
  const auto count = std::ssize(points);
  VectorXd spread(count);
  VectorXd misfit(count);
  for (Index i = 0; i < count; ++i) {
    const LearningPoint& point = points[static_cast<std::size_t>(i)];
    spread[i] = std::max(point.relative_error, kLeastRelativeError);
    misfit[i] = kMisfit * std::log(last / point.size);
  }
  MatrixXd covariance = kCommon * spread * spread.transpose();
  covariance.diagonal() += kAlone * spread.cwiseAbs2() + misfit.cwiseAbs2();
  return fitting::CholeskyInverse(covariance);
}

}  // namespace

double PowerLaw::Law::At(double size) const {
  return std::hypot(floor, gain * std::pow(size, -exponent));
}

PowerLaw::PowerLaw(const std::vector<LearningPoint>& points, double units) {
  if (!(units >= 2.0)) {
    throw std::invalid_argument("PowerLaw: needs two units");
  }
  for (const LearningPoint& point : points) {
    if (!(point.size > 0.0) || !(point.rmse > 0.0) ||
        !std::isfinite(point.rmse)) {
      throw std::invalid_argument("PowerLaw: sizes and errors must be above 0");
    }
  }
  const auto [first, last] =
      std::ranges::minmax_element(points, {}, &LearningPoint::size);
  if (first == points.end() || !(last->size > first->size)) {
    throw std::invalid_argument("PowerLaw: needs two sizes");
  }
  const MatrixXd precision = PrecisionOf(points, last->size);
  const double freedom = units - 1.0;
  const double power = 0.5 * (freedom + static_cast<double>(points.size()));
  VectorXd miss(precision.rows());
  // Student's t: the scatter is known from so many units only.
  const auto log_likelihood = [&](const Law& law) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      miss[static_cast<Index>(i)] =
          std::log(points[i].rmse / law.At(points[i].size));
    }
    return -power * std::log1p(miss.dot(precision * miss) / freedom);
  };
  for (int e = 0; e < kExponents; ++e) {
    const double exponent =
        kLeastExponent *
        std::pow(kMostExponent / kLeastExponent, e / (kExponents - 1.0));
    for (int l = 0; l < kLevels; ++l) {
      const double level =
          last->rmse *
          std::exp(kFarthestLevel * (2.0 * l / (kLevels - 1.0) - 1.0));
      for (int f = 0; f < kFloors; ++f) {
        // Maps are nearer to their floor than to none: density twice the share.
        const double share = std::sqrt((f + 0.5) / kFloors);
        Law law{.floor = level * std::sqrt(share),
                .gain = level * std::sqrt(1.0 - share) *
                        std::pow(last->size, exponent),
                .exponent = exponent,
                .weight = 0.0};
        law.weight = log_likelihood(law);
        laws_.push_back(law);
      }
    }
  }
  const double best = std::ranges::max_element(laws_, {}, &Law::weight)->weight;
  double total = 0.0;
  for (Law& law : laws_) total += law.weight = std::exp(law.weight - best);
  for (Law& law : laws_) law.weight /= total;
  // Laws that no quantile can feel.
  std::erase_if(laws_, [](const Law& law) { return law.weight < 1e-9; });
}

template <typename Value>
PowerLaw::Quantiles PowerLaw::QuantilesOf(Value&& value) const {
  std::vector<std::pair<double, double>> sorted;
  sorted.reserve(laws_.size());
  for (const Law& law : laws_) sorted.emplace_back(value(law), law.weight);
  std::ranges::sort(sorted);
  const auto at = [&](double share) {
    double below = 0.0;
    for (const auto& [found, weight] : sorted) {
      below += weight;
      if (below >= share) return found;
    }
    return sorted.back().first;
  };
  return {.low = at(0.05), .median = at(0.5), .high = at(0.95)};
}

PowerLaw::Quantiles PowerLaw::ErrorAt(double size) const {
  return QuantilesOf([size](const Law& law) { return law.At(size); });
}

PowerLaw::Quantiles PowerLaw::Floor() const {
  return QuantilesOf([](const Law& law) { return law.floor; });
}

PowerLaw::Quantiles PowerLaw::Exponent() const {
  return QuantilesOf([](const Law& law) { return law.exponent; });
}

PowerLaw::Quantiles PowerLaw::UnitsFor(double goal) const {
  return QuantilesOf([goal](const Law& law) {
    if (law.floor >= goal) return std::numeric_limits<double>::infinity();
    if (law.gain <= 0.0) return 1.0;
    const double above = std::sqrt((goal - law.floor) * (goal + law.floor));
    return std::max(
        1.0, std::ceil(std::pow(law.gain / above, 1.0 / law.exponent) - 1e-9));
  });
}

double PowerLaw::NeverReaches(double goal) const {
  double weight = 0.0;
  for (const Law& law : laws_) weight += law.floor >= goal ? law.weight : 0.0;
  return weight;
}

}  // namespace errmap::models
