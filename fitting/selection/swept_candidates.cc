#include "fitting/selection/swept_candidates.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "fitting/multiversion.h"

namespace errmap::fitting {
namespace {

constexpr std::ptrdiff_t kLanes = 16;
constexpr double kUnbounded = std::numeric_limits<double>::infinity();

ERRMAP_MULTIVERSION
double Dot(const double* a, const double* b, std::ptrdiff_t n) {
  std::array<double, kLanes> sums{};
  std::ptrdiff_t i = 0;
  for (; i + kLanes <= n; i += kLanes) {
    for (std::ptrdiff_t lane = 0; lane < kLanes; ++lane) {
      sums[static_cast<std::size_t>(lane)] += a[i + lane] * b[i + lane];
    }
  }
  double total = 0.0;
  for (; i < n; ++i) total += a[i] * b[i];
  for (const double sum : sums) total += sum;
  return total;
}

ERRMAP_MULTIVERSION
void SubtractMultiple(const double* direction,
                      double factor,
                      double* values,
                      std::ptrdiff_t n) {
  for (std::ptrdiff_t i = 0; i < n; ++i) values[i] -= factor * direction[i];
}

// Sum of ((e - c z) / (slack - f z^2))^2; infinite if a slack is too small.
ERRMAP_MULTIVERSION
double PressOf(const double* error,
               const double* slack,
               const double* rest,
               double coefficient,
               double inverse_square,
               std::ptrdiff_t n) {
  std::array<double, kLanes> sums{};
  std::array<double, kLanes> least;
  least.fill(1.0);
  std::ptrdiff_t i = 0;
  for (; i + kLanes <= n; i += kLanes) {
    for (std::ptrdiff_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t l = static_cast<std::size_t>(lane);
      const double z = rest[i + lane];
      const double room = slack[i + lane] - inverse_square * (z * z);
      const double term = (error[i + lane] - coefficient * z) / room;
      sums[l] += term * term;
      least[l] = room < least[l] ? room : least[l];
    }
  }
  double total = 0.0;
  double smallest = 1.0;
  for (; i < n; ++i) {
    const double room = slack[i] - inverse_square * (rest[i] * rest[i]);
    const double term = (error[i] - coefficient * rest[i]) / room;
    total += term * term;
    smallest = std::min(smallest, room);
  }
  for (const double sum : sums) total += sum;
  for (const double value : least) smallest = std::min(smallest, value);
  return smallest > kLeastSlack ? total : kUnbounded;
}

}  // namespace

SweptCandidates::SweptCandidates(const RegressionProblem& problem,
                                 const std::vector<bool>& fitted,
                                 const std::vector<bool>& held_out)
    : problem_(problem),
      fitted_(problem.response.size()),
      held_out_(problem.response.size()),
      all_fitted_(true) {
  for (Index i = 0; i < fitted_.size(); ++i) {
    fitted_[i] = fitted[At(i)] ? 1.0 : 0.0;
    held_out_[i] = held_out[At(i)] ? 1.0 : 0.0;
    all_fitted_ = all_fitted_ && fitted[At(i)];
  }
  roots_ = problem.Weighted(VectorXd::Ones(problem.response.size()));
  Reset();
}

void SweptCandidates::Reset() {
  const Index cols = problem_.terms.cols();
  rest_.resize(problem_.response.size(), cols);
  least_.resize(cols);
  for (Index j = 0; j < cols; ++j) {
    rest_.col(j) = problem_.terms.col(j).cwiseProduct(roots_);
    least_[j] = kCollinear * kCollinear * rest_.col(j).cwiseAbs2().dot(fitted_);
  }
  error_ = problem_.response.cwiseProduct(roots_);
  chosen_.clear();
  SweepOut(problem_.InterceptColumn().cwiseProduct(roots_));
}

// `column` (n) is orthogonal, on the fitted rows, to what was swept before.
void SweptCandidates::SweepOut(const VectorXd& column) {
  const VectorXd on_fitted =
      all_fitted_ ? column : VectorXd(column.cwiseProduct(fitted_));
  const double squared = on_fitted.squaredNorm();
  if (!(squared > 0.0)) return;
  const Index rows = rest_.rows();
  for (Index j = 0; j < rest_.cols(); ++j) {
    const double along =
        Dot(on_fitted.data(), rest_.col(j).data(), rows) / squared;
    SubtractMultiple(column.data(), along, rest_.col(j).data(), rows);
  }
  error_ -= (on_fitted.dot(error_) / squared) * column;
}

double SweptCandidates::SquaredRest(Index candidate) const {
  const double* rest = rest_.col(candidate).data();
  if (all_fitted_) return Dot(rest, rest, rest_.rows());
  return rest_.col(candidate).cwiseAbs2().dot(fitted_);
}

void SweptCandidates::Follow(const std::vector<Index>& chosen) {
  const bool grew = chosen.size() >= chosen_.size() &&
                    std::equal(chosen_.begin(), chosen_.end(), chosen.begin());
  if (!grew) Reset();
  for (std::size_t i = chosen_.size(); i < chosen.size(); ++i) {
    if (SquaredRest(chosen[i]) > least_[chosen[i]]) {
      SweepOut(rest_.col(chosen[i]).eval());
    }
    chosen_.push_back(chosen[i]);
  }
}

VectorXd SweptCandidates::PressAfterEntry(const VectorXd& leverage,
                                          const std::vector<bool>& open) const {
  const VectorXd slack = 1.0 - leverage.array();
  VectorXd press = VectorXd::Constant(rest_.cols(), kUnbounded);
  const Index rows = rest_.rows();
  for (Index j = 0; j < rest_.cols(); ++j) {
    if (!open[At(j)]) continue;
    const double squared = SquaredRest(j);
    if (!(squared > least_[j])) continue;
    const double* rest = rest_.col(j).data();
    const double coefficient = Dot(rest, error_.data(), rows) / squared;
    press[j] = PressOf(
        error_.data(), slack.data(), rest, coefficient, 1.0 / squared, rows);
  }
  return press;
}

VectorXd SweptCandidates::HeldOutErrorAfterEntry(
    const std::vector<bool>& open) const {
  const VectorXd fitted_error = error_.cwiseProduct(fitted_);
  const double now = error_.cwiseAbs2().dot(held_out_);
  VectorXd errors = VectorXd::Constant(rest_.cols(), kUnbounded);
  for (Index j = 0; j < rest_.cols(); ++j) {
    if (!open[At(j)]) continue;
    const double squared = SquaredRest(j);
    if (!(squared > least_[j])) {
      errors[j] = now;
      continue;
    }
    const double coefficient = rest_.col(j).dot(fitted_error) / squared;
    errors[j] =
        (error_ - coefficient * rest_.col(j)).cwiseAbs2().dot(held_out_);
  }
  return errors;
}

}  // namespace errmap::fitting
