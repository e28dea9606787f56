#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "data/column_words.h"
#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "data/measurements/faults/thermometers.h"

namespace errmap::data {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Rows = std::vector<Index>;

// An outlying value lies this many ranges of all others away from them.
constexpr double kFarRanges = 10.0;
constexpr double kFarRangesOfCode = 0.1;
constexpr int kFewestLevels = 4;  // of a column that has a range at all

// Jumps in degC.
constexpr double kLeastJump = 1.0;
constexpr std::size_t kLongestJump = 3;
constexpr double kFarFromEnd = 5.0;  // times that, at the first and last row

constexpr double kHalf = 0.5;

// Of the standard deviation of normal values to their median distance from 0.
constexpr double kNormalMad = 1.4826;

// A number that programs write for "no reading": all nines, or the largest of
// a type.
bool IsCode(double value) {
  constexpr auto kLargest = std::to_array<double>(
      {32767.0, 32768.0, 65535.0, 2147483647.0, 2147483648.0});
  if (std::ranges::find(kLargest, std::abs(value)) != kLargest.end()) {
    return true;
  }
  std::string digits = CsvNumber(std::abs(value));
  std::erase(digits, '.');
  constexpr std::size_t kFewestNines = 3;
  return digits.size() >= kFewestNines &&
         digits.find_first_not_of('9') == std::string::npos;
}

// How many of the extreme values, outermost first, are not part of the rest.
// `extremes` has one more than may be; `other_end` bounds the rest's range.
Index NumOutlying(const std::vector<double>& extremes, double other_end) {
  Index found = 0;
  bool all_codes = true;
  for (std::size_t j = 0; j + 1 < extremes.size(); ++j) {
    all_codes = all_codes && IsCode(extremes[j]);
    const double gap = std::abs(extremes[j] - extremes[j + 1]);
    const double range = std::abs(extremes[j + 1] - other_end);
    if (range > 0.0 &&
        gap > (all_codes ? kFarRangesOfCode : kFarRanges) * range) {
      found = static_cast<Index>(j) + 1;
    }
  }
  return found;
}

bool HasLevels(const VectorXd& values, int wanted) {
  std::vector<double> levels;
  for (const double value : values) {
    if (std::ranges::find(levels, value) != levels.end()) continue;
    levels.push_back(value);
    if (static_cast<int>(levels.size()) == wanted) return true;
  }
  return false;
}

// Rows outside of the bounds; `others` becomes the range of those within.
Rows RowsBeyond(const VectorXd& values, const Bounds& bounds, Bounds* others) {
  Rows rows;
  *others = {std::numeric_limits<double>::infinity(),
             -std::numeric_limits<double>::infinity()};
  for (Index i = 0; i < values.size(); ++i) {
    if (values[i] < bounds.low || values[i] > bounds.high) {
      rows.push_back(i);
    } else {
      others->low = std::min(others->low, values[i]);
      others->high = std::max(others->high, values[i]);
    }
  }
  return rows;
}

// Rows of one code at either end, at most this part of all and far from all
// other values; `others` becomes their range. Any value is one that comes three
// times or more to the last digit and is farther from the others than `far`
// (NaN: never) and they reach.
Rows RowsOfCode(const VectorXd& values,
                double most,
                double far,
                Bounds* others) {
  for (const double code : {values.minCoeff(), values.maxCoeff()}) {
    const bool is_code = IsCode(code);
    constexpr Index kFewest = 3;
    if (!is_code &&
        (std::isnan(far) || (values.array() == code).count() < kFewest)) {
      continue;
    }
    const bool low = code < values.mean();
    Bounds rest;
    const double infinity = std::numeric_limits<double>::infinity();
    Rows rows =
        RowsBeyond(values,
                   low ? Bounds{std::nextafter(code, infinity), infinity}
                       : Bounds{-infinity, std::nextafter(code, -infinity)},
                   &rest);
    const double gap = low ? rest.low - code : code - rest.high;
    if (static_cast<double>(rows.size()) <=
            most * static_cast<double>(values.size()) &&
        gap > (is_code ? kFarRangesOfCode : 1.0) * (rest.high - rest.low) &&
        (is_code || gap > far)) {
      *others = rest;
      return rows;
    }
  }
  return {};
}

// The range of the values that hang together.
Bounds BoundsOfTheRest(const VectorXd& values) {
  const Bounds all{values.minCoeff(), values.maxCoeff()};
  const auto most = static_cast<std::ptrdiff_t>(
      std::min(MostCells(values.size()), values.size() / 4));
  std::vector<double> low(values.begin(), values.end());
  std::nth_element(low.begin(), low.begin() + most, low.end());
  const double core_low = low[most];
  std::vector<double> high(values.begin(), values.end());
  std::nth_element(
      high.begin(), high.begin() + most, high.end(), std::greater<>());
  const double core_high = high[most];
  // Most columns: no gap can be that wide.
  if (!IsCode(all.low) && !IsCode(all.high) &&
      all.high - all.low <= kFarRanges * (core_high - core_low)) {
    return all;
  }
  low.resize(static_cast<std::size_t>(most) + 1);
  high.resize(static_cast<std::size_t>(most) + 1);
  std::ranges::sort(low);
  std::ranges::sort(high, std::greater<>());
  const Index above = NumOutlying(high, low.back());
  const Index below = NumOutlying(low, high.back());
  return {low[below], high[above]};
}

// Noise by second differences (the bend of white noise of variance 1 has
// variance 1.5), so that slow changes do not count, nor do jumps.
double NoiseOf(const std::vector<double>& values) {
  double resolution = std::numeric_limits<double>::infinity();
  std::vector<double> bends;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double change = std::abs(values[i] - values[i - 1]);
    if (change > 0.0) resolution = std::min(resolution, change);
    if (i + 1 == values.size()) break;
    bends.push_back(
        std::abs(values[i] - 0.5 * (values[i - 1] + values[i + 1])));
  }
  if (bends.empty() || !std::isfinite(resolution)) return 0.0;
  return std::max(resolution,
                  kNormalMad * MedianOf(std::move(bends)) / std::sqrt(1.5));
}

