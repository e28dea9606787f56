#pragma once

#include "stats/eigen.h"

namespace errmap::fitting {

/// Sums over rows of the products of k columns and a response: least squares,
/// ridge and lasso need nothing else. They can be added and subtracted, so one
/// pass over the rows serves all folds. Columns should be near mean 0 and sd 1:
/// digits that cancel in a variance are lost here.
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

/// Sums over no rows.
CrossProducts NoRows(Index num_columns);

/// Sums over the rows of `columns` (n x k) and `response` (n). `weights` (n)
/// must not be negative; (0): all 1.
CrossProducts SumProducts(const MatrixXd& columns,
                          const VectorXd& response,
                          const VectorXd& weights);

}  // namespace errmap::fitting
