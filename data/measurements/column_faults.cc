#include "data/measurements/column_faults.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <string>

#include <Eigen/Eigenvalues>

#include "data/csv.h"
#include "data/measurements/dataset.h"

namespace errmap::data {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Rows = std::vector<Index>;

// Rows below which a column says nothing of itself.
constexpr Index kFewestRows = 12;

// A machine in a shop: beyond these a thermometer is broken or in other units.
constexpr double kColdest = -50.0;  // degC
constexpr double kHottest = 200.0;  // degC

// Single cells are wrong in at most this share of the rows, yet always some.
constexpr Index kCellShare = 20;
constexpr Index kFewCells = 3;

// An outlying value lies this many ranges of all others away from them.
constexpr double kFarRanges = 10.0;
constexpr double kFarRangesOfCode = 0.1;
constexpr int kFewestLevels = 4;  // of a column that has a range at all

// Jumps and steps in noise of the column's second differences, and degC.
constexpr double kJumpNoise = 20.0;
constexpr double kLeastJump = 1.0;
constexpr double kLeastStep = 2.0;
constexpr double kStillNoise = 5.0;   // less than that is no movement
constexpr double kStillShare = 0.03;  // nor less than that of the step
constexpr std::size_t kLongestJump = 3;
constexpr double kFarFromEnd = 5.0;  // times that, at the first and last row
constexpr std::size_t kFewestOthers = 3;

// Of the standard deviation of normal values to their median distance from 0.
constexpr double kNormalMad = 1.4826;

constexpr double kNoisyTimes = 10.0;
constexpr double kLeastNoise = 0.1;  // degC

// A stuck thermometer should have moved by that much, in degC and in steps of
// its resolution, and had this chance to stay by itself.
constexpr double kLeastMove = 0.5;
constexpr double kLeastMoveNoise = 5.0;
// A drifting thermometer: what it reads beyond all that the others explain (by
// their first principal components) rises with the rows, by that much in all
// and by that many standard deviations about the line; where the rows are one
// session, or the others explain the time itself, nothing can be said.
constexpr Index kFewestSessions = 3;
constexpr Index kMostComponents = 5;
constexpr double kLeastDrift = 0.5;  // degC
constexpr double kDriftTimes = 10.0;
constexpr double kMostScatterNoise = 8.0;  // else it goes its own ways anyhow
constexpr double kLeastTimeLeft = 0.3;     // sd of time, of that before

constexpr double kStuckLogChance = -18.0;  // natural logarithm: 1.5e-8

Index MostCells(Index num_rows) {
  return std::max(kFewCells, num_rows / kCellShare);
}

double MedianOf(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle =
      values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

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

// How many of the extreme values, outermost first, are no part of the rest.
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

struct Bounds {
  double low;
  double high;
};

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

// The range of the values that hang together.
Bounds BoundsOfTheRest(const VectorXd& values) {
  const Bounds all{values.minCoeff(), values.maxCoeff()};
  const auto most = static_cast<std::ptrdiff_t>(
      std::min(MostCells(values.size()), values.size() / 4));
  std::vector<double> low(values.begin(), values.end());
  std::nth_element(low.begin(), low.begin() + most, low.end());
  const double core_low = low[static_cast<std::size_t>(most)];
  std::vector<double> high(values.begin(), values.end());
  std::nth_element(
      high.begin(), high.begin() + most, high.end(), std::greater<>());
  const double core_high = high[static_cast<std::size_t>(most)];
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
  return {low[static_cast<std::size_t>(below)],
          high[static_cast<std::size_t>(above)]};
}

// ---- Thermometers, in the order of the rows.

// A temperature column less the cells that were found wrong.
struct Thermometer {
  Index input;
  double degree;       // one degC in the column's unit
  Rows wrong;          // ascending
  double noise = 0.0;  // of one reading, at least the resolution
};

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

struct Run {
  std::size_t first;
  std::size_t size;
};

// The longest run of one value.
Run LongestRun(const std::vector<double>& values) {
  Run longest{0, 0};
  for (std::size_t i = 0, first = 0; i < values.size(); ++i) {
    if (values[i] != values[first]) first = i;
    if (i + 1 - first > longest.size) longest = {first, i + 1 - first};
  }
  return longest;
}

// Changes from row to row, outside of the run, as a share of all there.
double ShareOfChanges(const std::vector<double>& values, const Run& run) {
  double changes = 0.0;
  double steps = 0.0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (i > run.first && i < run.first + run.size) continue;
    steps += 1.0;
    changes += values[i] != values[i - 1] ? 1.0 : 0.0;
  }
  return steps > 0.0 ? changes / steps : 0.0;
}

class FaultFinder {
 public:
  explicit FaultFinder(const MeasuredColumns& measured) : measured_(measured) {}

