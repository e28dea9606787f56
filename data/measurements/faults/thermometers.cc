#include "data/measurements/faults/thermometers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <utility>

#include "data/columns.h"
#include "data/measurements/dataset.h"
#include "data/units.h"

namespace errmap::data {

namespace {

using Eigen::Index;

// Single cells are wrong in at most this share of the rows, yet always some.
constexpr Index kCellShare = 20;
constexpr Index kFewCells = 3;

}  // namespace

double DegreeIn(const Unit& unit) {
  const Unit degc = UnitOfSymbol("degC");
  return Converted(1.0, degc, unit) - Converted(0.0, degc, unit);
}

ColumnFault MakeFault(const MeasuredColumns& measured,
                      FaultKind kind,
                      Index input,
                      std::vector<Index> rows,
                      double value,
                      Bounds held) {
  const bool of_cells =
      kind <= FaultKind::kJump && static_cast<Index>(rows.size()) <=
                                      MostCells(measured.target_values.size());
  return {.kind = kind,
          .input = input,
          .rows = std::move(rows),
          .of_cells = of_cells,
          .value = value,
          .low = held.low,
          .high = held.high};
}

Index MostCells(Index num_rows) {
  return std::max(kFewCells, num_rows / kCellShare);
}

std::vector<Index> SoundRows(const MeasuredColumns& measured,
                             std::span<const Thermometer> thermometers) {
  std::vector<bool> is_sound(
      static_cast<std::size_t>(measured.target_values.size()), true);
  for (const Thermometer& t : thermometers) {
    for (const Index row : t.wrong) {
      is_sound[row] = false;
    }
  }
  return MarkedRows(is_sound);
}

std::vector<double> ValuesAt(const MeasuredColumns& measured,
                             const std::vector<Index>& rows,
                             Index input) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const Index row : rows) {
    values.push_back(measured.input_values(row, input));
  }
  return values;
}

double MedianOf(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle =
      values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

namespace {

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
    const Unit& unit = measured.inputs[other].unit;
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
  const Unit& own = measured.inputs[input].unit;
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
  const std::vector<double> values =
      InDegC(measured, input, measured.inputs[input].unit);
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
