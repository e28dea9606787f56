#include "models/sensors/session_readings.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Cholesky>

#include "fitting/least_squares/decompositions.h"

namespace errmap::models {
namespace {

// Variances of x' (tests/benchmarks/mornings.py).
constexpr double kShift = 25.0;   // of a column that may stand anywhere
constexpr double kShared = 25.0;  // of columns of one unit
constexpr double kLeastVariance = 1e-4;

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
// count as 0.3 sessions.
MatrixXd CovarianceAtStart(const SessionStarts& starts,
                           const MatrixXd& any_row) {
  constexpr double kAllRows = 0.3;
  const auto sessions = static_cast<double>(starts.sessions);
  return (1.0 + 1.0 / sessions) * starts.covariance +
         kAllRows / sessions * any_row;
}

// The log of the sum of two numbers by their logs.
double LogSum(double one, double other) {
  return std::max(one, other) + std::log1p(std::exp(-std::abs(one - other)));
}

}  // namespace

SessionLikelihood::Draw::Draw(const MatrixXd& rows,
                              const VectorXd& mean,
                              const MatrixXd& covariance,
                              Index sessions)
    : rows_(rows), freedom_(static_cast<double>(std::max<Index>(sessions, 1))) {
  const Eigen::LLT<MatrixXd> root(covariance);
  const Index size = covariance.rows();
  precision_ = root.solve(MatrixXd::Identity(size, size));
  log_determinant_ = 2.0 * root.matrixLLT().diagonal().array().log().sum();
  const MatrixXd apart = rows.rowwise() - mean.transpose();
  pulled_ = apart * precision_;
  square_ = apart.cwiseProduct(pulled_).rowwise().sum().mean();
  power_ = freedom_ + static_cast<double>(size);
}

double SessionLikelihood::Draw::LogDensityOf(double square) const {
  return -0.5 * (log_determinant_ +
                 power_ * std::log1p(std::max(square, 0.0) / freedom_));
}

// As with kShift more in the covariance (Sherman & Morrison 1950).
double SessionLikelihood::Draw::LogDensityShifted(Index column,
                                                  double scatter) const {
  const double wider = 1.0 + kShift * precision_(column, column);
  const double mean = pulled_.col(column).mean();
  const double explained = kShift * mean * mean / wider;
  const double left = std::max(square_ - explained, 0.0);
  const double told = explained / (freedom_ + left) / scatter;
  return LogDensity() + 0.5 * (power_ * std::log1p(told) - std::log(wider));
}

double SessionLikelihood::Draw::LogDensitySwapped(Index i, Index j) const {
  const Eigen::ArrayXd apart = rows_.col(i) - rows_.col(j);
  const double own =
      precision_(i, i) + precision_(j, j) - 2.0 * precision_(i, j);
  const double explained =
      (2.0 * apart * (pulled_.col(i) - pulled_.col(j)).array() -
       own * apart.square())
          .mean();
  return LogDensityOf(square_ - explained);
}

double SessionLikelihood::Draw::LogDensityExpected() const {
  return LogDensityOf(static_cast<double>(precision_.rows()));
}

double SessionLikelihood::Draw::Shift(Index column) const {
  return pulled_.col(column).mean() / precision_(column, column);
}

SessionLikelihood::SessionLikelihood(const FittedModel& fitted,
                                     const MatrixXd& states)
    : SessionLikelihood(
          *fitted.applicability,
          states.array().rowwise() /
              fitted.applicability->scale.transpose().array(),
          fitting::CholeskyInverse(fitted.applicability->sessions->precision),
          SharedByUnits(fitted)) {}

SessionLikelihood::SessionLikelihood(const Applicability& trained,
                                     const MatrixXd& scaled,
                                     const MatrixXd& any_row,
                                     const MatrixXd& shared)
    : scale_(trained.scale),
      any_rows_(scaled,
                trained.mean.cwiseQuotient(scale_),
                any_row + shared,
                trained.sessions->units) {
  if (!trained.sessions->starts) return;
  const SessionStarts& starts = *trained.sessions->starts;
  const VectorXd first = scaled.row(0).transpose();
  const MatrixXd least =
      kLeastVariance * MatrixXd::Identity(scale_.size(), scale_.size());
  begun_ = {.first = Draw(first.transpose(),
                          starts.mean + trained.mean.cwiseQuotient(scale_),
                          CovarianceAtStart(starts, any_row) + least + shared,
                          starts.sessions),
            .changes = Draw(scaled.rowwise() - first.transpose(),
                            VectorXd::Zero(scale_.size()),
                            starts.changes + least,
                            starts.sessions)};
}

template <typename OfReadings, typename OfChanges>
double SessionLikelihood::Together(const OfReadings& of_readings,
                                   const OfChanges& of_changes) const {
  constexpr double kAnyRows = 2.0;  // e^2 times as likely as a start
  const double any_rows = of_readings(any_rows_);
  if (!begun_) return any_rows;
  const double begun = of_readings(begun_->first) +
                       of_changes(begun_->changes) -
                       begun_->changes.LogDensityExpected();
  return LogSum(begun, kAnyRows + any_rows);
}

double SessionLikelihood::LogDensity() const {
  const auto of = [](const Draw& draw) { return draw.LogDensity(); };
  return Together(of, of);
}

// An offset changes with no row.
double SessionLikelihood::LogDensityShifted(Index column,
                                            double scatter) const {
  return Together(
      [&](const Draw& draw) { return draw.LogDensityShifted(column, scatter); },
      [](const Draw& changes) { return changes.LogDensity(); });
}

double SessionLikelihood::LogDensitySwapped(Index i, Index j) const {
  const auto of = [&](const Draw& draw) {
    return draw.LogDensitySwapped(i, j);
  };
  return Together(of, of);
}

double SessionLikelihood::Shift(Index column) const {
  return any_rows_.Shift(column) * scale_[column];
}

}  // namespace errmap::models
