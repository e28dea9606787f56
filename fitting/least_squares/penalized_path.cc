#include "fitting/least_squares/penalized_path.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "fitting/least_squares/decompositions.h"
#include "fitting/matrix_product.h"
#include "fitting/multiversion.h"

namespace errmap::fitting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<double> FallingGrid(double largest, int decades, int per_decade) {
  std::vector<double> grid;
  for (int i = 0; i <= decades * per_decade; ++i) {
    grid.push_back(largest *
                   std::pow(10.0, -static_cast<double>(i) / per_decade));
  }
  return grid;
}

// sum += factors[k] times column columns[k] of a matrix, one k after another.
ERRMAP_MULTIVERSION
void AddColumns(const double* matrix,
                std::ptrdiff_t rows,
                const std::ptrdiff_t* columns,
                const double* factors,
                std::ptrdiff_t count,
                double* sum) {
  std::ptrdiff_t k = 0;
  for (; k + 4 <= count; k += 4) {
    const double* c0 = matrix + columns[k] * rows;
    const double* c1 = matrix + columns[k + 1] * rows;
    const double* c2 = matrix + columns[k + 2] * rows;
    const double* c3 = matrix + columns[k + 3] * rows;
    for (std::ptrdiff_t i = 0; i < rows; ++i) {
      double value = sum[i] + factors[k] * c0[i];
      value += factors[k + 1] * c1[i];
      value += factors[k + 2] * c2[i];
      sum[i] = value + factors[k + 3] * c3[i];
    }
  }
  for (; k < count; ++k) {
    const double* c = matrix + columns[k] * rows;
    for (std::ptrdiff_t i = 0; i < rows; ++i) sum[i] += factors[k] * c[i];
  }
}

// (a, b) becomes (cosine a + sine b, cosine b - sine a).
ERRMAP_MULTIVERSION
void RotateColumns(
    double* a, double* b, std::ptrdiff_t rows, double cosine, double sine) {
  for (std::ptrdiff_t i = 0; i < rows; ++i) {
    const double before = a[i];
    a[i] = cosine * before + sine * b[i];
    b[i] = cosine * b[i] - sine * before;
  }
}

// The lasso's path: between knots its coefficients are linear in the strength
// and the active columns keep one correlation with the residual, which falls.
class LassoPathFollower {
 public:
  LassoPathFollower(const MatrixXd& correlation, const VectorXd& covariance)
      : correlation_(correlation),
        covariance_(covariance),
        coefficients_(VectorXd::Zero(covariance.size())),
        residual_(covariance),
        may_join_(static_cast<std::size_t>(covariance.size()), true) {
    // Columns that do not vary.
    for (Index j = 0; j < correlation.rows(); ++j) {
      if (!(correlation(j, j) > 0.0)) {
        may_join_[static_cast<std::size_t>(j)] = false;
      }
    }
    fixed_out_ = may_join_;
  }

