#include "data/measurements/reading/nights.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "data/argument_name.h"
#include "data/input_error.h"
#include "data/measurements/clock/date_time.h"
#include "data/measurements/clock/time_units.h"
#include "data/text.h"

namespace errmap::data {
namespace {

using Eigen::Index;

constexpr double kOtherOrder = 3.0;  // a night per pause between passes

}  // namespace

Nights FindNights(const Eigen::VectorXd& time,
                  const Motion& motion,
                  bool dated) {
  const bool by_passes = motion.is_commanded && motion.num_passes >= 2;
  std::vector<double> between;  // passes
  std::vector<double> within;
  // A pass that goes on the next day is broken by a night all the same.
  constexpr double kBreak = 10.0;
  const double longest_step =
      std::max(kShortestNight, kBreak * MedianStepOf(time));
  Index other_dates = 0;
  for (Index i = 1; i < time.size(); ++i) {
    const double step = time[i] - time[i - 1];
    if (!(step > 0.0)) continue;
    const auto at = static_cast<std::size_t>(i);
    const bool is_between = !by_passes ||
                            motion.passes[at] != motion.passes[at - 1] ||
                            step > longest_step;
    (is_between ? between : within).push_back(step);
    if (is_between && std::floor(time[i] / kSecondsOfDay) !=
                          std::floor(time[i - 1] / kSecondsOfDay)) {
      ++other_dates;
    }
  }
  Nights nights{.gap = INFINITY};
  if (between.empty()) return nights;
  std::ranges::sort(between);
  const double longest_within =
      within.empty() ? 0.0 : *std::ranges::max_element(within);
  for (std::size_t i = 1; i < between.size(); ++i) {
    const double low = between[i - 1];
    const double high = between[i];
    if (high < kOtherOrder * low) continue;
    if (high >= kShortestNight) {
      // A break that parts no pass is no night.
      nights.gap = std::sqrt(
          (longest_within < high ? std::max(low, longest_within) : low) * high);
      return nights;
    }
    // A break, yet no night: lunch, or sessions by the hour.
    if (high >= kBreak * low) nights.other = std::sqrt(low * high);
  }
  nights.sure = nights.other == 0.0;
  if (!by_passes || between.front() < kShortestNight) return nights;
  // Every pass hours after the one before: days of one pass, or a slow run.
  if (longest_within * kOtherOrder > between.front()) return nights;
  const double gap = longest_within > 0.0
                         ? std::sqrt(longest_within * between.front())
                         : between.front() / 2.0;
  const bool are_days = dated ? 2 * other_dates > std::ssize(between)
                              : between.front() >= 43200.0;
  (are_days ? nights.gap : nights.other) = gap;
  nights.sure = are_days;
  return nights;
}

Nights FindNights(const Clock& clock,
                  const Motion& motion,
                  const DatasetSelection& selection) {
  Nights nights = FindNights(clock.time, motion, clock.dated);
  if (!clock.is_found()) nights.gap = INFINITY;
  if (selection.gap.empty()) return nights;
  const std::optional<double> gap = ParseInterval(selection.gap);
  if (!gap) {
    throw InputError(ArgumentName("gap", selection.gap) +
                     ": is not a length of time; give 2h, 90min or 30s");
  }
  nights.gap = *gap;
  return nights;
}

}  // namespace errmap::data
