#pragma once

#include <string>
#include <vector>

#include "models/error_model.h"

namespace errmap::models {

/// An input of a map with values outside its trained range.
struct InputOutside {
  Index input = 0;     // index into the map's inputs
  Index num_rows = 0;  // number of given rows that lie outside
  double min = 0.0;    // of the given values, input's unit
  double max = 0.0;
  /// If most readings lie outside: the unit in which the values fit the range,
  /// such as "K" for 293 in a column of degC; "" if none does.
  std::string looks_like = {};
};

/// Returns the inputs that leave their trained range in some row of `values` (m
/// x p; NaN if a cell is empty, which counts as no reading), in the map's
/// order.
std::vector<InputOutside> InputsOutside(const std::vector<TrainedInput>& inputs,
                                        const MatrixXd& values);

/// An impossible reading: a loose contact, or the value of a bus without an
/// answer (-127, 85).
struct Spike {
  Index input = 0;  // index into the map's inputs
  Index row = 0;
  double value = 0.0;  // input's unit
};

/// Finds such readings of the thermometers (m x p; NaN if a cell is empty),
/// sorted by input, then row. They differ from the median of their column and
/// from their neighbours by more than three trained ranges, at least 10 degC. A
/// column with fewer than three readings has none. Nor has a column if they are
/// more than a fifth (with fewer than ten readings, more than one).
std::vector<Spike> FindSpikes(const std::vector<TrainedInput>& inputs,
                              const MatrixXd& readings);

/// True if all inputs of a row lie within their trained range.
bool IsInside(const std::vector<TrainedInput>& inputs,
              const MatrixXd& values,
              Index row);

}  // namespace errmap::models
