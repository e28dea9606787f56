#include "cli/report/text/commands/when_text.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "cli/report/number_text.h"
#include "cli/report/text/answers/component_numbers.h"
#include "cli/report/text/answers/rezero_text.h"
#include "data/column_header.h"
#include "data/text.h"

namespace errmap::report {
namespace {

using models::ZeroSchedule;
using models::ZeroTrigger;

std::string EveryText(const ZeroTrigger& clock) {
  return std::isfinite(clock.time) ? "every " + DurationText(clock.time)
                                   : "as a session begins";
}

std::string TemperatureText(const models::HeldOutErrors& errors) {
  return data::Printable(errors.temperature);
}

// "1.5 degC of t11_degC".
std::string ChangeText(const models::HeldOutErrors& errors, double change) {
  return fmt::format(
      "{} of {}",
      WithSymbol(fmt::format("{:.2g}", change),
                 data::UnitOfColumn(errors.temperature).display_symbol),
      TemperatureText(errors));
}

std::string RuleText(const ZeroTrigger& trigger,
                     const models::HeldOutErrors& errors) {
  const std::string change = ChangeText(errors, trigger.temperature);
  if (!std::isfinite(trigger.time)) {
    return fmt::format("a probe with each change by {}", change);
  }
  return fmt::format(
      "a probe after {} or a change by {}, or when the two shares add up to 1",
      DurationText(trigger.time),
      change);
}

std::string RuleSentence(const ZeroSchedule& schedule,
                         const models::HeldOutErrors& errors,
                         const ErrorText& error) {
  const ZeroSchedule::Rule& rule = *schedule.rule;
  if (!rule.established) {
    return fmt::format(
        "A rule by temperature ({}) is not proven better: keep to the clock.",
        TemperatureText(errors));
  }
  return fmt::format(
      "Better: {}. In sessions not used to find it, it leaves {}, not {} RMSE, "
      "with no more probes, and is better in {} of {}.",
      RuleText(rule.trigger, errors),
      error(rule.rmse),
      error.WithUnit(rule.clock_rmse),
      rule.better,
      schedule.sessions);
}

std::string TableRow(const std::string& when,
                     const models::ZeroedErrors& clock,
                     const ErrorText& error) {
  return fmt::format("{:<24} {:>17.1f} {:>9} {:>11}\n",
                     when,
                     clock.probes,
                     error(clock.rmse),
                     error(clock.within_90));
}

ErrorText ErrorTextFor(const ZeroSchedule& schedule, const data::Unit& unit) {
  return ErrorText(unit, schedule.clocks.front().rmse);
}

// Without a goal: what the intervals do for the RMSE.
std::string IntervalsText(const ZeroSchedule& schedule,
                          const ErrorText& error) {
  const models::ZeroedErrors& best = *std::ranges::min_element(
      schedule.clocks, {}, &models::ZeroedErrors::rmse);
  if (!(best.rmse < schedule.none.rmse)) {
    return fmt::format(
        "No probe helps: without one the error is lowest, {} RMSE.\n",
        error.WithUnit(schedule.none.rmse));
  }
  std::string text = fmt::format(
      "A probe {} gives the lowest error, {} RMSE; no probe gives {}.",
      EveryText(best.trigger),
      error.WithUnit(best.rmse),
      error.WithUnit(schedule.none.rmse));
  // By rising interval: from the first on that, with all after it, is no
  // better than none.
  auto worse = schedule.clocks.end();
  while (worse != schedule.clocks.begin() &&
         !(std::prev(worse)->rmse < schedule.none.rmse)) {
    --worse;
  }
  if (worse != schedule.clocks.end()) {
    text +=
        fmt::format(" A probe {}{} is worse than none.",
                    EveryText(worse->trigger),
                    std::isfinite(worse->trigger.time) ? " or less often" : "");
  }
  return text + " --goal 2um finds the interval that reaches it.\n";
}

std::string NoProbeText(const ZeroSchedule& schedule,
                        const models::FittedModel& fitted,
                        const ErrorText& error,
                        double goal) {
  const auto& interval = fitted.interval;
  const std::string within = error.WithUnit(schedule.none.within_90);
  if (!interval || !(interval->levels[0].half_width > goal)) {
    return fmt::format(
        "No probe is needed: 90 % of the errors are within {} without one.\n",
        within);
  }
  // Few sessions promise less of another than they show of themselves.
  return fmt::format(
      "Take a few probes in each new {} (errmap check): 90 % of the errors may "
      "reach {} there. In the {} {} measured they stay within {} without a "
      "probe.\n",
      interval->unit,
      error.WithUnit(interval->levels[0].half_width),
      interval->units,
      PluralOf(interval->unit),
      within);
}

}  // namespace

std::string ZeroAdvice(const ZeroSchedule& schedule,
                       const models::FittedModel& fitted,
                       double goal) {
  if (std::isnan(goal)) return "";
  const models::HeldOutErrors& errors = *fitted.held_out;
  const ErrorText error = ErrorTextFor(schedule, fitted.target.unit);
  if (schedule.no_probe_serves) {
    return NoProbeText(schedule, fitted, error, goal);
  }
  if (!schedule.clock) {
    const models::ZeroedErrors& best = *std::ranges::min_element(
        schedule.clocks, {}, &models::ZeroedErrors::within_90);
    return fmt::format(
        "No interval keeps 90 % of the errors within {}. A probe {} leaves {}, "
        "no probe {}.\n",
        error.WithUnit(goal),
        EveryText(best.trigger),
        error.WithUnit(best.within_90),
        error.WithUnit(schedule.none.within_90));
  }
  std::string text =
      fmt::format("A probe {} keeps 90 % of the errors within {}.",
                  EveryText(schedule.clock->trigger),
                  error.WithUnit(goal));
  if (schedule.rule) text += " " + RuleSentence(schedule, errors, error);
  return text + "\n";
}

std::string WhenText(const ZeroSchedule& schedule,
                     const models::FittedModel& fitted,
                     double goal) {
  const ErrorText error = ErrorTextFor(schedule, fitted.target.unit);
  std::string text = fmt::format("{:<24} {:>17} {:>9} {:>11}\n",
                                 "a probe",
                                 "probes a session",
                                 "RMSE, " + error.symbol(),
                                 "90 % within");
  text += TableRow("no probe", schedule.none, error);
  for (const models::ZeroedErrors& clock : schedule.clocks) {
    text += TableRow(EveryText(clock.trigger), clock, error);
  }
  return text + "\n" +
         (std::isnan(goal) ? IntervalsText(schedule, error)
                           : ZeroAdvice(schedule, fitted, goal));
}

std::string ZeroDueText(const ZeroTrigger& advised,
                        const models::HeldOutErrors& errors,
                        double age,
                        double change) {
  std::string since = DurationText(age) + " since the last probe";
  if (!advised.is_clock()) {
    since += fmt::format(", a change by {}", ChangeText(errors, change));
  }
  const double spent = advised.Spent(age, change);
  if (spent >= 1.0) return since + ": probe now.\n";
  if (!std::isfinite(advised.time)) {
    return since + ": no probe is due yet.\n";
  }
  return fmt::format(
      "{}: probe in {}{}.\n",
      since,
      DurationText((1.0 - spent) * advised.time),
      advised.is_clock() ? "" : ", sooner if the temperature changes further");
}

}  // namespace errmap::report
