#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "models/record.h"

// The effect of re-zeroing on maps, and on no map.

namespace errmap::models {

struct RezeroedModelRecord {
  std::string model;
  double rmse = kNotKnown;
  double never = kNotKnown;  // the same rows without re-zeroing
};

struct RezeroIntervalRecord {
  double interval = kNotKnown;  // s; NaN: once a session
  double map = kNotKnown;
  double no_map = kNotKnown;
};

/// See RezeroRule and RezeroWorth.
struct RezeroRecord {
  std::string rule;             // as given
  std::string when;             // "interval", "session", "probe"
  double interval = kNotKnown;  // s; only for "interval"
  double noise = kNotKnown;
  std::string holdout;
  std::int64_t probes = 0;
  std::int64_t scored_rows = 0;
  double no_map = kNotKnown;
  std::vector<RezeroedModelRecord> models;
  std::vector<RezeroIntervalRecord> curve;  // of the recommended map
  /// Re-zeroing that the map needs to match no map under the rule: "every"
  /// interval, "session", "never"; "more": even the rule is not enough.
  std::string needs;
  double needs_interval = kNotKnown;  // s; only for "every"
  std::string sentence;
};

}  // namespace errmap::models
