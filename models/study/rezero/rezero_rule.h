#pragma once

#include <limits>
#include <string>
#include <string_view>

#include "data/measurements/dataset.h"

namespace errmap::models {

/// Occasions on which the offset of a machine is reset.
enum class RezeroKind {
  kEvery,    // after this time since the last one
  kSession,  // at the start of a session
  kProbe,    // at each group of rows, or each row without groups
};

/// Rule for re-zeroing maps when they are judged.
struct RezeroRule {
  RezeroKind kind = RezeroKind::kSession;
  /// For kEvery, in the data's time unit (s), above 0; else infinite.
  double interval = std::numeric_limits<double>::infinity();
  double noise = 0.0;  // sd of a probe, target's unit, at least 0
  std::string text;    // as given
};

/// Parses "2h", "90min", "30s", "1d", "session", "probe". A bare number is in
/// seconds, or in the unit of a time column without a unit, such as cycles.
/// Copies the text after `:noise=` to `noise` ("": none) for the caller, who
/// knows the target's unit. Throws std::invalid_argument; its text continues
/// after the argument's name.
RezeroRule ParseRezero(std::string_view text, std::string* noise);

/// Throws std::invalid_argument if the rows of `dataset` lack the times that
/// the rule needs, or have no order.
void RequireTimes(const RezeroRule& rule, const data::Dataset& dataset);

}  // namespace errmap::models
