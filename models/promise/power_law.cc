#include "models/promise/power_law.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace errmap::models {
namespace {

// Exponents from "hardly falls" to beyond that of the bias of any smooth map.
constexpr int kExponents = 30;
constexpr double kLeastExponent = 0.1;
constexpr double kMostExponent = 3.0;
constexpr int kFloors = 40;
constexpr int kGains = 60;
// A curve through few points is never known better than this.
constexpr double kLeastRelativeError = 0.03;

}  // namespace

double PowerLaw::Law::At(double size) const {
  return floor + gain * std::pow(size, -exponent);
}

PowerLaw::PowerLaw(const std::vector<LearningPoint>& points) {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = 0.0;
  double first = lowest;
  double last = 0.0;
  for (const LearningPoint& point : points) {
    if (!(point.size > 0.0) || !(point.rmse > 0.0) ||
        !std::isfinite(point.rmse)) {
      throw std::invalid_argument("PowerLaw: sizes and errors must be above 0");
    }
    lowest = std::min(lowest, point.rmse);
    highest = std::max(highest, point.rmse);
    first = std::min(first, point.size);
    last = std::max(last, point.size);
  }
  if (!(last > first)) {
    throw std::invalid_argument("PowerLaw: needs two sizes");
  }
  double best = -std::numeric_limits<double>::infinity();
  for (int e = 0; e < kExponents; ++e) {
    const double exponent =
        kLeastExponent *
        std::pow(kMostExponent / kLeastExponent, e / (kExponents - 1.0));
    for (int f = 0; f < kFloors; ++f) {
      // What is above the floor at the first size takes every share of twice
      // the largest error seen.
      const double floor = 1.1 * lowest * f / (kFloors - 1.0);
      for (int g = 0; g < kGains; ++g) {
        const double above = 2.0 * highest * g / (kGains - 1.0);
        const Law law{.floor = floor,
                      .gain = above * std::pow(first, exponent),
                      .exponent = exponent,
                      .weight = 0.0};
        double log_likelihood = 0.0;
        for (const LearningPoint& point : points) {
          const double spread =
              std::max(point.relative_error, kLeastRelativeError);
          const double miss = std::log(point.rmse / law.At(point.size));
          log_likelihood -= 0.5 * miss * miss / (spread * spread);
        }
        if (!std::isfinite(log_likelihood)) continue;
        best = std::max(best, log_likelihood);
        laws_.push_back(law);
        laws_.back().weight = log_likelihood;
      }
    }
  }
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
    return std::max(
        1.0,
        std::ceil(std::pow(law.gain / (goal - law.floor), 1.0 / law.exponent) -
                  1e-9));
  });
}

double PowerLaw::NeverReaches(double goal) const {
  double weight = 0.0;
  for (const Law& law : laws_) weight += law.floor >= goal ? law.weight : 0.0;
  return weight;
}

}  // namespace errmap::models
