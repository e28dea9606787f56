#include "fitting/least_squares/penalized_path.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "fitting/least_squares/decompositions.h"
#include "fitting/matrix_product.h"
#include "fitting/multiversion.h"

namespace errmap::fitting {
namespace {

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
// Rounding, ties and nearly repeated columns can lead it astray. Each solution
// is therefore checked against the conditions of a minimum; if it violates
// them, an active-set method continues from there.
class LassoPathFollower {
 public:
  LassoPathFollower(const MatrixXd& correlation, const VectorXd& covariance)
      : correlation_(correlation),
        covariance_(covariance),
        coefficients_(VectorXd::Zero(covariance.size())),
        residual_(covariance),
        is_out_(static_cast<std::size_t>(covariance.size())),
        largest_(0.0) {
    for (Index j = 0; j < correlation.rows(); ++j) {
      // Columns that do not vary never join.
      is_out_[At(j)] = correlation(j, j) > 0.0;
      if (is_out_[At(j)]) {
        largest_ = std::max(largest_, std::abs(covariance[j]));
      }
    }
    is_refused_.assign(is_out_.size(), false);
    strength_ = largest_;
  }

  // Coefficients at each of the `strengths`.
  MatrixXd Follow(const std::vector<double>& strengths) {
    MatrixXd solutions(coefficients_.size(), std::ssize(strengths));
    std::vector<std::size_t> falling(strengths.size());
    std::iota(falling.begin(), falling.end(), std::size_t{0});
    std::stable_sort(
        falling.begin(), falling.end(), [&](std::size_t a, std::size_t b) {
          return strengths[a] > strengths[b];
        });
    for (const std::size_t at : falling) {
      const double strength = std::max(0.0, strengths[at]);
      if (strength < largest_) {
        MoveTo(strength);
        Settle(strength);
      }
      solutions.col(static_cast<Index>(at)) = coefficients_;
    }
    return solutions;
  }

 private:
  static constexpr double kTiny = 1e-12;
  // A column of which less is new than this share of its variance repeats the
  // active ones: the path leaves it out, and Settle looks at it again.
  static constexpr double kCollinear = 1e-10;
  // Rounding makes as much of what is not new at all.
  static constexpr double kDependent = 1e-13;
  static constexpr Index kKnotsBetweenSums = 16;

  struct Event {
    double length = 0.0;  // by which the strength falls until then
    Index joining = -1;   // a column
    double sign = 1.0;    // of its correlation
    Index leaving = -1;   // a place in active_
  };

  static std::size_t At(Index index) { return static_cast<std::size_t>(index); }
  Index num_active() const { return std::ssize(active_); }

  // Knot by knot down to `target`, or until the path is lost.
  void MoveTo(double target) {
    // Ties lead to steps of length 0, about one for each column.
    const Index most_stalls = coefficients_.size() + 10;
    Index stalls = 0;
    while (strength_ > target && stalls < most_stalls &&
           knots_ < 20 * coefficients_.size() + 20) {
      const Event event = NextEvent(strength_ - target);
      for (Index i = 0; i < num_active(); ++i) {
        coefficients_[active_[At(i)]] += event.length * step_[i];
      }
      residual_ -= event.length * slope_;
      strength_ -= event.length;
      dropped_ = -1;
      const bool is_knot = event.leaving >= 0 || event.joining >= 0;
      if (!is_knot) break;  // at the target
      stalls = event.length > 0.0 ? 0 : stalls + 1;
      if (event.leaving >= 0) {
        dropped_ = active_[At(event.leaving)];
        dropped_sign_ = signs_[At(event.leaving)];
        Leave(event.leaving);
      } else if (!Join(event.joining, event.sign, kCollinear)) {
        is_refused_[At(event.joining)] = true;
      }
      // Exact once in a while, so that rounding does not add up.
      if (++knots_ % kKnotsBetweenSums == 0) SumResidual();
    }
    strength_ = target;
  }

