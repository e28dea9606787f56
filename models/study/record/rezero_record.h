#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "models/record.h"

// The effect of re-zeroing on the error with a map and without one.

namespace errmap::models {

struct RezeroedModelRecord {
  std::string model;
  double rmse = kNotKnown;
  double never = kNotKnown;  // the same rows without re-zeroing
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
};

}  // namespace errmap::models
