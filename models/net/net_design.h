#pragma once

#include <cstdint>

#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/net/net_problem.h"

namespace errmap::models {

/// Scaling of inputs: to mean 0 and sd 1, to their range, or none.
enum class InputScaling { kStandard, kRange, kNone };

/// Structure of a net before it sees any rows.
struct NetDesign {
  std::int64_t hidden = 20;
  InputScaling scaling = InputScaling::kStandard;
  OutputFunction output = OutputFunction::kSigmoid;
  double slope = 1.0;
  bool free_biases = false;

  NetShape ShapeFor(const data::Dataset& dataset) const {
    return {dataset.num_inputs(), hidden, 1, output, slope, free_biases};
  }
};

}  // namespace errmap::models
