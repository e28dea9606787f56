#pragma once

#include <string>
#include <vector>

#include "stats/eigen.h"

namespace errmap::models {

/// scaled = (x - offset) * scale, column by column.
struct ColumnScaling {
  VectorXd offset;  // (p) unit of the column
  VectorXd scale;   // (p) per unit of the column

  /// Returns a scaled copy of `values` (m x p).
  MatrixXd Apply(const MatrixXd& values) const;
};

/// Leaves every value unchanged.
ColumnScaling IdentityScaling(Index num_columns);

/// Maps the range of each column to [0, 1], and a constant column to 0.
ColumnScaling UnitRangeScaling(const MatrixXd& values);

/// Maps each column to mean 0 and sd 1 (n - 1), and a constant column to 0.
ColumnScaling StandardScaling(const MatrixXd& values);

/// Maps each column to mean square 1 and keeps its zero; zeros stay 0.
ColumnScaling RootMeanSquareScaling(const MatrixXd& values);

/// Returns for each column (p) of `values` (m x p) the RMS deviation from the
/// means of all columns with its unit. 1 if that is 0. So a thermometer that
/// hardly moves is not magnified.
VectorXd SpreadsOfUnits(const MatrixXd& values,
                        const std::vector<std::string>& units);

/// z = slope t + offset, from error t in the target's unit to a net's output.
struct TargetScaling {
  double slope = 1.0;
  double offset = 0.0;
};

/// Maps the range of `targets` to 0.01 .. 0.99, the sigmoid's usable range
/// (NISTIR 5367, Appendix A, getpat). Throws std::invalid_argument if the
/// targets do not vary.
TargetScaling SigmoidTargetScaling(const Eigen::Ref<const MatrixXd>& targets);

}  // namespace errmap::models
