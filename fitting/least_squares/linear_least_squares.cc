#include "fitting/least_squares/linear_least_squares.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "fitting/interruption.h"
#include "fitting/least_squares/decompositions.h"
#include "fitting/least_squares/orthogonal_basis.h"
#include "stats/not_a_number.h"
#include "stats/require.h"

namespace errmap::fitting {
namespace {

using stats::DoubleDouble;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

void CheckProblem(const MatrixXd& design,
                  const VectorXd& response,
                  const VectorXd& weights) {
  const auto size = [](Index n) { return std::to_string(n); };
  if (design.rows() < 1 || design.cols() < 1) {
    throw std::invalid_argument("SolveLeastSquares: empty design matrix (" +
                                size(design.rows()) + " x " +
                                size(design.cols()) + ")");
  }
  if (response.size() != design.rows() ||
      (weights.size() != 0 && weights.size() != design.rows())) {
    throw std::invalid_argument("SolveLeastSquares: design has " +
                                size(design.rows()) + " rows, response " +
                                size(response.size()) + ", weights " +
                                size(weights.size()));
  }
  if (!design.allFinite() || !response.allFinite() || !weights.allFinite()) {
    throw std::invalid_argument("SolveLeastSquares: values must be finite");
  }
  if (weights.size() != 0 && weights.minCoeff() < 0.0) {
    throw std::invalid_argument(
        "SolveLeastSquares: weights must not be negative");
  }
}

// A problem with its weights worked in and columns of about unit length, in
// double and, once asked for, in 106 bits.
class Problem {
 public:
  Problem(const MatrixXd& design,
          const VectorXd& response,
          const VectorXd& weights,
          const LeastSquaresOptions& options)
      : options_(options), weights_(weights), columns_(design), y_(response) {
    if (weights.size() != 0) {
      const VectorXd roots = weights.cwiseSqrt();
      columns_ = roots.asDiagonal() * columns_;
      y_ = roots.cwiseProduct(y_);
    }
    scales_.resize(columns_.cols());
    for (Index j = 0; j < columns_.cols(); ++j) {
      const double length = columns_.col(j).stableNorm();
      // A power of two: exact, in 106 bits as well.
      scales_[j] = length > 0.0 ? std::ldexp(1.0, -std::ilogb(length)) : 1.0;
      columns_.col(j) *= scales_[j];
    }
  }

  const LeastSquaresOptions& options() const { return options_; }
  const MatrixXd& columns() const { return columns_; }
  const VectorXd& y() const { return y_; }
  const VectorXd& scales() const { return scales_; }

  // Design and response in 106 bits, weighted and scaled alike.
  const ExtendedSystem& exact() {
    if (exact_) return *exact_;
    if (options_.exact) {
      exact_ = options_.exact();
      if (exact_->design.rows() != columns_.rows() ||
          exact_->design.cols() != columns_.cols() ||
          exact_->response.size() != y_.size()) {
        throw std::invalid_argument(
            "SolveLeastSquares: the exact system has another shape");
      }
      ThrowIfInterrupted();
      for (Index i = 0; i < weights_.size(); ++i) {
        const DoubleDouble root = sqrt(DoubleDouble(weights_[i]));
        exact_->response[i] *= root;
        for (Index j = 0; j < columns_.cols(); ++j) {
          exact_->design(i, j) *= root;
        }
      }
      for (Index j = 0; j < columns_.cols(); ++j) {
        for (Index i = 0; i < y_.size(); ++i) {
          exact_->design(i, j) *= scales_[j];
        }
      }
    } else {
      exact_ = ExtendedSystem{columns_.cast<DoubleDouble>(),
                              y_.cast<DoubleDouble>()};
    }
    return *exact_;
  }

