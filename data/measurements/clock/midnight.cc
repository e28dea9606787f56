#include <algorithm>
#include <cmath>
#include <cstddef>

#include "data/measurements/clock/clock.h"
#include "data/measurements/clock/date_time.h"
#include "data/measurements/clock/time_units.h"
#include "data/measurements/column_checks.h"
#include "data/text.h"

namespace errmap::data {

using Eigen::Index;

namespace {

constexpr double kHalfADay = 43200.0;

// From 1:00 to 12:59 on each day, and back from 12 to 1 on one.
bool AreHoursOfHalves(const Eigen::VectorXd& time) {
  constexpr double kHour = 3600.0;
  bool any = false;
  for (Index i = 0; i < time.size(); ++i) {
    const double day = std::floor(time[i] / kSecondsOfDay);
    const double of_day = time[i] - kSecondsOfDay * day;
    if (of_day < kHour || of_day >= kHalfADay + kHour) return false;
    if (i == 0) continue;
    const double back = time[i - 1] - time[i];
    const bool same_day = std::floor(time[i - 1] / kSecondsOfDay) == day;
    any = any || (same_day && back > kHalfADay - kHour);
    if (same_day && back > 0.0 && back <= kHalfADay - kHour) return false;
  }
  return any;
}

}  // namespace

void GoOnOverMidnight(const CsvTable& table,
                      const std::vector<Index>& rows,
                      Clock* clock) {
  constexpr double kHour = 3600.0;
  if (!clock->is_found()) return;
  const double step = MedianStepOf(clock->time);
  if (!std::isfinite(step)) return;  // it never goes on
  const double most_off = std::min(kHour / 2.0, 3.0 * step);
  const bool halves =
      clock->dated && clock->unit == "date" && AreHoursOfHalves(clock->time);
  double added = 0.0;
  double last = clock->time.size() > 0 ? clock->time[0] : 0.0;
  for (Index i = 1; i < clock->time.size(); ++i) {
    const double now = clock->time[i];
    const double back = last - now;
    last = now;
    const bool new_day = std::floor(now / kSecondsOfDay) !=
                         std::floor((now + back) / kSecondsOfDay);
    if (halves && new_day) added = 0.0;
    if (clock->hours_alone && back > 0.0) {
      added += kSecondsOfDay;
    } else if (halves && back > kHalfADay - kHour && added == 0.0) {
      added = kHalfADay;
      if (clock->remarks.empty()) {
        clock->remarks.push_back(NameInRemark(table.At(clock->column).name) +
                                 " has hours from 1 to 12: those after 12 on "
                                 "one day are in the afternoon");
      }
    } else if (clock->dated && clock->unit == "date" && back > 0.0 &&
               back <= kHour + most_off) {
      const bool is_hour = std::abs(kHour - back) <= most_off;
      const double lost = is_hour ? kHour : back + step;
      added += lost;
      clock->remarks.push_back(
          table.Where(static_cast<std::size_t>(rows[i]),
                      table.At(clock->column).name) +
          ": the clock is set back by " +
          (is_hour ? "an hour, as when summer time ends; an hour is"
                   : Rounded(back / 60.0) + " min; " + Rounded(lost / 60.0) +
                         " min are") +
          " added from here on");
    }
    clock->time[i] += added;
  }
}

}  // namespace errmap::data