  std::vector<ColumnFault> Find() {
    if (num_rows() < kFewestRows) return {};
    for (Index input = -1; input < measured_.input_values.cols(); ++input) {
      LookAtCells(input);
    }
    for (const Thermometer& t : thermometers_) LookForSteps(t);
    for (const Thermometer& t : thermometers_) LookForStuck(t);
    for (const Thermometer& t : thermometers_) LookForNoise(t);
    if (measured_.num_sessions >= kFewestSessions) LookForDrift();
    std::ranges::stable_sort(faults_, {}, &ColumnFault::input);
    for (ColumnFault& fault : faults_) {
      for (Index& row : fault.rows) {
        row = measured_.rows[static_cast<std::size_t>(row)];
      }
    }
    return std::move(faults_);
  }

 private:
  Index num_rows() const { return measured_.target_values.size(); }

  VectorXd ValuesOf(Index input) const {
    return input < 0 ? measured_.target_values
                     : VectorXd(measured_.input_values.col(input));
  }

  const Unit& UnitOf(Index input) const {
    return input < 0 ? measured_.target.unit
                     : measured_.inputs[static_cast<std::size_t>(input)].unit;
  }

  void Add(FaultKind kind, Index input, Rows rows, double value, Bounds held) {
    const bool of_cells =
        kind <= FaultKind::kJump &&
        static_cast<Index>(rows.size()) <= MostCells(num_rows());
    faults_.push_back({.kind = kind,
                       .input = input,
                       .rows = std::move(rows),
                       .of_cells = of_cells,
                       .value = value,
                       .low = held.low,
                       .high = held.high});
  }