  // Length of what rounding of the data may leave of column j less `parts` (k)
  // of the columns kept.
  double Noise(Index j,
               const std::vector<Index>& kept,
               const VectorXd& parts) const {
    if (!options_.noise) return 0.0;
    // A sum of other columns was rounded in steps, which may have been larger
    // than what they left.
    constexpr double kMargin = 64.0;
    VectorXd combination = VectorXd::Zero(columns_.cols());
    for (std::size_t k = 0; k < kept.size(); ++k) {
      combination[kept[k]] = -parts[static_cast<Index>(k)] * scales_[kept[k]];
    }
    combination[j] = scales_[j];
    return kMargin * options_.noise(combination);
  }

 private:
  const LeastSquaresOptions& options_;
  const VectorXd& weights_;
  MatrixXd columns_;
  VectorXd y_;
  VectorXd scales_;
  std::optional<ExtendedSystem> exact_;
};

// Which columns stay, and Q R of them.
struct Decomposition {
  std::vector<Index> kept;
  std::vector<Index> aliased;
  std::vector<Index> nearly_aliased;
  MatrixXd triangle;  // R (k x k)
  VectorXd rotated;   // Q'y (k)
  MatrixXd basis;     // Q (n x k), where asked for
};

// Remainder of column j after the kept columns, in 106 bits, as far as needed
// to see that it is below `enough`. `along` (k) gets the column's part in each
// basis vector.
VectorXd ExactRemainder(const ExtendedSystem& exact,
                        const std::vector<Index>& kept,
                        const OrthogonalBasis& basis,
                        Index j,
                        double enough,
                        VectorXd* along) {
  constexpr int kMostPasses = 20;
  constexpr double kStalled = 0.5;
  ExtendedVector rest = exact.design.col(j);
  along->setZero(basis.size());
  double length = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < kMostPasses; ++pass) {
    ThrowIfInterrupted();
    const double before = length;
    length = rest.cast<double>().norm();
    if (length <= enough || length > kStalled * before) break;
    const VectorXd part = basis.Q().transpose() * rest.cast<double>();
    const VectorXd step = basis.R().triangularView<Eigen::Upper>().solve(part);
    *along += part;
    for (Index k = 0; k < step.size(); ++k) {
      const auto column = exact.design.col(kept[static_cast<std::size_t>(k)]);
      const DoubleDouble factor = step[k];
      for (Index i = 0; i < rest.size(); ++i) rest[i] -= column[i] * factor;
    }
  }
  return rest.cast<double>();
}

// Column after column, each judged by what those kept leave of it.
class OneByOne {
 public:
  explicit OneByOne(Problem* problem)
      : problem_(problem), basis_(problem->columns().rows()) {}

  Decomposition Run() {
    // First as R does. What R would drop but double cannot show to follow has
    // to wait: a later column may stand for it, and better.
    std::vector<Index> doubtful;
    for (Index j = 0; j < problem_->columns().cols(); ++j) {
      Judge(j);
      if (is_clear_) {
        Keep(j);
      } else if (follows_) {
        result_.aliased.push_back(j);
      } else {
        doubtful.push_back(j);
      }
    }
    for (const Index j : doubtful) {
      Judge(j);
      if (!follows_) JudgeExactly(j);
      if (follows_) {
        result_.aliased.push_back(j);
      } else {
        Keep(j);
        result_.nearly_aliased.push_back(j);
      }
    }
    std::sort(result_.aliased.begin(), result_.aliased.end());
    result_.basis = MatrixXd(problem_->y().size(), 0);
    if (basis_.size() > 0) {
      result_.triangle = basis_.R();
      result_.basis = basis_.Q();
    }
    result_.rotated = result_.basis.transpose() * problem_->y();
    return std::move(result_);
  }

 private:
  double Enough(Index j) const {
    return kConfirmed * problem_->columns().col(j).norm();
  }

  // Parts of the kept columns in the one judged (k).
  VectorXd PartsOf() const {
    return basis_.R().triangularView<Eigen::Upper>().solve(along_);
  }

