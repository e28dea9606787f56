#include "models/study/rezero/rezero_rule.h"

#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "data/argument_name.h"
#include "data/text.h"

namespace errmap::models {
namespace {

[[noreturn]] void RefuseRule(std::string_view text) {
  throw std::invalid_argument(fmt::format(
      "must be an interval such as 2h or 90min, session or probe, and may end "
      "in :noise=0.5um; found {}",
      data::QuotedText(text)));
}

}  // namespace

RezeroRule ParseRezero(std::string_view text, std::string* noise) {
  constexpr std::string_view kNoise = ":noise=";
  const std::string_view when = text.substr(0, text.find(':'));
  const std::string_view rest = text.substr(when.size());
  if (!rest.empty() &&
      (!rest.starts_with(kNoise) || rest.size() == kNoise.size())) {
    RefuseRule(text);
  }
  *noise = rest.empty() ? "" : rest.substr(kNoise.size());
  RezeroRule rule;
  rule.text = text;
  if (when == "session") {
    rule.kind = RezeroKind::kSession;
  } else if (when == "probe") {
    rule.kind = RezeroKind::kProbe;
  } else {
    rule.kind = RezeroKind::kEvery;
    const std::optional<double> interval = data::ParseInterval(when);
    if (!interval) RefuseRule(text);
    rule.interval = *interval;
  }
  return rule;
}

void RequireTimes(const RezeroRule& rule, const data::Dataset& dataset) {
  const data::SessionLog* log = dataset.log().get();
  if (log != nullptr &&
      (rule.kind != RezeroKind::kEvery || log->time_unit == "s")) {
    return;
  }
  throw std::invalid_argument(fmt::format(
      "{} {} needs times, and there are none: name their column with {} (one "
      "of cycles will do, and {} 5 then means every five), or re-zero by "
      "session or probe",
      data::ArgumentName("rezero"),
      rule.text,
      data::ArgumentName("time"),
      data::ArgumentName("rezero")));
}

}  // namespace errmap::models
