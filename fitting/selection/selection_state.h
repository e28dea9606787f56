#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "fitting/least_squares/linear_least_squares.h"
#include "fitting/least_squares/orthogonal_basis.h"
#include "fitting/selection/candidate_columns.h"

namespace errmap::fitting {

/// Where the element `index` of a std::vector stands.
inline std::size_t At(Eigen::Index index) {
  return static_cast<std::size_t>(index);
}

/// Rows and columns of a least-squares problem whose terms are being chosen.
/// References must outlive what is built on them.
struct SelectionProblem {
  const CandidateColumns& candidates;  // X (n x m), without the intercept
  const Eigen::VectorXd& response;     // y (n)
  /// (n) not negative, or (0): all equal.
  const Eigen::VectorXd& weights;
  /// (n) the column of the intercept, where rows are no observations but rows
  /// of a triangle; (0): ones.
  Eigen::VectorXd intercept = {};
  /// Number of observations; 0: the rows of a weight above 0.
  double observations = 0.0;

  double num_observations() const {
    return observations > 0.0 ? observations
                              : CountObservations(response.size(), weights);
  }
  /// Throws std::invalid_argument on shapes that do not agree, fewer than 2
  /// rows, negative weights or values that are not finite.
  void Validate(const char* caller) const;
};

/// A term on its way in or out.
struct SelectionMove {
  Eigen::Index candidate = -1;  // -1: there is none
  bool enters = true;
  double gain = 0.0;          // change of the residual sum of squares, >= 0
  Eigen::VectorXd direction;  // (n) unit vector that joins or leaves the span
};

/// The chosen terms with an orthonormal basis of their span, and of every
/// candidate what that span leaves: its squared length z'z and its product
/// with the response z'y. Both are downdated by X'q when a unit vector q
/// joins, never formed anew; each carries a bound of its rounding error, and
/// where that bound could change which candidate is best, the candidate is
/// orthogonalised again. The cost of a step is one pass X'q.
class SelectionState {
 public:
  SelectionState(const SelectionProblem& problem, double collinearity);

  const std::vector<Eigen::Index>& chosen() const { return chosen_; }
  bool is_chosen(Eigen::Index candidate) const {
    return is_chosen_[static_cast<std::size_t>(candidate)];
  }
  double residual_sum_of_squares() const { return residual_.squaredNorm(); }
  /// sqrt(w) (y - fit) (n).
  const Eigen::VectorXd& residual() const { return residual_; }
  /// Diagonal of the hat matrix (n).
  const Eigen::VectorXd& leverage() const { return leverage_; }
  /// Below this a residual sum of squares is rounding.
  double noise() const { return noise_; }

  /// The entry among candidates with `open` true that explains most; ties go
  /// to the lowest. Candidates that the chosen terms determine are passed over.
  SelectionMove BestEntry(const std::vector<bool>& open);
  /// The entry of one candidate; no candidate in the move where the chosen
  /// terms determine it.
  SelectionMove EntryOf(Eigen::Index candidate);
  /// The exits of all chosen terms, in order of their entry; their directions
  /// are filled where asked for.
  std::vector<SelectionMove> Exits(bool with_directions) const;
  /// The exit of one chosen term, with its direction.
  SelectionMove ExitOf(Eigen::Index candidate) const;

  void Apply(const SelectionMove& move);

 private:
  Eigen::VectorXd WeightedColumn(Eigen::Index candidate) const;
  Eigen::VectorXd Products(const Eigen::VectorXd& direction) const;
  void Renew(Eigen::Index candidate);
  bool IsCollinear(Eigen::Index candidate) const;

  const SelectionProblem& problem_;
  Eigen::VectorXd roots_;     // sqrt of the weights, or (0)
  Eigen::VectorXd response_;  // weighted
  double collinearity_;
  double rounding_;  // relative error of a product of two vectors
  double noise_;
  OrthogonalBasis basis_;
  std::vector<Eigen::Index> chosen_;
  std::vector<bool> is_chosen_;
  Eigen::VectorXd residual_;
  Eigen::VectorXd leverage_;
  // Of each candidate:
  Eigen::VectorXd length_;        // |x|
  Eigen::VectorXd rest_squared_;  // z'z
  Eigen::VectorXd rest_error_;
  Eigen::VectorXd product_;  // z'y
  Eigen::VectorXd product_error_;
  std::vector<bool> is_fresh_;      // both are exact for the present span
  std::vector<bool> is_collinear_;  // until a term leaves
};

}  // namespace errmap::fitting
