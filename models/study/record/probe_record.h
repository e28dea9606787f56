#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "models/study/record/record.h"
#include "models/study/record/record_values.h"

// What probes of a session are worth.

namespace errmap::models {

struct ProbedModelRecord {
  std::string model;
  std::vector<double> rmse;  // as `numbers` of the whole
};

/// What probes of a session would make of each model on sessions held out.
struct ProbesRecord {
  std::string holdout;
  std::string unit;
  double spacing = kNotKnown;  // in time_unit
  std::string time_unit;
  std::vector<std::int64_t> numbers;
  std::int64_t scored_rows = 0;
  std::vector<ProbedModelRecord> models;
};

}  // namespace errmap::models
