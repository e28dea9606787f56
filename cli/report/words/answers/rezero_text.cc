#include "cli/report/words/answers/rezero_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "cli/report/report_view.h"
#include "data/text.h"

namespace errmap::report {
namespace {

using models::RezeroRecord;

constexpr double kMinute = 60.0;
constexpr double kHour = 3600.0;

// An interval in the words of the rule: of a bare number in what the time
// column counts.
std::string IntervalWords(const models::ComponentRecord& component,
                          double seconds) {
  const std::string& rule = component.rezero->rule;
  const std::string when = rule.substr(0, rule.find(':'));
  if (std::isdigit(static_cast<unsigned char>(when.back())) == 0) {
    return DurationText(seconds);
  }
  const std::string column = component.data.time.value_or("");
  return fmt::format(
      "{:.3g} of {}", seconds, data::Printable(column, column.size()));
}

std::string WhatItSaves(const models::ComponentRecord& component) {
  const RezeroRecord& rezero = *component.rezero;
  const std::string rule = "a probe " + RezeroRuleWords(component);
  const std::string without = fmt::format(" does what {} does without.", rule);
  if (rezero.needs == "never") {
    return "With this map no probe at all" + without;
  }
  if (rezero.needs == "more") {
    return "The map saves no probes: re-zeroed alike it errs more than no map.";
  }
  if (rezero.needs == "session" && rezero.when != "session") {
    return "With this map a probe once a session" + without;
  }
  if (rezero.needs == "session" || rezero.needs_interval == rezero.interval) {
    return fmt::format("With this map, too, {} is needed.", rule);
  }
  return "With this map a probe every " +
         IntervalWords(component, rezero.needs_interval) + without;
}

}  // namespace

std::string DurationText(double seconds) {
  if (seconds >= kHour) return fmt::format("{:.3g} h", seconds / kHour);
  if (seconds >= kMinute) return fmt::format("{:.3g} min", seconds / kMinute);
  return fmt::format("{:.3g} s", seconds);
}

std::string RezeroRuleWords(const models::ComponentRecord& component) {
  const RezeroRecord& rezero = *component.rezero;
  if (rezero.when == "session") return "once a session";
  return "every " + (rezero.when == "interval"
                         ? IntervalWords(component, rezero.interval)
                         : component.data.group.value_or("row"));
}

std::string RezeroedWords(const models::ComponentRecord& component) {
  return "re-zeroed " + RezeroRuleWords(component);
}

std::string RezeroSentence(const models::ComponentRecord& component) {
  if (!component.rezero || !component.recommendation) return "";
  const RezeroRecord& rezero = *component.rezero;
  const auto map = std::ranges::find(rezero.models,
                                     component.recommendation->model,
                                     &models::RezeroedModelRecord::model);
  if (map == rezero.models.end()) return "";
  const ErrorText error = ErrorTextOf(component);
  std::string text = fmt::format(
      "All of this is {}{}: {} with the map, {} with no map; the map never "
      "re-zeroed has {}",
      RezeroedWords(component),
      rezero.noise > 0.0
          ? fmt::format(" by probes of {}", error.WithUnit(rezero.noise))
          : "",
      error.WithUnit(map->rmse),
      error.WithUnit(rezero.no_map),
      error.WithUnit(map->never));
  text += map->never < map->rmse ? ", so that probes add more than they take. "
                                 : ". ";
  return map->model == "zero" ? text + "No map saves probes here."
                              : text + WhatItSaves(component);
}

}  // namespace errmap::report