  void Judge(Index j) {
    ThrowIfInterrupted();
    const auto column = problem_->columns().col(j);
    const double length = column.norm();
    rest_ = basis_.Remainder(column, &along_);
    follows_ = false;
    is_clear_ =
        basis_.size() < column.size() && rest_.norm() > kAliased * length;
    if (is_clear_) return;
    // Double decides if its rounding cannot hide more.
    constexpr double kRoundings = 4.0;
    const double rounding =
        kRoundings * kEpsilon * (length + PartsOf().lpNorm<1>());
    follows_ =
        basis_.size() == column.size() || rest_.norm() + rounding <= Enough(j);
  }

  void JudgeExactly(Index j) {
    rest_ = ExactRemainder(
        problem_->exact(), result_.kept, basis_, j, Enough(j), &along_);
    follows_ = !(rest_.norm() > Enough(j)) ||
               !(rest_.norm() > problem_->Noise(j, result_.kept, PartsOf()));
    // The exact remainder is at right angles to rounding of the parts only.
    VectorXd more;
    rest_ = basis_.Remainder(rest_, &more);
    along_ += more;
  }

  void Keep(Index j) {
    basis_.Append(rest_, along_);
    result_.kept.push_back(j);
  }

  Problem* problem_;
  OrthogonalBasis basis_;
  Decomposition result_;
  // For the column judged last.
  VectorXd rest_;
  VectorXd along_;
  bool is_clear_ = false;  // R would keep it
  bool follows_ = false;   // to 106 bits
};

Decomposition Decompose(Problem* problem, bool with_basis) {
  const MatrixXd& columns = problem->columns();
  const Index p = columns.cols();
  if (columns.rows() >= p) {
    const Eigen::HouseholderQR<MatrixXd> qr(columns);
    Decomposition result;
    result.triangle = qr.matrixQR().topRows(p).triangularView<Eigen::Upper>();
    bool all_stay = true;
    for (Index j = 0; j < p; ++j) {
      all_stay = all_stay && std::abs(result.triangle(j, j)) >
                                 kAliased * result.triangle.col(j).norm();
      result.kept.push_back(j);
    }
    if (all_stay) {
      result.rotated = TimesQTransposed(qr, problem->y()).head(p);
      if (with_basis) {
        result.basis = ThinQ(qr);
      }
      return result;
    }
  }
  return OneByOne(problem).Run();
}

// Ratio for the triangle's columns at unit length.
double PivotRatio(MatrixXd triangle) {
  for (Index j = 0; j < triangle.cols(); ++j) triangle.col(j).normalize();
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(triangle);
  const Index last = triangle.cols() - 1;
  return std::abs(qr.matrixR()(0, 0)) / std::abs(qr.matrixR()(last, last));
}

// A design of up to this many products is solved in 106 bits: about half a
// second.
constexpr double kMostProducts = 2e7;

// Some hundredths of a second in 106 bits.
constexpr Index kRowsBetweenAsking = 1024;

// The solution for the columns kept (k), and what it leaves.
struct Refined {
  ExtendedVector coefficients;
  DoubleDouble residual_sum_of_squares;
};

// A' r of the kept columns, summed in 106 bits.
VectorXd Products(const ExtendedMatrix& design,
                  const std::vector<Index>& kept,
                  const ExtendedVector& residual) {
  // Sums side by side: one after the other they would wait for each other.
  ExtendedVector sums = ExtendedVector::Zero(std::ssize(kept));
  for (Index i = 0; i < residual.size(); ++i) {
    if (i % kRowsBetweenAsking == 0) ThrowIfInterrupted();
    for (Index j = 0; j < sums.size(); ++j) {
      sums[j] += design(i, kept[static_cast<std::size_t>(j)]) * residual[i];
    }
  }
  return sums.cast<double>();
}

// Solves [I A; A' 0] [r; x] = [y; 0] for the exact numbers by corrections from
// A = Q R in double (Bjorck 1967), which shrink by about epsilon times the
// condition. Empty if they stop before double's last digit.
std::optional<Refined> Refine(Problem* problem,
                              Decomposition parts,
                              double condition) {
  constexpr int kMostPasses = 30;
  constexpr double kStalled = 0.5;
  constexpr double kExtendedEpsilon = 1e-31;
  constexpr double kMargin = 10.0;  // of the next step, over what is foreseen
  const auto& [design, response] = problem->exact();
  const Index n = response.size();
  const auto k = std::ssize(parts.kept);
  const MatrixXd& triangle = parts.triangle;
  const auto r = triangle.triangularView<Eigen::Upper>();
  if (parts.basis.cols() != k) {
    // Only as orthonormal as the condition allows: costs passes, not digits.
    parts.basis = problem->columns()(Eigen::all, parts.kept);
    r.solveInPlace<Eigen::OnTheRight>(parts.basis);
  }
  const double unresolved = kExtendedEpsilon * condition;
  ExtendedVector x = ExtendedVector::Zero(k);
  ExtendedVector residual = ExtendedVector::Zero(n);
  VectorXd rest = response.cast<double>();  // y - r - A x
  double before = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < kMostPasses; ++pass) {
    VectorXd across = VectorXd::Zero(k);  // - A' r
    if (pass > 0) across = -Products(design, parts.kept, residual);
    const VectorXd along = parts.basis.transpose() * rest;
    const VectorXd turned = r.transpose().solve(across);
    const VectorXd step = r.solve(along - turned);
    const VectorXd moved = rest + parts.basis * (turned - along);
    for (Index j = 0; j < k; ++j) x[j] += step[j];
    for (Index i = 0; i < n; ++i) residual[i] += moved[i];
    if (!x.cast<double>().allFinite()) return std::nullopt;

    // Steps shrink by about the same factor each time: the next one says what
    // this one has left.
    const double length = step.norm();
    const double next = pass > 0 ? kMargin * length / before * length : length;
    const double floor = unresolved * x.cast<double>().norm();
    bool all_digits = true;
    for (Index j = 0; j < k; ++j) {
      const double enough = 0.25 * kEpsilon * std::abs(x[j].hi);
      all_digits = all_digits &&
                   std::min(next, std::abs(step[j])) <= std::max(enough, floor);
    }
    ExtendedVector left = response;
    for (Index j = 0; j < k; ++j) {
      ThrowIfInterrupted();
      const auto column = design.col(parts.kept[static_cast<std::size_t>(j)]);
      for (Index i = 0; i < n; ++i) left[i] -= column[i] * x[j];
    }
    if (all_digits) return Refined{std::move(x), left.squaredNorm()};
    if (length > kStalled * before) return std::nullopt;
    before = length;
    rest = (left - residual).cast<double>();
  }
  return std::nullopt;
}