  // Coefficients at each of the falling `strengths`.
  MatrixXd Follow(const std::vector<double>& strengths) {
    MatrixXd solutions = MatrixXd::Zero(coefficients_.size(),
                                        static_cast<Index>(strengths.size()));
    std::size_t at = 0;
    const auto record_down_to = [&](double from,
                                    double to,
                                    const VectorXd& start,
                                    const VectorXd& end) {
      for (; at < strengths.size() && strengths[at] >= to; ++at) {
        const double share =
            from > to ? std::min(1.0, (from - strengths[at]) / (from - to))
                      : 1.0;
        solutions.col(static_cast<Index>(at)) =
            start + std::max(0.0, share) * (end - start);
      }
    };
    Index joining = -1;
    double strength = 0.0;
    for (Index j = 0; j < residual_.size(); ++j) {
      if (may_join_[static_cast<std::size_t>(j)] &&
          std::abs(residual_[j]) > strength) {
        strength = std::abs(residual_[j]);
        joining = j;
      }
    }
    record_down_to(std::numeric_limits<double>::infinity(),
                   strength,
                   coefficients_,
                   coefficients_);
    Index dropped = -1;
    const Index most_knots = 20 * coefficients_.size() + 20;
    for (Index knot = 0; knot < most_knots && at < strengths.size(); ++knot) {
      if (joining >= 0) Join(joining);
      if (active_.empty()) break;
      const VectorXd step = Direction();
      VectorXd slope = VectorXd::Zero(residual_.size());
      AddActive(step, &slope);
      double length = strength;
      joining = -1;
      Index leaving = -1;
      for (Index j = 0; j < residual_.size(); ++j) {
        if (!may_join_[static_cast<std::size_t>(j)] || j == dropped) continue;
        for (const double sign : {1.0, -1.0}) {
          const double closing = 1.0 - sign * slope[j];
          if (!(closing > kTiny)) continue;
          const double reached =
              std::max(0.0, (strength - sign * residual_[j]) / closing);
          if (reached < length) {
            length = reached;
            joining = j;
          }
        }
      }
      for (std::size_t i = 0; i < active_.size(); ++i) {
        const double reached =
            -coefficients_[active_[i]] / step[static_cast<Index>(i)];
        if (reached > 0.0 && reached < length) {
          length = reached;
          leaving = static_cast<Index>(i);
          joining = -1;
        }
      }
      const VectorXd before = coefficients_;
      for (std::size_t i = 0; i < active_.size(); ++i) {
        coefficients_[active_[i]] += length * step[static_cast<Index>(i)];
      }
      dropped = -1;
      if (leaving >= 0) {
        dropped = active_[static_cast<std::size_t>(leaving)];
        coefficients_[dropped] = 0.0;
      }
      record_down_to(strength, strength - length, before, coefficients_);
      strength -= length;
      if (leaving >= 0) Leave(leaving);
      // Exact once in a while, so that rounding does not add up.
      residual_ -= length * slope;
      if (knot % kKnotsBetweenSums == 0) SumResidual();
      if (joining < 0 && leaving < 0) break;  // reached no penalty at all
    }
    for (; at < strengths.size(); ++at) {
      solutions.col(static_cast<Index>(at)) = coefficients_;
    }
    return solutions;
  }

 private:
  static constexpr double kTiny = 1e-12;
  // A column of which less is new than this share of its variance repeats the
  // active ones: it stays at 0.
  static constexpr double kCollinear = 1e-10;
  static constexpr Index kKnotsBetweenSums = 16;

  Index num_active() const { return static_cast<Index>(active_.size()); }

  // sum += R_A times factors (of the active columns).
  void AddActive(const VectorXd& factors, VectorXd* sum) const {
    AddColumns(correlation_.data(),
               correlation_.rows(),
               active_.data(),
               factors.data(),
               num_active(),
               sum->data());
  }

  void SumResidual() {
    residual_ = covariance_;
    AddActive(-coefficients_(active_), &residual_);
  }

  void Join(Index column) {
    may_join_[static_cast<std::size_t>(column)] = false;
    const Index n = num_active();
    VectorXd along(n);
    for (Index i = 0; i < n; ++i) {
      along[i] = correlation_(active_[static_cast<std::size_t>(i)], column);
    }
    factor_.topLeftCorner(n, n).triangularView<Eigen::Lower>().solveInPlace(
        along);
    const double rest = correlation_(column, column) - along.squaredNorm();
    if (!(rest > kCollinear)) return;
    if (factor_.rows() < n + 1) {
      factor_.conservativeResize(2 * n + 8, 2 * n + 8);
    }
    factor_.row(n).head(n) = along.transpose();
    factor_(n, n) = std::sqrt(rest);
    active_.push_back(column);
    signs_.push_back(residual_[column] >= 0.0 ? 1.0 : -1.0);
  }

  void Leave(Index place) {
    active_.erase(active_.begin() + place);
    signs_.erase(signs_.begin() + place);
    RemoveFromFactor(place);
    // Copies of what has left may come in again.
    may_join_ = fixed_out_;
    for (const Index j : active_)
      may_join_[static_cast<std::size_t>(j)] = false;
  }

  // Without the row of what has left the factor has one entry above each later
  // diagonal, which a rotation of two columns takes away (Golub and Van Loan
  // 2013, 6.5.3): the work of a join, not that of a new factor.
  void RemoveFromFactor(Index place) {
    const Index n = num_active();
    for (Index j = 0; j <= n; ++j) {
      for (Index i = std::max(place, j - 1); i < n; ++i) {
        factor_(i, j) = factor_(i + 1, j);
      }
    }
    for (Index j = place; j < n; ++j) {
      const double length = std::hypot(factor_(j, j), factor_(j, j + 1));
      RotateColumns(&factor_(j, j),
                    &factor_(j, j + 1),
                    n - j,
                    factor_(j, j) / length,
                    factor_(j, j + 1) / length);
    }
  }