  // ---- Single cells.

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
      if (!wrong.empty()) {
        if (static_cast<Index>(wrong.size()) == values.size()) {
          others = {values.minCoeff(), values.maxCoeff()};
        }
        Add(FaultKind::kImpossible,
            input,
            wrong,
            values[wrong.front()],
            others);
      }
      if (!faults_.empty() && faults_.back().input == input &&
          !faults_.back().of_cells) {
        return;  // as a whole: in kelvin, or not connected
      }
      TakeThermometer(input, std::move(wrong));
      return;
    }
    if (!HasLevels(values, kFewestLevels)) return;
    wrong = RowsBeyond(values, BoundsOfTheRest(values), &others);
    if (wrong.empty()) return;
    Add(FaultKind::kOutlying, input, wrong, values[wrong.front()], others);
  }

  Rows SoundRows(const Thermometer& t) const {
    Rows rows;
    for (Index row = 0; row < num_rows(); ++row) {
      if (!std::ranges::binary_search(t.wrong, row)) rows.push_back(row);
    }
    return rows;
  }

  std::vector<double> At(const Rows& rows, Index input) const {
    std::vector<double> values;
    values.reserve(rows.size());
    for (const Index row : rows) {
      values.push_back(measured_.input_values(row, input));
    }
    return values;
  }

  void TakeThermometer(Index input, Rows wrong) {
    const Unit degc = UnitOfSymbol("degC");
    Thermometer t{.input = input,
                  .degree = Converted(1.0, degc, UnitOf(input)) -
                            Converted(0.0, degc, UnitOf(input)),
                  .wrong = std::move(wrong)};
    const Rows rows = SoundRows(t);
    const std::vector<double> values = At(rows, input);
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
      // Where it jumps all the time it is no thermometer to go by.
      if (!faults_.back().of_cells) return;
    }
    thermometers_.push_back(std::move(t));
  }

  // Rows that leave both neighbours to one side and come back at once.
  static std::vector<bool> Jumps(const Thermometer& t,
                                 const std::vector<double>& v) {
    std::vector<bool> is_jump(v.size(), false);
    const double least = std::max(kJumpNoise * t.noise, kLeastJump * t.degree);
    for (std::size_t i = 1; i + 1 < v.size(); ++i) {
      for (std::size_t size = 1; size <= kLongestJump && i + size < v.size();
           ++size) {
        const auto [low, high] = std::minmax_element(
            v.begin() + static_cast<std::ptrdiff_t>(i),
            v.begin() + static_cast<std::ptrdiff_t>(i + size));
        const auto [before, after] = std::minmax(v[i - 1], v[i + size]);
        if (*low - after <= least && before - *high <= least) continue;
        if (after - before >= 0.5 * least) continue;
        std::fill_n(
            is_jump.begin() + static_cast<std::ptrdiff_t>(i), size, true);
        i += size;
        break;
      }
    }
    // At the ends there is one neighbour only.
    const double least_at_end = kFarFromEnd * least;
    if (std::abs(v[0] - v[1]) > least_at_end && std::abs(v[1] - v[2]) < least)
      is_jump.front() = true;
    const std::size_t last = v.size() - 1;
    if (std::abs(v[last] - v[last - 1]) > least_at_end &&
        std::abs(v[last - 1] - v[last - 2]) < least)
      is_jump.back() = true;
    return is_jump;
  }

  // ---- Against the other thermometers.

  // Whether no other thermometer moves from one of these rows to the other, as
  // this one does by `height`.
  bool OthersAreStill(const Thermometer& t,
                      Index from,
                      Index to,
                      double height) const {
    std::size_t still = 0;
    for (const Thermometer& other : thermometers_) {
      if (other.input == t.input) continue;
      if (std::ranges::binary_search(other.wrong, from) ||
          std::ranges::binary_search(other.wrong, to)) {
        continue;
      }
      const double change = measured_.input_values(to, other.input) -
                            measured_.input_values(from, other.input);
      if (std::abs(change) >
          std::max(kStillNoise * other.noise,
                   kStillShare * height / t.degree * other.degree)) {
        return false;
      }
      ++still;
    }
    return still >= kFewestOthers;
  }

  void LookForSteps(const Thermometer& t) {
    const double least = std::max(kJumpNoise * t.noise, kLeastStep * t.degree);
    const Rows rows = SoundRows(t);
    const std::vector<double> values = At(rows, t.input);
    Rows steps;
    double height = 0.0;
    for (std::size_t i = 1; i < values.size(); ++i) {
      const double change = values[i] - values[i - 1];
      if (std::abs(change) <= least ||
          !OthersAreStill(t, rows[i - 1], rows[i], std::abs(change))) {
        continue;
      }
      if (steps.empty()) height = change;
      steps.push_back(rows[i]);
    }
    if (!steps.empty())
      Add(FaultKind::kStep, t.input, steps, height, {0.0, 0.0});
  }

  // Range over the sound rows within the bounds, or outside of them.
  double RangeOf(const Thermometer& t,
                 Index first,
                 Index last,
                 bool within) const {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (Index row = 0; row < num_rows(); ++row) {
      if ((row >= first && row <= last) != within ||
          std::ranges::binary_search(t.wrong, row)) {
        continue;
      }
      low = std::min(low, measured_.input_values(row, t.input));
      high = std::max(high, measured_.input_values(row, t.input));
    }
    return high >= low ? high - low : 0.0;
  }

  void LookForStuck(const Thermometer& t) {
    const Rows sound = SoundRows(t);
    const std::vector<double> values = At(sound, t.input);
    const Run run = LongestRun(values);
    if (static_cast<Index>(run.size) < kFewestRows) return;
    const double changes = ShareOfChanges(values, run);
    if (!(static_cast<double>(run.size) * std::log1p(-changes) <
          kStuckLogChance)) {
      return;
    }
    const auto begin = sound.begin() + static_cast<std::ptrdiff_t>(run.first);
    const Rows rows(begin, begin + static_cast<std::ptrdiff_t>(run.size));
    const Index first = rows.front();
    const Index last = rows.back();
    std::vector<double> ranges_within;
    std::vector<double> ranges_elsewhere;
    for (const Thermometer& other : thermometers_) {
      if (other.input == t.input) continue;
      ranges_within.push_back(RangeOf(other, first, last, true) / other.degree);
      ranges_elsewhere.push_back(RangeOf(other, first, last, false) /
                                 other.degree);
    }
    if (ranges_within.size() < kFewestOthers) return;
    const double others = MedianOf(std::move(ranges_within)) * t.degree;
    const double elsewhere = MedianOf(std::move(ranges_elsewhere)) * t.degree;
    const double expected = others * RangeOf(t, first, last, false) / elsewhere;
    if (expected >= kLeastMove * t.degree &&
        expected >= kLeastMoveNoise * t.noise) {
      Add(FaultKind::kStuck, t.input, rows, values[run.first], {0.0, others});
    }
  }

  void LookForNoise(const Thermometer& t) {
    std::vector<double> others;
    for (const Thermometer& other : thermometers_) {
      if (other.input != t.input) others.push_back(other.noise / other.degree);
    }
    if (others.size() < kFewestOthers) return;
    const double usual = MedianOf(std::move(others)) * t.degree;
    if (t.noise > kNoisyTimes * usual && t.noise > kLeastNoise * t.degree) {
      Add(FaultKind::kNoisy, t.input, {}, t.noise, {0.0, usual});
    }
  }

  // ---- Drift.

  struct Drift {
    double change = 0.0;   // from first to last row
    double scatter = 0.0;  // about the line
    double ratio() const { return std::abs(change) / scatter; }
  };

  // Of column `j` by the covariance of the columns `used` and of time (last).
  static std::optional<Drift> DriftOf(const Eigen::MatrixXd& covariance,
                                      const std::vector<Index>& used,
                                      Index j) {
    std::vector<Index> others;
    std::ranges::copy_if(
        used, std::back_inserter(others), [&](Index k) { return k != j; });
    const VectorXd scale =
        covariance.diagonal()(others).array().sqrt().inverse();
    const Eigen::MatrixXd correlation =
        scale.asDiagonal() * covariance(others, others) * scale.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(correlation);
    const Index time = covariance.rows() - 1;
    const VectorXd with_j = scale.asDiagonal() * covariance(others, j);
    const VectorXd with_time = scale.asDiagonal() * covariance(others, time);
    double var_j = covariance(j, j);
    double var_time = covariance(time, time);
    double joint = covariance(j, time);
    const auto num_others = static_cast<Index>(others.size());
    for (Index k = 0; k < std::min(kMostComponents, num_others); ++k) {
      const Index at = num_others - 1 - k;  // largest last
      const double variance = axes.eigenvalues()[at];
      const double a = axes.eigenvectors().col(at).dot(with_j);
      const double b = axes.eigenvectors().col(at).dot(with_time);
      if (!(variance > 1e-9)) break;
      var_j -= a * a / variance;
      var_time -= b * b / variance;
      joint -= a * b / variance;
    }
    if (!(var_time >
          kLeastTimeLeft * kLeastTimeLeft * covariance(time, time))) {
      return std::nullopt;
    }
    const double slope = joint / var_time;
    return Drift{.change = 2.0 * slope,  // time runs from -1 to 1
                 .scatter = std::sqrt(std::max(var_j - slope * joint,
                                               1e-12 * covariance(j, j)))};
  }

  // The worst first: it no longer counts among the others then.
  void LookForDrift() {
    std::vector<Index> used;  // places among the thermometers
    for (std::size_t k = 0; k < thermometers_.size(); ++k) {
      const bool is_bad = std::ranges::any_of(faults_, [&](const auto& fault) {
        return fault.input == thermometers_[k].input && !fault.of_cells;
      });
      if (!is_bad) used.push_back(static_cast<Index>(k));
    }
    const Eigen::MatrixXd covariance = CovarianceWithTime();
    while (used.size() > kFewestOthers) {
      Drift worst{.change = 0.0, .scatter = 1.0};
      Index worst_at = -1;
      for (const Index k : used) {
        const std::optional<Drift> drift = DriftOf(covariance, used, k);
        const Thermometer& t = thermometers_[static_cast<std::size_t>(k)];
        if (!drift || std::abs(drift->change) < kLeastDrift * t.degree ||
            drift->scatter > kMostScatterNoise * t.noise ||
            drift->ratio() < kDriftTimes || drift->ratio() < worst.ratio()) {
          continue;
        }
        worst = *drift;
        worst_at = k;
      }
      if (worst_at < 0) return;
      Add(FaultKind::kDrifting,
          thermometers_[static_cast<std::size_t>(worst_at)].input,
          {},
          worst.change,
          {0.0, worst.scatter});
      std::erase(used, worst_at);
    }
  }

  // Of the thermometers and of the row number from -1 to 1, over the rows in
  // which all of them have a sound value.
  Eigen::MatrixXd CovarianceWithTime() const {
    const Index m = num_rows();
    std::vector<bool> is_sound(static_cast<std::size_t>(m), true);
    for (const Thermometer& t : thermometers_) {
      for (const Index row : t.wrong) {
        is_sound[static_cast<std::size_t>(row)] = false;
      }
    }
    const auto size = static_cast<Index>(thermometers_.size());
    VectorXd sum = VectorXd::Zero(size + 1);
    Eigen::MatrixXd products = Eigen::MatrixXd::Zero(size + 1, size + 1);
    VectorXd row_values(size + 1);
    double count = 0.0;
    for (Index row = 0; row < m; ++row) {
      if (!is_sound[static_cast<std::size_t>(row)]) continue;
      for (Index k = 0; k < size; ++k) {
        const Index input = thermometers_[static_cast<std::size_t>(k)].input;
        row_values[k] = measured_.input_values(row, input) -
                        measured_.input_values(0, input);
      }
      row_values[size] = 2.0 * static_cast<double>(row) /
                             static_cast<double>(std::max<Index>(m - 1, 1)) -
                         1.0;
      sum += row_values;
      products.selfadjointView<Eigen::Lower>().rankUpdate(row_values);
      count += 1.0;
    }
    if (count < 1.0) return Eigen::MatrixXd::Zero(size + 1, size + 1);
    const VectorXd mean = sum / count;
    const Eigen::MatrixXd full = products.selfadjointView<Eigen::Lower>();
    return full / count - mean * mean.transpose();
  }

  const MeasuredColumns& measured_;
  std::vector<Thermometer> thermometers_;
  std::vector<ColumnFault> faults_;
};

}  // namespace

std::string_view ToString(FaultKind kind) {
  switch (kind) {
    case FaultKind::kImpossible:
      return "impossible";
    case FaultKind::kOutlying:
      return "outlying";
    case FaultKind::kJump:
      return "jump";
    case FaultKind::kStep:
      return "step";
    case FaultKind::kStuck:
      return "stuck";
    case FaultKind::kNoisy:
      return "noisy";
    case FaultKind::kDrifting:
      return "drifting";
  }
  return "";
}

std::vector<ColumnFault> FindColumnFaults(const MeasuredColumns& measured) {
  return FaultFinder(measured).Find();
}

std::vector<Index> RowsOfCellFaults(const std::vector<ColumnFault>& faults) {
  Rows rows;
  for (const ColumnFault& fault : faults) {
    if (fault.of_cells) {
      rows.insert(rows.end(), fault.rows.begin(), fault.rows.end());
    }
  }
  std::ranges::sort(rows);
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

}  // namespace errmap::data
