#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "data/measurements/date_time.h"

namespace errmap::data {

/// A unit in which columns count time: "s", "ms", "us", "100ns", "ns", "min",
/// "h", "days".
struct TimeUnit {
  std::string_view name;
  double seconds;
};
/// Null where there is none of that name.
const TimeUnit* FindTimeUnit(std::string_view name);
/// What a column's name says of the unit of its times; null: nothing.
const TimeUnit* StatedUnit(std::string_view column);

/// Steps and span of times as they stand.
struct Pace {
  double least = 0.0;
  double most = 0.0;
  double step = 0.0;  // median of those above 0

  /// Those of a measurement: steps of 0.01 s to a day, under ten years.
  bool MayBeIn(const TimeUnit& unit) const;
};
/// NaN apart.
Pace PaceOf(std::vector<double> values);

/// Where numbers count from, and in which unit.
struct Epoch {
  const TimeUnit* unit;
  double offset;  // seconds from 1970 to 0

  bool counts_days() const { return unit->seconds == kSecondsOfDay; }
};
/// What the column's name says, which days that Excel counts need.
enum class Named { kNothing, kTime, kDate };
/// Numbers that count from 1970 whatever their unit is called: the years 1990
/// to 2060 in each unit do not meet; nor do Windows' 100 ns from 1601. Excel's
/// (and MATLAB's) days are numbers as others, too: of a date any, of a time
/// such as part days.
std::optional<Epoch> EpochOf(const Pace& pace, Named called);
/// Days from 0 to 1970 of what a column counts by its name: "JD", "BJD", "HJD"
/// (from noon, 4713 BC), "MJD", "days since 1970"; and where its values are of
/// our time.
std::optional<double> NamedDays(std::string_view column);
std::optional<Epoch> NamedEpoch(std::string_view column, const Pace& pace);

/// Steps from row to row: up, and back.
struct Steps {
  std::size_t on = 0;
  std::size_t back = 0;

  /// Up with most of so many rows, and seldom back.
  bool GoForward(std::size_t rows) const {
    constexpr std::size_t kSeldom = 10;
    return 2 * on > rows && kSeldom * back < rows;
  }
};
template <typename Values>
Steps StepsOf(const Values& values) {
  Steps steps;
  for (std::size_t i = 1; i < values.size(); ++i) {
    steps.on += values[i] > values[i - 1] ? 1 : 0;
    steps.back += values[i] < values[i - 1] ? 1 : 0;
  }
  return steps;
}

/// Excel counts days from 30 December 1899.
inline constexpr double kExcelDaysTo1970 = 25569.0;
/// Whether all are Excel's numbers of days, 1990 to 2060, or missing (NaN).
bool AreWholeDays(const std::vector<double>& values);

/// Seconds of 20260302080000; NaN where it is no such number.
double SecondsOfDigits(double number);

}  // namespace errmap::data