  // w = R_AA^-1 s: along it all active columns lose correlation alike.
  VectorXd Direction() const {
    const Index n = num_active();
    VectorXd step = Eigen::Map<const VectorXd>(signs_.data(), n);
    factor_.topLeftCorner(n, n).triangularView<Eigen::Lower>().solveInPlace(
        step);
    factor_.topLeftCorner(n, n)
        .transpose()
        .triangularView<Eigen::Upper>()
        .solveInPlace(step);
    return step;
  }

  const MatrixXd& correlation_;
  const VectorXd& covariance_;
  VectorXd coefficients_;
  VectorXd residual_;  // (k) covariance of each column with the residual
  std::vector<bool> may_join_;
  std::vector<bool> fixed_out_;  // false for columns that never join
  std::vector<Index> active_;
  std::vector<double> signs_;
  MatrixXd factor_;  // Cholesky factor of the active columns' correlation
};

}  // namespace

std::string_view ToString(Penalty penalty) {
  return penalty == Penalty::kRidge ? "ridge" : "lasso";
}

PenalizedPath::PenalizedPath(Penalty penalty,
                             const CrossProducts& sums,
                             bool intercept)
    : penalty_(penalty), intercept_(intercept), weight_(sums.weight) {
  Standardise(sums);
  const Index k = means_.size();
  correlation_.resize(k, k);
  for (Index j = 0; j < k; ++j) {
    const Index below = k - j;
    correlation_.col(j).tail(below) =
        scales_[j] * scales_.tail(below).cwiseProduct(
                         sums.products.col(j).tail(below) / weight_ -
                         means_[j] * means_.tail(below));
  }
  if (penalty == Penalty::kLasso) {
    correlation_.triangularView<Eigen::StrictlyUpper>() =
        correlation_.transpose();
  }
}

PenalizedPath::PenalizedPath(const CrossProducts& sums,
                             bool intercept,
                             const MatrixXd& columns,
                             const VectorXd& response,
                             const VectorXd& weights)
    : penalty_(Penalty::kRidge), intercept_(intercept), weight_(sums.weight) {
  Standardise(sums);
  const VectorXd roots =
      weights.size() > 0
          ? VectorXd((weights / weight_).cwiseSqrt())
          : VectorXd::Constant(columns.rows(), std::sqrt(1.0 / weight_));
  rows_ = roots.asDiagonal() * (columns.rowwise() - means_.transpose()) *
          scales_.asDiagonal();
  response_ = roots.cwiseProduct(
      response - VectorXd::Constant(response.size(), mean_response_));
  correlation_ = MatrixXd::Zero(rows_.rows(), rows_.rows());
  MultiplyByOwnTranspose(rows_, correlation_);
}

void PenalizedPath::Standardise(const CrossProducts& sums) {
  // What is left of a constant column is rounding of its mean square.
  constexpr double kConstant = 1e-12;
  const Index k = sums.columns.size();
  means_ = intercept_ ? VectorXd(sums.columns / weight_) : VectorXd::Zero(k);
  mean_response_ = intercept_ ? sums.response / weight_ : 0.0;
  covariance_ = sums.with_response / weight_ - mean_response_ * means_;
  scales_.setZero(k);
  for (Index j = 0; j < k; ++j) {
    const double mean_square = sums.products(j, j) / weight_;
    const double variance = mean_square - means_[j] * means_[j];
    if (variance > kConstant * mean_square) {
      scales_[j] = 1.0 / std::sqrt(variance);
    }
  }
  covariance_.array() *= scales_.array();
}

std::vector<double> PenalizedPath::Grid() const {
  if (penalty_ == Penalty::kRidge) return FallingGrid(10.0, 10, 1);
  const double largest =
      covariance_.size() > 0 ? covariance_.cwiseAbs().maxCoeff() : 0.0;
  if (!(largest > 0.0)) return {0.0};
  return FallingGrid(largest, 5, 4);
}

// R + strength I; constant columns, which R has as zeros, stand by themselves.
MatrixXd PenalizedPath::Shifted(double strength) const {
  const Index k = correlation_.rows();
  MatrixXd shifted(k, k);
  for (Index j = 0; j < k; ++j) {
    shifted.col(j).tail(k - j) = correlation_.col(j).tail(k - j);
  }
  shifted.diagonal().array() += strength;
  if (in_rows()) return shifted;
  for (Index j = 0; j < scales_.size(); ++j) {
    if (scales_[j] == 0.0) shifted(j, j) = 1.0;
  }
  return shifted;
}

