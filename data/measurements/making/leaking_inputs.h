#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"

namespace errmap::data {

/// Inputs that with one another give the target, to the rounding of all of
/// them.
struct Leak {
  std::vector<Eigen::Index> inputs;    // indices, one to three
  std::vector<Eigen::Index> left_out;  // of these, those that hold the error
  std::string formula;                 // "actual_mm - nominal_mm"
  bool of_size = false;                // the formula is of |target|
};

/// Finds the error's own parts among the inputs (m x p) of a target (m), by
/// least squares on the rows: the measured position beside the nominal one, a
/// copy in another unit or in ppm of the position, two halves, its size or
/// whether that exceeds a limit. Counts of an
/// encoder are told by the axis.
/// Temperatures, times, and positions by themselves are states of a machine,
/// never parts of its error: a target that is a plain function of them is a
/// good map. Of a set that has a position or a few settings in it, these stay.
std::vector<Leak> FindLeaks(const ColumnInfo& target,
                            const Eigen::VectorXd& target_values,
                            const std::vector<ColumnInfo>& inputs,
                            const Eigen::MatrixXd& input_values);

}  // namespace errmap::data