// Rows that leave both neighbours to one side and come back at once.
std::vector<bool> Jumps(const Thermometer& t, const std::vector<double>& v) {
  std::vector<bool> is_jump(v.size(), false);
  const double least = std::max(kJumpNoise * t.noise, kLeastJump * t.degree);
  for (std::size_t i = 1; i + 1 < v.size(); ++i) {
    // A spike leaves the row before it at once: nearly every row is passed by.
    if (!(std::abs(v[i] - v[i - 1]) > least)) continue;
    for (std::size_t size = 1; size <= kLongestJump && i + size < v.size();
         ++size) {
      const auto [low, high] = std::minmax_element(
          v.begin() + static_cast<std::ptrdiff_t>(i),
          v.begin() + static_cast<std::ptrdiff_t>(i + size));
      const auto [before, after] = std::minmax(v[i - 1], v[i + size]);
      if (*low - after <= least && before - *high <= least) continue;
      // Over a night the neighbours differ, and a spike is far from both.
      const double away = std::max(*low - after, before - *high);
      if (after - before >= 0.5 * least &&
          away < kFarFromEnd * (after - before)) {
        continue;
      }
      std::fill_n(is_jump.begin() + static_cast<std::ptrdiff_t>(i), size, true);
      i += size;
      break;
    }
  }
  // At the ends there is one neighbour only.
  const double least_at_end = kFarFromEnd * least;
  if (std::abs(v[0] - v[1]) > least_at_end && std::abs(v[1] - v[2]) < least) {
    is_jump.front() = true;
  }
  const std::size_t last = v.size() - 1;
  if (std::abs(v[last] - v[last - 1]) > least_at_end &&
      std::abs(v[last - 1] - v[last - 2]) < least)
    is_jump.back() = true;
  return is_jump;
}

class CellFaultFinder {
 public:
  explicit CellFaultFinder(const MeasuredColumns& measured)
      : measured_(measured) {}

  CellFaults Find() {
    for (Index input = -1; input < measured_.input_values.cols(); ++input) {
      LookAtCells(input);
    }
    return std::move(found_);
  }

 private:
  const MeasuredColumns& measured_;
  CellFaults found_;

  VectorXd ValuesOf(Index input) const {
    return input < 0 ? measured_.target_values
                     : VectorXd(measured_.input_values.col(input));
  }

  const Unit& UnitOf(Index input) const {
    return input < 0 ? measured_.target.unit : measured_.inputs[input].unit;
  }

  // "ΔT bed [K]": a few kelvin, of either sign.
  bool IsDifference(Index input) const {
    const std::string& name =
        measured_.inputs[static_cast<std::size_t>(input)].name;
    return name.starts_with("\u0394") || name.starts_with("\u2206") ||
           HasWordOf(name, "delta dt diff difference differenz rise");
  }

  void Add(FaultKind kind, Index input, Rows rows, double value, Bounds held) {
    found_.faults.push_back(
        MakeFault(measured_, kind, input, std::move(rows), value, held));
  }