MatrixXd PenalizedPath::RidgeSolutions(
    const std::vector<double>& strengths) const {
  const Index k = covariance_.size();
  MatrixXd solutions = MatrixXd::Zero(k, static_cast<Index>(strengths.size()));
  // Columns that depend on each other, without a penalty, have the limit of
  // weak ones.
  constexpr double kWeak = 1e-11;
  for (std::size_t s = 0; s < strengths.size() && k > 0; ++s) {
    MatrixXd factor = Shifted(strengths[s]);
    if (!FactorizeCholesky(factor)) {
      factor = Shifted(strengths[s] + kWeak);
      FactorizeCholesky(factor);
    }
    VectorXd solution = in_rows() ? response_ : covariance_;
    SolveCholesky(factor, &solution);
    // (A'A + s I)^-1 A' = A' (A A' + s I)^-1.
    if (in_rows()) solution = rows_.transpose() * solution;
    solutions.col(static_cast<Index>(s)) = solution;
  }
  return solutions;
}

MatrixXd PenalizedPath::LassoSolutions(
    const std::vector<double>& strengths) const {
  return LassoPathFollower(correlation_, covariance_).Follow(strengths);
}

PenalizedPath::Solutions PenalizedPath::Solve(
    const std::vector<double>& strengths) const {
  Solutions solutions;
  const MatrixXd scaled = penalty_ == Penalty::kRidge
                              ? RidgeSolutions(strengths)
                              : LassoSolutions(strengths);
  solutions.coefficients = scales_.asDiagonal() * scaled;
  solutions.intercepts = VectorXd::Constant(scaled.cols(), mean_response_) -
                         solutions.coefficients.transpose() * means_;
  return solutions;
}

void PenalizedPath::Refine(double strength,
                           double residuals,
                           const VectorXd& with_columns,
                           Solutions* solution) const {
  MatrixXd factor = Shifted(strength);
  if (!FactorizeCholesky(factor)) return;
  VectorXd coefficients = solution->coefficients.col(0);
  // In the scaled columns, of which one that is constant has scale 0.
  const auto scaled = [&](const VectorXd& values) {
    return (scales_.array() > 0.0)
        .select(values.array() / scales_.array(), 0.0)
        .matrix();
  };
  const VectorXd left =
      scales_.cwiseProduct(with_columns - residuals * means_) / weight_ -
      strength * scaled(coefficients);
  VectorXd step = in_rows() ? VectorXd(rows_ * left) : left;
  SolveCholesky(factor, &step);
  // (A'A + s I)^-1 = (I - A' (A A' + s I)^-1 A) / s.
  if (in_rows()) step = (left - rows_.transpose() * step) / strength;
  coefficients += scales_.cwiseProduct(step);
  solution->coefficients.col(0) = coefficients;
  solution->intercepts[0] = mean_response_ - coefficients.dot(means_);
}

double PenalizedPath::DegreesOfFreedom(double strength,
                                       const VectorXd& coefficients) const {
  const double of_intercept = intercept_ ? 1.0 : 0.0;
  if (penalty_ == Penalty::kLasso) {
    return of_intercept +
           static_cast<double>((coefficients.array() != 0.0).count());
  }
  if (correlation_.rows() == 0) return of_intercept;
  // The trace of R (R + s I)^-1 = I - s (R + s I)^-1, by the factor that the
  // solution took; eigenvalues cost ten times as much.
  MatrixXd factor = Shifted(strength);
  if (strength > 0.0 && FactorizeCholesky(factor)) {
    const VectorXd inverse = DiagonalOfInverse(factor);
    const Eigen::ArrayXd shares = 1.0 - strength * inverse.array();
    if (in_rows()) return of_intercept + shares.sum();
    return of_intercept + (scales_.array() > 0.0).select(shares, 0.0).sum();
  }
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(correlation_,
                                                      Eigen::EigenvaluesOnly);
  double trace = 0.0;
  for (const double value : eigen.eigenvalues()) {
    if (value > 0.0) trace += value / (value + strength);
  }
  return of_intercept + trace;
}

}  // namespace errmap::fitting
