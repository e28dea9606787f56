#pragma once

#include <string>
#include <vector>

#include "models/error_model.h"

namespace errmap::models {

/// An input of a map with values outside of its trained range.
struct InputOutside {
  Eigen::Index input = 0;     // index into the map's inputs
  Eigen::Index num_rows = 0;  // of those given that lie outside
  double min = 0.0;           // of the values given, input's unit
  double max = 0.0;
  /// Where most rows lie outside: the unit in which the figures would lie
  /// within, such as "K" for 293 in a column of degC; "" where there is none.
  std::string looks_like = {};
};

/// The inputs that leave their trained range in some row of `values` (m x p),
/// in the map's order.
std::vector<InputOutside> InputsOutside(const std::vector<TrainedInput>& inputs,
                                        const Eigen::MatrixXd& values);

/// Whether all inputs of a row lie within their trained range.
bool IsInside(const std::vector<TrainedInput>& inputs,
              const Eigen::MatrixXd& values,
              Eigen::Index row);

}  // namespace errmap::models
