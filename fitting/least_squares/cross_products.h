#pragma once

#include <Eigen/Core>

namespace errmap::fitting {

/// Sums over rows of the products of k columns and a response: all that least
/// squares, ridge and lasso need of the rows. They add and subtract, so that
/// the rows of each fold are passed over once. Columns should be near mean 0
/// and sd 1: what cancels in a variance is lost here.
struct CrossProducts {
  double weight = 0.0;            // sum of w
  Eigen::VectorXd columns;        // (k) sum of w x
  Eigen::MatrixXd products;       // (k x k) sum of w x x', lower triangle
  double response = 0.0;          // sum of w y
  double response_square = 0.0;   // sum of w y y
  Eigen::VectorXd with_response;  // (k) sum of w x y

  CrossProducts& operator+=(const CrossProducts& other);
  CrossProducts& operator-=(const CrossProducts& other);
};

/// Of no rows.
CrossProducts NoRows(Eigen::Index num_columns);

/// Of the rows of `columns` (n x k) and `response` (n); `weights` (n) not
/// negative, or (0): all 1.
CrossProducts SumProducts(const Eigen::MatrixXd& columns,
                          const Eigen::VectorXd& response,
                          const Eigen::VectorXd& weights);

}  // namespace errmap::fitting
