#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "data/measurements/clock/date_time.h"

namespace errmap::data {

/// True if a name begins with "time" or "zeit", the default names of the column
/// of times, and is not a temperature.
bool NamesTime(std::string_view name);

/// A time step of more than this many median steps is a break.
inline constexpr double kLeapSteps = 20.0;

/// Returns the median of the steps above 0 (the lower of two), infinite if
/// there is none.
double MedianStep(std::vector<double> steps);
/// Returns the same for the steps of `time`, and how often it goes back.
double MedianStepOf(const Eigen::VectorXd& time);
Eigen::Index TimesBack(const Eigen::VectorXd& time);

/// A unit in which columns count time: "s", "ms", "us", "100ns", "ns", "min",
/// "h", "days".
struct TimeUnit {
  std::string_view name;
  double seconds;
};
/// Returns null if there is none of that name.
const TimeUnit* FindTimeUnit(std::string_view name);
/// Returns the unit of time in a column's name; null: none.
const TimeUnit* StatedUnit(std::string_view column);

/// Steps and span of times, unconverted.
struct Pace {
  double least = 0.0;
  double most = 0.0;
  double step = 0.0;  // median of those above 0

  /// True if these are plausible for a measurement: steps of 0.01 s to a day,
  /// under ten years.
  bool MayBeIn(const TimeUnit& unit) const;
};
/// NaN is ignored.
Pace PaceOf(std::vector<double> values);

/// The zero from which numbers count, and their unit.
struct Epoch {
  const TimeUnit* unit;
  double offset;  // seconds from 1970 to 0

  bool counts_days() const { return unit->seconds == kSecondsOfDay; }
};
/// Content of a column according to its name.
enum class Named { kNothing, kTime, kDate };
/// Recognises numbers that count from 1970, whatever the unit in their name. In
/// each unit, the years 1990 to 2060 give other numbers, and others again in
/// Windows' 100 ns since 1601. Day numbers of Excel (and MATLAB) look like
/// other numbers. In a column of dates all of them count; in one of times, only
/// those with fractions of days.
std::optional<Epoch> EpochOf(const Pace& pace, Named called);
/// Days from a column's epoch to 1970, if its name states the epoch: "JD",
/// "BJD", "HJD" (from noon, 4713 BC), "MJD", "days since 1970". Its values must
/// be recent dates.
std::optional<double> NamedDays(std::string_view column);
std::optional<Epoch> NamedEpoch(std::string_view column, const Pace& pace);

/// Steps from row to row: forwards and backwards.
struct Steps {
  std::size_t on = 0;
  std::size_t back = 0;

  /// True if time advances in most of these rows and goes back in few.
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
/// True if all values are Excel's day numbers, 1990 to 2060, or missing (NaN).
bool AreWholeDays(const std::vector<double>& values);

/// Returns the seconds of a number such as 20260302080000; NaN for any other
/// number.
double SecondsOfDigits(double number);

}  // namespace errmap::data