  // Returns the event that ends this piece of the path, within `length`.
  Event NextEvent(double length) {
    if (!is_direction_current_) TakeDirection();
    Event event{.length = length};
    for (Index j = 0; j < residual_.size(); ++j) {
      if (!is_out_[At(j)] || is_refused_[At(j)]) continue;
      for (const double sign : {1.0, -1.0}) {
        const double closing = 1.0 - sign * slope_[j];
        if (!(closing > kTiny)) continue;
        // A column that has just left moves away from that value.
        if (j == dropped_ && sign == dropped_sign_) continue;
        const double reached =
            std::max(0.0, (strength_ - sign * residual_[j]) / closing);
        if (reached < event.length) {
          event = {.length = reached, .joining = j, .sign = sign};
        }
      }
    }
    for (Index i = 0; i < num_active(); ++i) {
      const double coefficient = coefficients_[active_[At(i)]];
      // One that came in with others may have to turn back at once.
      const bool against = coefficient == 0.0 && step_[i] * signs_[At(i)] < 0.0;
      const double reached = -coefficient / step_[i];
      if ((reached > 0.0 && reached < event.length) || against) {
        event = {.length = against ? 0.0 : reached, .leaving = i};
        if (against) break;
      }
    }
    return event;
  }

  // To the minimum for `strength` from a point near it: the primal active-set
  // method for quadratic programs (Nocedal and Wright 2006, 16.5). Each step
  // goes to the minimum over the active columns with their signs, or to the
  // first coefficient that is 0 on the way, which leaves.
  void Settle(double strength) {
    SumResidual();
    const Index most_changes = 10 * coefficients_.size() + 50;
    constexpr int kMostRefinements = 5;
    std::vector<bool> hopeless(is_out_.size(), false);
    int refinements = 0;
    for (Index changes = 0; changes < most_changes;) {
      const double allowed = Rounding();
      if (ActiveError(strength) > allowed && refinements < kMostRefinements) {
        ++refinements;
        if (StepOnActive(strength)) {
          ++changes;
          refinements = 0;
        }
        continue;
      }
      const Index worst = WorstOutside(strength + allowed, hopeless);
      if (worst < 0) return;
      ++changes;
      refinements = 0;
      const double sign = residual_[worst] >= 0.0 ? 1.0 : -1.0;
      if (!Join(worst, sign, kDependent) && !Exchange(worst, sign)) {
        hopeless[At(worst)] = true;
      }
    }
  }

  // Size below which a correlation of the residual counts as 0.
  double Rounding() const {
    constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
    constexpr double kOfLargest = 1e-13;
    return kOfLargest * largest_ + 8.0 * kEpsilon * coefficients_.lpNorm<1>();
  }

  double ActiveError(double strength) const {
    double worst = 0.0;
    for (Index i = 0; i < num_active(); ++i) {
      worst = std::max(
          worst,
          std::abs(residual_[active_[At(i)]] - signs_[At(i)] * strength));
    }
    return worst;
  }

  Index WorstOutside(double allowed, const std::vector<bool>& hopeless) const {
    Index worst = -1;
    for (Index j = 0; j < residual_.size(); ++j) {
      if (is_out_[At(j)] && !hopeless[At(j)] &&
          std::abs(residual_[j]) > allowed) {
        allowed = std::abs(residual_[j]);
        worst = j;
      }
    }
    return worst;
  }

  // Returns true if a column has left on the way.
  bool StepOnActive(double strength) {
    VectorXd step(num_active());
    for (Index i = 0; i < step.size(); ++i) {
      step[i] = residual_[active_[At(i)]] - signs_[At(i)] * strength;
    }
    SolveActive(&step);
    return MoveActive(step, 1.0);
  }

  // Coefficients += share step, or less where one comes to 0: it leaves, and
  // the result is true.
  bool MoveActive(const VectorXd& step, double share) {
    Index leaving = -1;
    for (Index i = 0; i < step.size(); ++i) {
      if (!(step[i] * signs_[At(i)] < 0.0)) continue;
      const double reached = std::abs(coefficients_[active_[At(i)]] / step[i]);
      if (reached < share) {
        share = reached;
        leaving = i;
      }
    }
    if (!std::isfinite(share)) return false;
    for (Index i = 0; i < step.size(); ++i) {
      coefficients_[active_[At(i)]] += share * step[i];
    }
    moved_ = share;
    if (leaving >= 0) Leave(leaving);
    SumResidual();
    return leaving >= 0;
  }

