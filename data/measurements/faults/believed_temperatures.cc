#include <algorithm>
#include <cmath>
#include <set>

#include "data/measurements/dataset.h"
#include "data/measurements/faults/thermometers.h"
#include "data/units.h"

namespace errmap::data {
namespace {

using Eigen::Index;

constexpr double kAbsoluteZero = -273.15;  // degC
constexpr double kSlow = 2.0;              // degC from row to row
constexpr double kSlowShare = 0.1;         // of its range
constexpr double kGapShare = 0.3;          // of its range
constexpr Bounds kShop{10.0, 45.0};        // degC
constexpr double kLikes = 10.0;            // degC from its like
constexpr std::size_t kFewestDegrees = 4;

const Unit& DegC() {
  static const Unit kUnit = UnitOfSymbol("degC");
  return kUnit;
}

bool IsWithin(const Bounds& bounds, double value) {
  return value >= bounds.low && value <= bounds.high;
}

std::vector<double> InDegC(const MeasuredColumns& measured,
                           Index input,
                           const Unit& unit) {
  std::vector<double> values;
  for (const double value : measured.input_values.col(input)) {
    values.push_back(Converted(value, unit, DegC()));
  }
  return values;
}

double MedianStepIn(const std::vector<double>& values) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < values.size(); ++i) {
    steps.push_back(std::abs(values[i] - values[i - 1]));
  }
  return MedianOf(std::move(steps));
}

// The medians of the other thermometers that are within a shop's bounds.
std::vector<double> LikesOf(const MeasuredColumns& measured, Index input) {
  std::vector<double> likes;
  for (Index other = 0; other < measured.input_values.cols(); ++other) {
    const Unit& unit = measured.inputs[static_cast<std::size_t>(other)].unit;
    if (other == input || unit.quantity != Quantity::kTemperature) continue;
    const double median = MedianOf(InDegC(measured, other, unit));
    if (IsWithin({kColdest, kHottest}, median)) likes.push_back(median);
  }
  return likes;
}

// Whether it would be one of its like if it were in another unit.
bool HasAnotherUnit(const MeasuredColumns& measured,
                    Index input,
                    const std::vector<double>& likes) {
  Bounds bounds = kShop;
  if (!likes.empty()) {
    bounds = {std::ranges::min(likes) - kLikes,
              std::ranges::max(likes) + kLikes};
  }
  const Unit& own = measured.inputs[static_cast<std::size_t>(input)].unit;
  if (IsWithin(bounds, MedianOf(InDegC(measured, input, own)))) return false;
  return std::ranges::any_of(
      UnitsOf(Quantity::kTemperature), [&](const Unit& unit) {
        // Nobody writes K for degF: 77 K is nitrogen.
        const bool may_be = unit.symbol != own.symbol &&
                            !(own.symbol == "K" && unit.symbol == "degF");
        return may_be &&
               IsWithin(bounds, MedianOf(InDegC(measured, input, unit)));
      });
}

// Between those that are beyond the bounds and the nearest that are not.
double WidestGap(const std::vector<double>& values) {
  double gap = 0.0;
  std::vector<double> sorted = values;
  std::ranges::sort(sorted);
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (IsWithin({kColdest, kHottest}, sorted[i - 1]) &&
        IsWithin({kColdest, kHottest}, sorted[i])) {
      continue;
    }
    gap = std::max(gap, sorted[i] - sorted[i - 1]);
  }
  return gap;
}

}  // namespace

bool AreBelieved(const MeasuredColumns& measured,
                 Index input,
                 const std::vector<Index>& wrong) {
  const std::vector<double> values = InDegC(
      measured, input, measured.inputs[static_cast<std::size_t>(input)].unit);
  const auto [least, most] = std::ranges::minmax(values);
  const std::set<double> levels(values.begin(), values.end());
  if (least < kAbsoluteZero || levels.size() < kFewestDegrees) return false;
  const bool are_all = wrong.size() == values.size();
  const std::vector<double> likes = LikesOf(measured, input);
  const double range = most - least;
  const double step = MedianStepIn(values);
  const bool changes = step <= kSlowShare * range;
  const bool is_slow = step <= kSlow && (likes.empty() || !are_all);
  return (changes || is_slow) &&
         (are_all || WidestGap(values) <= std::max(kGapShare * range, kSlow)) &&
         !HasAnotherUnit(measured, input, likes);
}

}  // namespace errmap::data
