#pragma once

#include "stats/eigen.h"

namespace errmap::fitting {

/// Sums over rows of the products of k columns and a response: all that least
/// squares, ridge and lasso need. They can be added and subtracted, so one pass
/// over the rows serves all folds. Columns should have mean near 0 and sd near
/// 1: otherwise cancellation loses digits.
struct CrossProducts {
  double weight = 0.0;           // sum of w
  VectorXd columns;              // (k) sum of w x
  MatrixXd products;             // (k x k) sum of w x x', lower triangle
  double response = 0.0;         // sum of w y
  double response_square = 0.0;  // sum of w y y
  VectorXd with_response;        // (k) sum of w x y

  CrossProducts& operator+=(const CrossProducts& other);
  CrossProducts& operator-=(const CrossProducts& other);
};

/// Returns sums over zero rows.
CrossProducts NoRows(Index num_columns);

/// Sums over the rows of `columns` (n x k) and `response` (n). `weights` (n)
/// must not be negative; (0): all 1.
CrossProducts SumProducts(const MatrixXd& columns,
                          const VectorXd& response,
                          const VectorXd& weights);

}  // namespace errmap::fitting
