#include "fitting/least_squares/cross_products.h"

#include "fitting/interruption.h"
#include "fitting/matrix_product.h"

namespace errmap::fitting {

CrossProducts& CrossProducts::operator+=(const CrossProducts& other) {
  weight += other.weight;
  columns += other.columns;
  products += other.products;
  response += other.response;
  response_square += other.response_square;
  with_response += other.with_response;
  return *this;
}

CrossProducts& CrossProducts::operator-=(const CrossProducts& other) {
  weight -= other.weight;
  columns -= other.columns;
  products -= other.products;
  response -= other.response;
  response_square -= other.response_square;
  with_response -= other.with_response;
  return *this;
}

CrossProducts NoRows(Index num_columns) {
  CrossProducts sums;
  sums.columns.setZero(num_columns);
  sums.products.setZero(num_columns, num_columns);
  sums.with_response.setZero(num_columns);
  return sums;
}

CrossProducts SumProducts(const MatrixXd& columns,
                          const VectorXd& response,
                          const VectorXd& weights) {
  CrossProducts sums = NoRows(columns.cols());
  if (columns.rows() == 0) return sums;
  ThrowIfInterrupted();
  VectorXd weighted = response;
  MatrixXd rooted;
  if (weights.size() != 0) {
    weighted.array() *= weights.array();
    sums.weight = weights.sum();
    sums.columns = columns.transpose() * weights;
    rooted = weights.cwiseSqrt().asDiagonal() * columns;
  } else {
    sums.weight = static_cast<double>(columns.rows());
    sums.columns = columns.colwise().sum().transpose();
  }
  sums.response = weighted.sum();
  sums.response_square = weighted.dot(response);
  sums.with_response = columns.transpose() * weighted;
  if (columns.cols() != 0) {
    MultiplyOwnTransposeBy(weights.size() != 0 ? rooted : columns,
                           sums.products);
  }
  return sums;
}

}  // namespace errmap::fitting
