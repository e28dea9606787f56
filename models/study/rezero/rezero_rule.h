#pragma once

#include <limits>
#include <string>
#include <string_view>

#include "data/measurements/dataset.h"

namespace errmap::models {

/// When a machine's offset is set anew.
enum class RezeroKind {
  kEvery,    // so long after the last time
  kSession,  // where a session begins
  kProbe,    // with each group of rows, each row where there are no groups
};

/// How maps are re-zeroed where they are judged.
struct RezeroRule {
  RezeroKind kind = RezeroKind::kSession;
  /// Of kEvery, in the data's time unit (s), above 0; else infinite.
  double interval = std::numeric_limits<double>::infinity();
  double noise = 0.0;  // sd of a probe, target's unit, at least 0
  std::string text;    // as it was given
};

/// Of "2h", "90min", "30s", "1d", "session", "probe"; a bare number counts in
/// seconds, or in whatever a time column without a unit counts, such as cycles.
/// Behind `:noise=` stands what the caller reads, who knows the target's unit:
/// it goes to `noise` ("": nothing). Throws std::invalid_argument, to follow
/// the name of what is given.
RezeroRule ParseRezero(std::string_view text, std::string* noise);

/// Throws std::invalid_argument where the rows of `dataset` have no times for
/// the rule to count in, or no order at all.
void RequireTimes(const RezeroRule& rule, const data::Dataset& dataset);

}  // namespace errmap::models
