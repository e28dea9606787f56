#pragma once

#include <vector>

#include <Eigen/Core>

namespace errmap::fitting {

struct ForwardSelectionOptions {
  /// Most candidates to choose; below 0: no limit but the rows.
  Eigen::Index max_terms = -1;
  /// A candidate is passed over while what the chosen terms leave of it is
  /// shorter than this times the candidate; above 0, below 1. R's lm has 1e-7.
  double collinearity = 1e-7;

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

/// One step of a selection.
struct SelectionStep {
  Eigen::Index candidate = -1;           // -1: the intercept alone, the start
  double residual_sum_of_squares = 0.0;  // weighted
  double bic = 0.0;  // n ln(RSS / n) + k ln n, k coefficients with intercept
};

struct SelectionResult {
  std::vector<Eigen::Index> chosen;  // columns of the design, in order of entry
  std::vector<SelectionStep> steps;  // the start and each entry
};

/// Forward selection by BIC (Schwarz 1978): from the intercept alone, enters
/// the candidate that lowers the residual sum of squares most for as long as
/// BIC falls (ties: the lowest column).
///
/// `candidates` (n x m) without an intercept column, `response` (n), `weights`
/// (n) positive or (0). Each step costs one pass over the candidates, which
/// stay orthogonal to the chosen terms (modified Gram-Schmidt).
/// Throws std::invalid_argument on shapes that do not agree or n < 2.
SelectionResult SelectForward(const Eigen::MatrixXd& candidates,
                              const Eigen::VectorXd& response,
                              const Eigen::VectorXd& weights,
                              const ForwardSelectionOptions& options = {});

}  // namespace errmap::fitting
