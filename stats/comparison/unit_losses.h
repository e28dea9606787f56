#pragma once

#include <vector>

#include "stats/eigen.h"

namespace errmap::stats {

/// Held-out losses of several models on the same rows, gathered by unit of
/// analysis: a cycle, day, segment or block of rows. Neighbouring rows resemble
/// each other, so tests count units, never rows.
struct UnitLosses {
  MatrixXd mean_squares;      // (units x models), squared target units
  VectorXd rows;              // (units) rows, or sums of weights, above 0
  MatrixXd means = {};        // (units x models) residual, or empty
  bool time_ordered = false;  // true: units are in time order

  Index num_units() const { return mean_squares.rows(); }
  Index num_models() const { return mean_squares.cols(); }

  /// Returns (units x pairs) each unit's contribution to the difference of
  /// pooled mean squares of models first[i] and second[i]. This is its loss
  /// difference times its share of the rows, scaled to mean 1.
  MatrixXd Differences(const std::vector<Index>& first,
                       const std::vector<Index>& second) const;

  /// Throws std::invalid_argument unless the shapes agree, every mean square is
  /// finite and at least 0, and every unit has rows.
  void Validate() const;
};

/// Gathers `residuals` (rows x models) by the unit code of each row. Units are
/// in ascending order of code; codes without rows are skipped. Throws
/// std::invalid_argument if the number of codes differs from that of rows, a
/// code is negative or a residual is not finite.
UnitLosses GatherByUnit(const MatrixXd& residuals,
                        const std::vector<Index>& unit_codes);

/// Returns a block number per row, 0, 0, ..., 1, 1, ..., for data without
/// groups. The rows, in order, form min(20, num_rows / 5) blocks (at least
/// one). Lengths differ by at most one row, longer ones first.
std::vector<Index> BlocksInOrder(Index num_rows);

/// Returns the RMSE of each model (models), pooled over all rows: sqrt(sum(rows
/// * mean_square) / sum(rows)). NaN if there are no units.
VectorXd PooledRmse(const UnitLosses& losses);

/// Returns each unit's contribution to the pooled `rmse` (models), to first
/// order (units x models): w (L - M) / (2 sqrt(M) mean(w)) for rows w, loss L
/// and pooled mean square M. Each column has mean 0.
MatrixXd InfluenceOnRmse(const UnitLosses& losses, const VectorXd& rmse);

}  // namespace errmap::stats
