#include "cli/report/text/answers/rezero_text.h"

#include <cctype>

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
  return fmt::format("{:.3g} of {}", seconds, data::Printable(column));
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

}  // namespace errmap::report
