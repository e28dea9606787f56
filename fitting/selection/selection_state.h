#pragma once

#include <cstddef>
#include <vector>

#include "fitting/least_squares/linear_least_squares.h"
#include "fitting/least_squares/orthogonal_basis.h"
#include "stats/eigen.h"

namespace errmap::fitting {

/// Converts an Eigen index to an index of a std::vector.
inline std::size_t At(Index index) { return static_cast<std::size_t>(index); }

/// Rows and columns of a least-squares problem whose terms are being selected.
/// The references must outlive all users of the problem.
struct SelectionProblem {
  const MatrixXd& candidates;  // X (n x m), without the intercept
  const VectorXd& response;    // y (n)
  /// (n) not negative, or (0): all equal.
  const VectorXd& weights;
  /// (n) the intercept's column if the rows are those of a triangle, not
  /// observations; (0): ones.
  VectorXd intercept = {};
  /// Number of observations; 0: number of rows with weight above 0.
  double observations = 0.0;

  double num_observations() const {
    return observations > 0.0 ? observations
                              : CountObservations(response.size(), weights);
  }
  /// Throws std::invalid_argument if shapes do not agree, there are fewer than
  /// 2 rows, a weight is negative or a value is not finite.
  void Validate(const char* caller) const;
};

/// A term that enters or leaves.
struct SelectionMove {
  Index candidate = -1;  // -1: none
  bool enters = true;
  double gain = 0.0;   // change of the residual sum of squares, >= 0
  VectorXd direction;  // (n) unit vector that joins or leaves the span
};

/// The chosen terms with an orthonormal basis of their span. For every
/// candidate it keeps the part z orthogonal to that span: the squared length
/// z'z and the product with the response z'y. Both are downdated by X'q when a
/// unit vector q joins, never recomputed; each carries a bound of its rounding
/// error. A candidate is orthogonalised again if that bound could change which
/// one is best. A step costs one pass X'q.
class SelectionState {
 public:
  SelectionState(const SelectionProblem& problem, double collinearity);

  const std::vector<Index>& chosen() const { return chosen_; }
  bool is_chosen(Index candidate) const {
    return is_chosen_[static_cast<std::size_t>(candidate)];
  }
  double residual_sum_of_squares() const { return residual_.squaredNorm(); }
  /// sqrt(w) (y - fit) (n).
  const VectorXd& residual() const { return residual_; }
  /// Diagonal of the hat matrix (n).
  const VectorXd& leverage() const { return leverage_; }
  /// Residual sums of squares below this are rounding.
  double noise() const { return noise_; }

  /// Returns the best entry among candidates with `open` true; ties go to the
  /// lowest. Skips candidates determined by the chosen terms.
  SelectionMove BestEntry(const std::vector<bool>& open);
  /// Returns the entry of one candidate; its `candidate` is -1 if the chosen
  /// terms determine it.
  SelectionMove EntryOf(Index candidate);
  /// Returns the exits of all chosen terms, in order of entry, with their
  /// directions if requested.
  std::vector<SelectionMove> Exits(bool with_directions) const;
  /// Returns the exit of one chosen term, with its direction.
  SelectionMove ExitOf(Index candidate) const;

  void Apply(const SelectionMove& move);

 private:
  VectorXd WeightedColumn(Index candidate) const;
  VectorXd Products(const VectorXd& direction) const;
  void Renew(Index candidate);
  bool IsCollinear(Index candidate) const;

  const SelectionProblem& problem_;
  VectorXd roots_;     // sqrt of the weights, or (0)
  VectorXd response_;  // weighted
  double collinearity_;
  double rounding_;  // relative error of a product of two vectors
  double noise_;
  OrthogonalBasis basis_;
  std::vector<Index> chosen_;
  std::vector<bool> is_chosen_;
  VectorXd residual_;
  VectorXd leverage_;
  // For each candidate:
  VectorXd length_;        // |x|
  VectorXd rest_squared_;  // z'z
  VectorXd rest_error_;
  VectorXd product_;  // z'y
  VectorXd product_error_;
  std::vector<bool> is_fresh_;      // both are exact for the present span
  std::vector<bool> is_collinear_;  // until a term leaves
};

}  // namespace errmap::fitting