// Solves for the kept columns in 106 bits throughout. Empty if their design is
// dependent even so.
std::optional<ExtendedLeastSquaresFit> SolveExactly(
    Problem* problem, const std::vector<Index>& kept) {
  const ExtendedSystem& exact = problem->exact();
  ExtendedLeastSquaresFit fit =
      SolveExtendedLeastSquares(exact.design(Eigen::all, kept), exact.response);
  if (!fit.full_rank) return std::nullopt;
  return fit;
}

// max over j of epsilon / 2 |row j of R^-1| (|y| + |R^-1| |r|) / |b_j|:
// relative error that rounding may leave in the worst coefficient of a solution
// (k).
double ErrorEstimate(const MatrixXd& triangle,
                     const VectorXd& solution,
                     double length,
                     double residual) {
  const Index k = triangle.cols();
  const MatrixXd inverse =
      triangle.triangularView<Eigen::Upper>().solve(MatrixXd::Identity(k, k));
  const double turned = inverse.norm() * residual;
  return 0.5 * kEpsilon * (length + turned) *
         (inverse.rowwise().norm().array() / solution.array().abs()).maxCoeff();
}

// Values of the kept columns, in the caller's units; NaN for the others.
VectorXd InPlace(const Problem& problem,
                 const std::vector<Index>& kept,
                 const ExtendedVector& values) {
  VectorXd all = VectorXd::Constant(problem.scales().size(), stats::kNaN);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const Index j = kept[k];
    all[j] = values[static_cast<Index>(k)].hi * problem.scales()[j];
  }
  return all;
}

