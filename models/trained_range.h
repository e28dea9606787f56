#pragma once

#include <string>
#include <vector>

#include "models/error_model.h"

namespace errmap::models {

/// An input of a map with values outside its trained range.
struct InputOutside {
  Eigen::Index input = 0;     // index into the map's inputs
  Eigen::Index num_rows = 0;  // number of given rows that lie outside
  double min = 0.0;           // of the given values, input's unit
  double max = 0.0;
  /// If most readings lie outside: the unit in which the values fit the range,
  /// such as "K" for 293 in a column of degC; "" if none does.
  std::string looks_like = {};
};

/// Returns the inputs that leave their trained range in some row of `values` (m
/// x p; NaN where a cell is empty, which counts as no reading), in the map's
/// order.
std::vector<InputOutside> InputsOutside(const std::vector<TrainedInput>& inputs,
                                        const Eigen::MatrixXd& values);

/// True if all inputs of a row lie within their trained range.
bool IsInside(const std::vector<TrainedInput>& inputs,
              const Eigen::MatrixXd& values,
              Eigen::Index row);

}  // namespace errmap::models
