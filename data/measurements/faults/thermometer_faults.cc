#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "data/measurements/faults/thermometers.h"

namespace errmap::data {
namespace {

using Eigen::Index;
using Rows = std::vector<Index>;

constexpr double kLeastStep = 2.0;    // degC
constexpr double kStillNoise = 5.0;   // less than that is not movement
constexpr double kStillShare = 0.03;  // nor less than that of the step

constexpr double kNoisyTimes = 10.0;
constexpr double kLeastNoise = 0.1;  // degC

// A stuck thermometer should have moved by that much, in degC and in steps of
// its resolution, and had this chance to stay by itself.
constexpr double kLeastMove = 0.5;
constexpr double kLeastMoveNoise = 5.0;
constexpr double kStuckLogChance = -18.0;  // natural logarithm: 1.5e-8

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

class ThermometerFaultFinder {
 public:
  ThermometerFaultFinder(const MeasuredColumns& measured,
                         const std::vector<Thermometer>& thermometers)
      : measured_(measured), thermometers_(thermometers) {}

  std::vector<ColumnFault> Find() {
    for (const Thermometer& t : thermometers_) LookForSteps(t);
    for (const Thermometer& t : thermometers_) LookForStuck(t);
    for (const Thermometer& t : thermometers_) LookForNoise(t);
    return std::move(faults_);
  }

 private:
  const MeasuredColumns& measured_;
  const std::vector<Thermometer>& thermometers_;
  std::vector<ColumnFault> faults_;

  void Add(FaultKind kind, Index input, Rows rows, double value, Bounds held) {
    faults_.push_back(
        MakeFault(measured_, kind, input, std::move(rows), value, held));
  }

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
    const Rows rows = SoundRows(measured_, {&t, 1});
    const std::vector<double> values = ValuesAt(measured_, rows, t.input);
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
    if (!steps.empty()) {
      Add(FaultKind::kStep, t.input, steps, height, {0.0, 0.0});
    }
  }

  // Range over the sound rows within the bounds, or outside of them.
  double RangeOf(const Thermometer& t,
                 Index first,
                 Index last,
                 bool within) const {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (Index row = 0; row < measured_.target_values.size(); ++row) {
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
    const Rows sound = SoundRows(measured_, {&t, 1});
    const std::vector<double> values = ValuesAt(measured_, sound, t.input);
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
    // Who stays to the end, and never came back, needs one witness only.
    const bool to_the_end = rows.back() == sound.back();
    if (ranges_within.size() < (to_the_end ? 1 : 2)) return;
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
};

}  // namespace

std::vector<ColumnFault> FindThermometerFaults(
    const MeasuredColumns& measured,
    const std::vector<Thermometer>& thermometers) {
  return ThermometerFaultFinder(measured, thermometers).Find();
}

}  // namespace errmap::data