// Adds the digits that double lacks; nothing if they cannot be obtained.
void AddDigits(Problem* problem,
               const Decomposition& parts,
               LeastSquaresFit* fit) {
  const LeastSquaresOptions& options = problem->options();
  const auto rank = static_cast<double>(fit->rank);
  const double values = static_cast<double>(problem->y().size()) * rank;
  const bool few = values * rank <= kMostProducts;
  const bool must = !fit->nearly_aliased.empty();
  if (!must && values > kMostRefinedValues) return;
  std::optional<Refined> refined = Refine(problem, parts, fit->condition);
  std::optional<ExtendedLeastSquaresFit> solved;
  if (refined ? options.with_deviations && few : must || few) {
    solved = SolveExactly(problem, parts.kept);
  }
  if (!refined && solved) {
    refined = {solved->coefficients, solved->residual_sum_of_squares};
  }
  if (!refined) return;
  const VectorXd found = InPlace(*problem, parts.kept, refined->coefficients);
  fit->coefficients(parts.kept) = found(parts.kept);
  fit->residual_sum_of_squares = refined->residual_sum_of_squares.hi;
  fit->bits = stats::kDoubleDoubleBits;
  if (options.with_deviations && solved) {
    fit->standard_deviations =
        InPlace(*problem, parts.kept, solved->standard_deviations);
  }
}

}  // namespace

void LeastSquaresOptions::Validate() const {
  constexpr double kMostDigits = 15.0;
  stats::Require(digits >= 0.0 && digits <= kMostDigits,
                 "LeastSquaresOptions: digits must be 0 to 15",
                 digits);
}

double CountObservations(Index rows, const VectorXd& weights) {
  return static_cast<double>(
      weights.size() == 0 ? rows : (weights.array() > 0.0).count());
}

MatrixXd RegressionProblem::Design() const {
  MatrixXd design(response.size(), terms.cols() + 1);
  design.col(0) = InterceptColumn();
  design.rightCols(terms.cols()) = terms;
  return design;
}

LeastSquaresFit SolveLeastSquares(const MatrixXd& design,
                                  const VectorXd& response,
                                  const VectorXd& weights,
                                  const LeastSquaresOptions& options) {
  options.Validate();
  CheckProblem(design, response, weights);
  Problem problem(design, response, weights, options);
  Decomposition parts = Decompose(&problem, false);

  LeastSquaresFit fit;
  fit.rank = std::ssize(parts.kept);
  fit.aliased = std::move(parts.aliased);
  fit.nearly_aliased = std::move(parts.nearly_aliased);
  fit.coefficients = VectorXd::Zero(design.cols());
  fit.residual_sum_of_squares = problem.y().squaredNorm();
  if (fit.rank == 0) return fit;
  fit.condition = PivotRatio(parts.triangle);

  const MatrixXd& triangle = parts.triangle;
  const VectorXd solved =
      triangle.triangularView<Eigen::Upper>().solve(parts.rotated);
  VectorXd scaled = VectorXd::Zero(design.cols());
  scaled(parts.kept) = solved;
  const VectorXd residual = problem.y() - problem.columns() * scaled;
  fit.residual_sum_of_squares = residual.squaredNorm();
  fit.coefficients = scaled.cwiseProduct(problem.scales());
  const bool has_digits =
      options.digits == 0.0 ||
      ErrorEstimate(triangle, solved, problem.y().norm(), residual.norm()) <=
          std::pow(10.0, -options.digits);
  if (!has_digits || !fit.nearly_aliased.empty()) {
    AddDigits(&problem, parts, &fit);
  }
  return fit;
}

MatrixXd OrthonormalColumns(const MatrixXd& design) {
  const VectorXd nothing = VectorXd::Zero(design.rows());
  const VectorXd equal;
  CheckProblem(design, nothing, equal);
  const LeastSquaresOptions options;
  Problem problem(design, nothing, equal, options);
  return Decompose(&problem, true).basis;
}

}  // namespace errmap::fitting
