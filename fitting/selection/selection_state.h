#pragma once

#include <cstddef>
#include <vector>

#include "fitting/least_squares/linear_least_squares.h"
#include "fitting/least_squares/orthogonal_basis.h"
#include "stats/eigen.h"

namespace errmap::fitting {

/// Converts an Eigen index to an index of a std::vector.
inline std::size_t At(Index index) { return static_cast<std::size_t>(index); }

/// A candidate is skipped while its part orthogonal to the chosen terms is
/// shorter than this times the candidate, as in R's lm.
inline constexpr double kCollinear = 1e-7;

/// Throws std::invalid_argument if shapes do not agree, there are fewer than 2
/// rows, a weight is negative or a value is not finite.
void ValidateSelection(const RegressionProblem& problem, const char* caller);

/// A term that enters or leaves.
struct SelectionMove {
  Index candidate = -1;  // -1: none
  bool enters = true;
  double gain = 0.0;   // change of the residual sum of squares, >= 0
  VectorXd direction;  // (n) unit vector that joins or leaves the span
};

/// The chosen terms with an orthonormal basis of their span. For every
/// candidate it keeps the part z orthogonal to that span: the squared length
/// z'z and the product with the response z'y. When a unit vector q joins, both
/// are updated by X'q and not recomputed. Each has a bound of its rounding
/// error. A candidate is orthogonalised again if that bound could change which
/// one is best. A step costs one pass X'q.
class SelectionState {
 public:
  explicit SelectionState(const RegressionProblem& problem);

  const std::vector<Index>& chosen() const { return chosen_; }
  bool is_chosen(Index candidate) const {
    return is_chosen_[static_cast<std::size_t>(candidate)];
  }
  double residual_sum_of_squares() const { return residual_.squaredNorm(); }
  /// sqrt(w) (y - fit) (n).
  const VectorXd& residual() const { return residual_; }
  /// Diagonal of the hat matrix (n).
  const VectorXd& leverage() const { return leverage_; }
  /// Residual sums of squares below this are only rounding.
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

  const RegressionProblem& problem_;
  VectorXd roots_;     // sqrt of the weights, or (0)
  VectorXd response_;  // weighted
  double rounding_;    // relative error of a product of two vectors
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