  // Values that stand out by themselves, then, of thermometers, by their
  // neighbours; what is left is held against the other thermometers.
  void LookAtCells(Index input) {
    const VectorXd values = ValuesOf(input);
    const bool is_temperature =
        input >= 0 && UnitOf(input).quantity == Quantity::kTemperature;
    Rows wrong;
    Bounds others{};
    if (is_temperature) {
      static const Unit kDegC = UnitOfSymbol("degC");
      const Bounds possible{Converted(kColdest, kDegC, UnitOf(input)),
                            Converted(kHottest, kDegC, UnitOf(input))};
      wrong = RowsBeyond(values, possible, &others);
      if (!wrong.empty() &&
          (IsDifference(input) || AreBelieved(measured_, input, wrong))) {
        wrong.clear();
      }
      if (!wrong.empty()) {
        if (static_cast<Index>(wrong.size()) == values.size()) {
          others = {values.minCoeff(), values.maxCoeff()};
        }
        Add(FaultKind::kImpossible,
            input,
            wrong,
            values[wrong.front()],
            others);
        SingleOutCodes(values, kHalf);
      }
      if (!found_.faults.empty() && found_.faults.back().input == input &&
          !found_.faults.back().of_cells) {
        return;  // as a whole: in kelvin, or not connected
      }
      if (wrong.empty()) wrong = RowsWithoutPower(input, values);
      TakeThermometer(input, std::move(wrong));
      return;
    }
    if (!HasLevels(values, kFewestLevels)) return;
    // A logger may write rows between the readings of the error.
    const double most = input < 0 ? 0.9 : kHalf;
    wrong = RowsBeyond(values, BoundsOfTheRest(values), &others);
    if (wrong.empty()) wrong = RowsOfCode(values, most, NAN, &others);
    if (wrong.empty()) return;
    Add(FaultKind::kOutlying, input, wrong, values[wrong.front()], others);
    SingleOutCodes(values, most);
  }

  // What a channel shows that was switched off for a while: 0 most often.
  Rows RowsWithoutPower(Index input, const VectorXd& values) {
    constexpr double kFar = 5.0;  // degC
    Bounds others{};
    Rows rows =
        RowsOfCode(values, kHalf, kFar * DegreeIn(UnitOf(input)), &others);
    if (rows.empty()) return rows;
    Add(FaultKind::kOutlying, input, rows, values[rows.front()], others);
    found_.faults.back().of_cells = true;
    return rows;
  }

  // One number for "no reading" in not too many rows is not a fault of the
  // column as a whole. No thermometer comes back to one that is impossible.
  void SingleOutCodes(const VectorXd& values, double most) {
    ColumnFault& fault = found_.faults.back();
    const bool is_code =
        fault.kind == FaultKind::kImpossible || IsCode(fault.value);
    fault.of_cells =
        fault.of_cells ||
        (static_cast<double>(fault.rows.size()) <=
             most * static_cast<double>(values.size()) &&
         is_code && std::ranges::all_of(fault.rows, [&](Index row) {
           return values[row] == fault.value;
         }));
  }

  void TakeThermometer(Index input, Rows wrong) {
    Thermometer t{.input = input,
                  .degree = DegreeIn(UnitOf(input)),
                  .wrong = std::move(wrong)};
    const Rows rows = SoundRows(measured_, {&t, 1});
    const std::vector<double> values = ValuesAt(measured_, rows, input);
    t.noise = NoiseOf(values);
    if (t.noise == 0.0) return;  // it never changes
    const std::vector<bool> is_jump = Jumps(t, values);
    Rows jumps;
    double neighbour = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (is_jump[i]) {
        jumps.push_back(rows[i]);
      } else if (jumps.empty() || std::isnan(neighbour)) {
        neighbour = values[i];
      }
    }
    if (!jumps.empty()) {
      t.wrong.insert(t.wrong.end(), jumps.begin(), jumps.end());
      std::ranges::sort(t.wrong);
      const double first = measured_.input_values(jumps.front(), input);
      Add(FaultKind::kJump,
          input,
          std::move(jumps),
          first,
          {neighbour, neighbour});
      // Where it jumps all the time it is not a reliable thermometer.
      if (!found_.faults.back().of_cells) return;
    }
    found_.thermometers.push_back(std::move(t));
  }
};

}  // namespace

CellFaults FindCellFaults(const MeasuredColumns& measured) {
  return CellFaultFinder(measured).Find();
}

}  // namespace errmap::data
