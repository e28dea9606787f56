#include "fitting/least_squares/regression_diagnostics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "fitting/least_squares/decompositions.h"
#include "fitting/matrix_product.h"
#include "stats/f_test.h"
#include "stats/not_a_number.h"

namespace errmap::fitting {
namespace {

constexpr double kRounding = std::numeric_limits<double>::epsilon();
constexpr double kConfidence = 0.95;

void CheckShapes(const RegressionProblem& problem) {
  const Index rows = problem.response.size();
  if (rows < 1 || problem.terms.rows() != rows ||
      (problem.weights.size() != 0 && problem.weights.size() != rows) ||
      (problem.intercept.size() != 0 && problem.intercept.size() != rows)) {
    throw std::invalid_argument(
        "Diagnose: terms have " + std::to_string(problem.terms.rows()) +
        " rows, response " + std::to_string(rows) + ", weights " +
        std::to_string(problem.weights.size()) + ", intercept " +
        std::to_string(problem.intercept.size()));
  }
}

// R of a tall design, itself of another: it has the same singular values. Made
// at its final size: an Eigen matrix that is resized when memory ends is freed
// twice.
MatrixXd TriangleOf(const MatrixXd& design) {
  if (design.rows() <= design.cols()) return design;
  return Eigen::HouseholderQR<MatrixXd>(design)
      .matrixQR()
      .topRows(design.cols())
      .triangularView<Eigen::Upper>();
}

void FindCondition(const MatrixXd& centred,
                   const VectorXd& means,
                   const VectorXd& intercept,
                   RegressionDiagnostics* fit) {
  const Index first = fit->has_intercept ? 1 : 0;
  MatrixXd design(centred.rows(), centred.cols() + first);
  if (design.cols() == 0) return;
  if (fit->has_intercept) design.col(0) = intercept;
  design.rightCols(centred.cols()) = centred + intercept * means.transpose();
  for (Index j = 0; j < design.cols(); ++j) {
    const double length = design.col(j).norm();
    if (length > 0.0) design.col(j) /= length;
  }
  const VectorXd singular = SingularValues(TriangleOf(design));
  const double size =
      static_cast<double>(std::max(design.rows(), design.cols()));
  fit->condition = singular[0] / singular[singular.size() - 1];
  fit->effective_rank =
      (singular.array() > size * kRounding * singular[0]).count();
}

// The columns of a problem, weighted, centred and of length 1.
struct CentredProblem {
  VectorXd intercept;  // weighted
  double share = 0.0;  // 1 / its squared length; 0 without one
  double mean = 0.0;   // of the response
  VectorXd response;
  MatrixXd columns;
  VectorXd spread;  // lengths of the columns before
};

CentredProblem Centre(const RegressionProblem& problem,
                      RegressionDiagnostics* fit) {
  CentredProblem centred;
  const Index rows = problem.response.size();
  const VectorXd& intercept = centred.intercept =
      problem.Weighted(problem.InterceptColumn());
  const VectorXd y = problem.Weighted(problem.response);
  fit->sum_of_weights = intercept.squaredNorm();
  fit->has_intercept = fit->sum_of_weights > 0.0;
  centred.share = fit->has_intercept ? 1.0 / fit->sum_of_weights : 0.0;
  centred.mean = intercept.dot(y) * centred.share;
  centred.response = y - centred.mean * intercept;
  fit->total_sum_of_squares = centred.response.squaredNorm();

  const Index terms = problem.terms.cols();
  centred.columns.resize(rows, terms);
  centred.spread.resize(terms);
  fit->means.resize(terms);
  for (Index j = 0; j < terms; ++j) {
    VectorXd column = problem.Weighted(problem.terms.col(j));
    fit->means[j] = intercept.dot(column) * centred.share;
    column -= fit->means[j] * intercept;
    centred.spread[j] = column.norm();
    if (centred.spread[j] > 0.0) column /= centred.spread[j];
    centred.columns.col(j) = column;
  }
  return centred;
}

// For the k kept columns.
struct CentredSolution {
  VectorXd scaled;   // (k) coefficients
  MatrixXd inverse;  // (k x k) of the triangle
};

CentredSolution SolveKept(const MatrixXd& kept,
                          const VectorXd& response,
                          const VectorXd& spread,
                          RegressionDiagnostics* fit) {
  const Index k = kept.cols();
  CentredSolution solution{.scaled = VectorXd::Zero(k),
                           .inverse = MatrixXd(k, k)};
  if (k == 0) return solution;
  const Eigen::HouseholderQR<MatrixXd> qr(kept);
  solution.scaled = qr.solve(response);
  // One step of refinement: the residual holds what rounding left out.
  const VectorXd left = response - kept * solution.scaled;
  solution.scaled += qr.solve(left);
  const MatrixXd triangle =
      qr.matrixQR().topRows(k).triangularView<Eigen::Upper>();
  solution.inverse =
      triangle.triangularView<Eigen::Upper>().solve(MatrixXd::Identity(k, k));
  fit->triangle = triangle * spread.asDiagonal();
  return solution;
}

// From the sums of squares to s, R2 and F; gives s^2.
double AnalyseVariance(RegressionDiagnostics* fit, Index num_kept) {
  const double freedom = fit->observations - static_cast<double>(fit->rank);
  fit->residual_degrees_of_freedom = freedom;
  const double variance =
      freedom > 0.0 ? fit->residual_sum_of_squares / freedom : stats::kNaN;
  fit->s = std::sqrt(variance);
  if (fit->total_sum_of_squares > 0.0) {
    fit->r2 = 1.0 - fit->residual_sum_of_squares / fit->total_sum_of_squares;
    if (freedom > 0.0) {
      fit->adjusted_r2 = 1.0 - variance / (fit->total_sum_of_squares /
                                           fit->total_degrees_of_freedom());
    }
  }
  if (num_kept > 0 && freedom > 0.0) {
    const auto k = static_cast<double>(num_kept);
    fit->f = fit->regression_sum_of_squares / k / variance;
    fit->f_p = stats::FTestPValue(fit->f, k, freedom);
  }
  return variance;
}

}  // namespace

LeastSquaresFit SolveRegression(const RegressionProblem& problem,
                                const LeastSquaresOptions& options) {
  CheckShapes(problem);
  return SolveLeastSquares(
      problem.Design(), problem.response, problem.weights, options);
}

RegressionDiagnostics Diagnose(const RegressionProblem& problem) {
  return Diagnose(problem, SolveRegression(problem));
}

RegressionDiagnostics Diagnose(const RegressionProblem& problem,
                               const LeastSquaresFit& solution) {
  CheckShapes(problem);
  const Index terms = problem.terms.cols();
  if (solution.coefficients.size() != terms + 1) {
    throw std::invalid_argument("Diagnose: the solution has " +
                                std::to_string(solution.coefficients.size()) +
                                " coefficients for " + std::to_string(terms) +
                                " terms and an intercept");
  }
  RegressionDiagnostics fit;
  fit.observations = problem.num_observations();
  const CentredProblem centred = Centre(problem, &fit);
  for (Index j = 0; j < terms; ++j) {
    const bool is_aliased = std::binary_search(
        solution.aliased.begin(), solution.aliased.end(), j + 1);
    (is_aliased ? fit.aliased : fit.kept).push_back(j);
  }
  fit.bits = solution.bits;
  const bool is_extended = solution.bits > stats::kDoubleBits;
  const MatrixXd kept = centred.columns(Eigen::all, fit.kept);
  const VectorXd spread = centred.spread(fit.kept);
  const Index k = kept.cols();
  fit.rank = k + (fit.has_intercept ? 1 : 0);
  fit.coefficients.resize(static_cast<std::size_t>(terms));
  const auto [scaled, inverse] =
      SolveKept(kept, centred.response, spread, &fit);
  const VectorXd fitted = kept * scaled;
  fit.residual_sum_of_squares = is_extended
                                    ? solution.residual_sum_of_squares
                                    : (centred.response - fitted).squaredNorm();
  fit.regression_sum_of_squares = fitted.squaredNorm();
  const double variance = AnalyseVariance(&fit, k);

  const double freedom = fit.residual_degrees_of_freedom;
  const double quantile = stats::StudentTwoSidedQuantile(kConfidence, freedom);
  const auto complete =
      [&](double unscaled_variance, Index column, CoefficientEstimate* line) {
        line->standard_error = std::sqrt(variance * unscaled_variance);
        if (is_extended) {
          line->estimate = solution.coefficients[column];
        }
        if (solution.standard_deviations.size() != 0) {
          line->standard_error = solution.standard_deviations[column];
        }
        line->t = line->estimate / line->standard_error;
        line->p = stats::StudentTwoSidedP(line->t, freedom);
        line->lower = line->estimate - quantile * line->standard_error;
        line->upper = line->estimate + quantile * line->standard_error;
      };
  const double spread_y = std::sqrt(fit.total_sum_of_squares);
  VectorXd kept_means(k);
  for (Index i = 0; i < k; ++i) {
    const Index j = fit.kept[static_cast<std::size_t>(i)];
    CoefficientEstimate& line = fit.coefficients[static_cast<std::size_t>(j)];
    line.estimate = scaled[i] / spread[i];
    line.vif = inverse.row(i).squaredNorm();
    complete(line.vif / (spread[i] * spread[i]), j + 1, &line);
    if (spread_y > 0.0) line.standardised = scaled[i] / spread_y;
    kept_means[i] = fit.means[j] / spread[i];
  }
  if (fit.has_intercept) {
    fit.intercept.estimate = centred.mean - kept_means.dot(scaled);
    complete(centred.share + (inverse.transpose() * kept_means).squaredNorm(),
             0,
             &fit.intercept);
  }
  FindCondition(kept, kept_means, centred.intercept, &fit);
  return fit;
}

void RowDiagnostics::Add(const RegressionDiagnostics& fit,
                         const MatrixXd& terms,
                         const VectorXd& response,
                         const VectorXd& weights) {
  const Index k = std::ssize(fit.kept);
  VectorXd predicted = VectorXd::Constant(terms.rows(), fit.intercept.estimate);
  VectorXd leverage = VectorXd::Constant(
      terms.rows(), fit.has_intercept ? 1.0 / fit.sum_of_weights : 0.0);
  if (k > 0) {
    MatrixXd centred = terms(Eigen::all, fit.kept);
    for (Index i = 0; i < k; ++i) {
      const Index j = fit.kept[static_cast<std::size_t>(i)];
      predicted += fit.coefficients[static_cast<std::size_t>(j)].estimate *
                   centred.col(i);
      centred.col(i).array() -= fit.means[j];
    }
    // centred R^-1: at many terms and rows this is most of the second pass.
    DivideByUpperTriangle(fit.triangle, centred);
    leverage += centred.rowwise().squaredNorm();
  }
  if (weights.size() != 0) leverage = leverage.cwiseProduct(weights);
  for (Index i = 0; i < terms.rows(); ++i) {
    const double residual = response[i] - predicted[i];
    const double weight = weights.size() != 0 ? weights[i] : 1.0;
    const double slack = 1.0 - leverage[i];
    if (std::abs(residual) > std::abs(largest_residual) ||
        largest_residual_row < 0) {
      largest_residual = residual;
      largest_residual_row = rows + i;
    }
    largest_leverage = std::max(largest_leverage, leverage[i]);
    if (slack > kLeastSlack) {
      press += weight * (residual / slack) * (residual / slack);
    } else {
      ++leverage_one;
      press = std::numeric_limits<double>::infinity();
    }
  }
  rows += terms.rows();
}

AliasRelation ExplainAlias(const VectorXd& column,
                           const MatrixXd& others,
                           const VectorXd& intercept) {
  AliasRelation relation;
  const Index rows = column.size();
  const double tiny = static_cast<double>(rows) * kRounding;
  const VectorXd unit =
      (intercept.size() != 0 ? intercept : VectorXd::Ones(rows)).normalized();
  const auto centre = [&](const VectorXd& values) {
    return VectorXd(values - unit.dot(values) * unit);
  };
  const VectorXd centred = centre(column);
  if (!(centred.norm() > tiny * column.norm())) {
    relation.constant = true;
    return relation;
  }
  if (others.cols() == 0) return relation;
  MatrixXd scaled(rows, others.cols());
  for (Index j = 0; j < scaled.cols(); ++j) {
    scaled.col(j) = centre(others.col(j));
    const double length = scaled.col(j).norm();
    if (length > tiny * others.col(j).norm()) scaled.col(j) /= length;
  }
  constexpr double kSmallestPart = 1e-6;
  // One column alone where one does; else all that have a part.
  const VectorXd along = scaled.transpose() * centred;
  Index nearest = 0;
  along.cwiseAbs().maxCoeff(&nearest);
  if ((centred - along[nearest] * scaled.col(nearest)).norm() <=
      kSmallestPart * centred.norm()) {
    relation.columns.push_back(nearest);
    return relation;
  }
  const VectorXd parts =
      SolveLeastSquares(scaled, centred.normalized()).coefficients.cwiseAbs();
  for (Index j = 0; j < parts.size(); ++j) {
    if (parts[j] > kSmallestPart) relation.columns.push_back(j);
  }
  std::sort(relation.columns.begin(),
            relation.columns.end(),
            [&](Index a, Index b) { return parts[a] > parts[b]; });
  return relation;
}

}  // namespace errmap::fitting
