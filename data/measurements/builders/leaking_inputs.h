#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"

namespace errmap::data {

/// Inputs that together determine the target, within the rounding of all of
/// them.
struct Leak {
  std::vector<Eigen::Index> inputs;    // indices, one to three
  std::vector<Eigen::Index> left_out;  // of these, those that hold the error
  /// "error_mm = actual_mm - nominal_mm", "|error_um| is above 3 where bad is
  /// 1".
  std::string statement;
};

/// Finds components of the error itself among the inputs (m x p) of a target
/// (m), by least squares on the rows. Examples are the measured next to the
/// nominal position, or a copy in another unit or in ppm of the position.
/// Others are two halves, the size of the error, or whether it exceeds a limit.
/// Encoder counts are recognised by the axis. Temperatures, times, and
/// positions alone are states of a machine, never parts of its error: a target
/// that is a plain function of them has a good map. Positions or a few settings
/// in such a set are kept.
std::vector<Leak> FindLeaks(const ColumnInfo& target,
                            const Eigen::VectorXd& target_values,
                            const std::vector<ColumnInfo>& inputs,
                            const Eigen::MatrixXd& input_values);

}  // namespace errmap::data
