#pragma once

#include <vector>

#include <Eigen/Core>

namespace errmap::models {

/// Rows of a design.
struct TermRows {
  Eigen::MatrixXd terms;    // (rows x k)
  Eigen::VectorXd targets;  // (rows)
};

/// Least squares in which the rows of a session share an offset: squares of
/// differences between sessions have weight `between` relative to changes
/// within one. Rows are fitted less 1 - sqrt(between) times their session's
/// mean (Fuller and Battese 1973).
class SessionOffsets {
 public:
  /// Leaves rows as they are.
  SessionOffsets() = default;
  /// `sessions` has a code for each row. Every row must be included once before
  /// any is fitted.
  SessionOffsets(std::vector<Eigen::Index> sessions,
                 Eigen::Index num_terms,
                 double between);

  /// `rows` are indices into all rows; `weights` (rows), or (0): all 1.
  void Include(const std::vector<Eigen::Index>& rows,
               const TermRows& design,
               const Eigen::VectorXd& weights);
  void TakeFrom(const std::vector<Eigen::Index>& rows, TermRows* design) const;
  /// Returns the share of a constant that remains in the rows.
  double kept() const { return kept_; }

 private:
  double kept_ = 1.0;
  std::vector<Eigen::Index> sessions_;
  TermRows sums_;            // (sessions) weighted
  Eigen::VectorXd weights_;  // (sessions)
};

}  // namespace errmap::models
