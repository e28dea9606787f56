#include "models/sensors/first_readings.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Cholesky>

#include "fitting/least_squares/decompositions.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Variances of x' (tests/benchmarks/mornings.py).
constexpr double kShift = 25.0;   // of a column that may stand anywhere
constexpr double kShared = 25.0;  // of columns of one unit

// (s x s) What columns share.
MatrixXd SharedByUnits(const FittedModel& fitted) {
  const Applicability& trained = *fitted.applicability;
  const auto unit_of = [&](Index state) -> const std::string& {
    const Index input = trained.columns[static_cast<std::size_t>(state)];
    return fitted.inputs[static_cast<std::size_t>(input)].column.unit.symbol;
  };
  const Index size = trained.mean.size();
  return MatrixXd::NullaryExpr(size, size, [&](Index i, Index j) {
    return unit_of(i) == unit_of(j) ? kShared : 0.0;
  });
}

// How starts scatter, by those seen and, as these are few, by all rows, which
// count as a fifth of a session.
MatrixXd CovarianceAtStart(const SessionStarts& starts,
                           const MatrixXd& any_row) {
  constexpr double kAllRows = 0.2;
  constexpr double kLeastVariance = 1e-4;
  const auto sessions = static_cast<double>(starts.sessions);
  MatrixXd covariance = (1.0 + 1.0 / sessions) * starts.covariance +
                        kAllRows / sessions * any_row;
  covariance.diagonal().array() += kLeastVariance;
  return covariance;
}

}  // namespace

FirstReadings::StudentT::StudentT(const VectorXd& of_mean,
                                  const MatrixXd& covariance)
    : mean(of_mean) {
  const Eigen::LLT<MatrixXd> root(covariance);
  const Index size = covariance.rows();
  precision = root.solve(MatrixXd::Identity(size, size));
  log_determinant = 2.0 * root.matrixLLT().diagonal().array().log().sum();
}

double FirstReadings::StudentT::LogDensity(const VectorXd& scaled,
                                           Index shifted,
                                           double freedom) const {
  const VectorXd apart = scaled - mean;
  const VectorXd pulled = precision * apart;
  double square = apart.dot(pulled);
  double determinant = log_determinant;
  if (shifted >= 0) {
    // As with kShift more in the covariance (Sherman & Morrison 1950).
    const double wider = 1.0 + kShift * precision(shifted, shifted);
    square -= kShift * pulled[shifted] * pulled[shifted] / wider;
    determinant += std::log(wider);
  }
  const auto size = static_cast<double>(mean.size());
  return -0.5 * (determinant + (freedom + size) * std::log1p(square / freedom));
}

FirstReadings::FirstReadings(const FittedModel& fitted)
    : FirstReadings(
          *fitted.applicability,
          fitting::CholeskyInverse(fitted.applicability->sessions->precision),
          SharedByUnits(fitted)) {}

FirstReadings::FirstReadings(const Applicability& trained,
                             const MatrixXd& any_row,
                             const MatrixXd& shared)
    : trained_(trained),
      at_start_(trained.sessions->starts->mean,
                CovarianceAtStart(*trained.sessions->starts, any_row) + shared),
      any_row_(VectorXd::Zero(trained.mean.size()), any_row + shared) {}

VectorXd FirstReadings::Scaled(const VectorXd& readings) const {
  return (readings - trained_.mean).cwiseQuotient(trained_.scale);
}

double FirstReadings::Shift(const VectorXd& readings, Index column) const {
  const VectorXd apart = Scaled(readings) - at_start_.mean;
  return at_start_.precision.col(column).dot(apart) /
         at_start_.precision(column, column) * trained_.scale[column];
}

double FirstReadings::LogDensity(const VectorXd& readings,
                                 Index shifted) const {
  constexpr double kAnyRow = 2.0;  // e^2 times as likely as a start
  const auto freedom = static_cast<double>(trained_.sessions->starts->sessions);
  const VectorXd scaled = Scaled(readings);
  const double start = at_start_.LogDensity(scaled, shifted, freedom);
  const double any = kAnyRow + any_row_.LogDensity(scaled, shifted, freedom);
  return std::max(start, any) + std::log1p(std::exp(-std::abs(start - any)));
}

}  // namespace errmap::models
