#pragma once

#include <vector>

#include <Eigen/Core>

namespace errmap::stats {

/// Held-out losses of several models on the same rows, gathered by unit of
/// analysis: the cycle, day, segment or block of rows that is met as a whole.
/// Neighbouring rows resemble each other, so tests count units, never rows.
struct UnitLosses {
  Eigen::MatrixXd mean_squares;  // (units x models), squared target units
  Eigen::VectorXd rows;          // (units) rows, or sums of weights, above 0
  Eigen::MatrixXd means = {};    // (units x models) residual, or empty
  std::vector<Eigen::Index> codes = {};  // (units) group code, or empty
  bool time_ordered = false;             // units stand in the order of time

  Eigen::Index num_units() const { return mean_squares.rows(); }
  Eigen::Index num_models() const { return mean_squares.cols(); }

  /// (units x pairs) what each unit adds to the difference of pooled mean
  /// squares of models first[i] and second[i]: its loss difference times its
  /// share of the rows, of mean 1.
  Eigen::MatrixXd Differences(const std::vector<Eigen::Index>& first,
                              const std::vector<Eigen::Index>& second) const;

  /// Throws std::invalid_argument unless the shapes agree, every mean square
  /// is finite and at least 0 and every unit has rows.
  void Validate() const;
};

/// Gathers `residuals` (rows x models) by the code of each row's unit; units
/// ascend by code, and codes that no row has are passed over. Throws
/// std::invalid_argument for a number of codes other than that of rows, a
/// negative code or a residual that is not finite.
UnitLosses GatherByUnit(const Eigen::MatrixXd& residuals,
                        const std::vector<Eigen::Index>& unit_codes);

/// A code per row, 0, 0, ..., 1, 1, ...: where there are no groups, rows in
/// order are cut into min(20, num_rows / 5) blocks, at least one, as equal as
/// can be, longer ones first.
std::vector<Eigen::Index> BlocksInOrder(Eigen::Index num_rows);

/// RMSE of each model (models) over all rows pooled:
/// sqrt(sum(rows * mean_square) / sum(rows)). NaN without units.
Eigen::VectorXd PooledRmse(const UnitLosses& losses);

/// What each unit adds to the pooled `rmse` (models), to first order (units x
/// models): w (L - M) / (2 sqrt(M) mean(w)) for rows w, loss L and pooled mean
/// square M. Each column's mean is 0.
Eigen::MatrixXd InfluenceOnRmse(const UnitLosses& losses,
                                const Eigen::VectorXd& rmse);

}  // namespace errmap::stats