  // A column x that the active ones give, x = sum of d_i x_i, at a lower sum of
  // sizes: it takes over from them until one of them has come to 0, which it
  // replaces.
  bool Exchange(Index column, double sign) {
    VectorXd step(num_active());
    for (Index i = 0; i < step.size(); ++i) {
      step[i] = -sign * correlation_(active_[At(i)], column);
    }
    SolveActive(&step);
    const double everything = std::numeric_limits<double>::infinity();
    if (!MoveActive(step, everything)) return false;
    const bool joins = Join(column, sign, kDependent);
    if (joins) coefficients_[column] = sign * moved_;
    SumResidual();
    return joins;
  }

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

  // False where less than the share `least` of the column's variance is new.
  bool Join(Index column, double sign, double least) {
    const Index n = num_active();
    VectorXd along(n);
    for (Index i = 0; i < n; ++i) {
      along[i] = correlation_(active_[At(i)], column);
    }
    factor_.topLeftCorner(n, n).triangularView<Eigen::Lower>().solveInPlace(
        along);
    const double rest = correlation_(column, column) - along.squaredNorm();
    if (!(rest > least)) return false;
    if (factor_.rows() < n + 1) {
      factor_.conservativeResize(2 * n + 8, 2 * n + 8);
    }
    factor_.row(n).head(n) = along.transpose();
    factor_(n, n) = std::sqrt(rest);
    active_.push_back(column);
    signs_.push_back(sign);
    is_out_[At(column)] = false;
    is_direction_current_ = false;
    return true;
  }

  void Leave(Index place) {
    const Index column = active_[At(place)];
    coefficients_[column] = 0.0;
    is_out_[At(column)] = true;
    active_.erase(active_.begin() + place);
    signs_.erase(signs_.begin() + place);
    RemoveFromFactor(place);
    is_direction_current_ = false;
    // Copies of what has left may come in again.
    is_refused_.assign(is_refused_.size(), false);
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

  void SolveActive(VectorXd* values) const {
    const Index n = num_active();
    const auto factor = factor_.topLeftCorner(n, n);
    factor.triangularView<Eigen::Lower>().solveInPlace(*values);
    factor.transpose().triangularView<Eigen::Upper>().solveInPlace(*values);
  }

  // w = R_AA^-1 s: along it all active columns lose correlation alike.
  void TakeDirection() {
    step_ = Eigen::Map<const VectorXd>(signs_.data(), num_active());
    SolveActive(&step_);
    slope_.setZero(residual_.size());
    AddActive(step_, &slope_);
    is_direction_current_ = true;
  }

  const MatrixXd& correlation_;
  const VectorXd& covariance_;
  VectorXd coefficients_;
  VectorXd residual_;         // (k) covariance of each column with the residual
  std::vector<bool> is_out_;  // varies and is not active
  std::vector<bool> is_refused_;  // repeats the active ones
  double largest_;                // strength from which on all are 0
  double strength_ = 0.0;
  std::vector<Index> active_;
  std::vector<double> signs_;
  MatrixXd factor_;  // Cholesky factor of the active columns' correlation
  VectorXd step_;    // of the active coefficients as the strength falls
  VectorXd slope_;   // (k) of the residual_, likewise
  bool is_direction_current_ = false;
  Index dropped_ = -1;  // the column that left at the last knot
  double dropped_sign_ = 1.0;
  double moved_ = 0.0;  // the share of the last MoveActive
  Index knots_ = 0;
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
  // The rest of a constant column is rounding of its mean square.
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
  MatrixXd solutions = MatrixXd::Zero(k, std::ssize(strengths));
  // Columns that depend on each other, without a penalty, have the limit of
  // weak ones; how weak, the rounding of their correlations says.
  constexpr double kWeak = 1e-11;
  constexpr double kStrong = 1.0;
  for (std::size_t s = 0; s < strengths.size() && k > 0; ++s) {
    MatrixXd factor = Shifted(strengths[s]);
    double added = kWeak;
    bool is_definite = FactorizeCholesky(factor);
    for (; !is_definite && added < kStrong; added *= 100.0) {
      factor = Shifted(strengths[s] + added);
      is_definite = FactorizeCholesky(factor);
    }
    if (!is_definite) {  // correlations that are not finite
      solutions.col(static_cast<Index>(s)).setConstant(std::nan(""));
      continue;
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
  constexpr double kRounding = 1e-12;  // of eigenvalues that are 0
  for (const double value : eigen.eigenvalues()) {
    if (value > kRounding) trace += value / (value + strength);
  }
  return of_intercept + trace;
}

}  // namespace errmap::fitting
