#pragma once

#include <vector>

#include <Eigen/Core>

namespace errmap::fitting {

/// Folds of a cross-validation, and the rows from which each is predicted.
struct FoldCodes {
  std::vector<Eigen::Index> codes;  // (n) fold of each row, from 0
  /// True if a fold is predicted only from earlier folds, so that the first is
  /// never judged. False if it is predicted from all others.
  bool forward = false;

  struct Rows {
    std::vector<Eigen::Index> train;
    std::vector<Eigen::Index> test;
  };

  /// Number of folds; 0 if there are no codes.
  Eigen::Index count() const;
  Eigen::Index first_judged() const { return forward ? 1 : 0; }
  /// True if `row` is among the rows that predict `fold`.
  bool Fits(Eigen::Index fold, std::size_t row) const {
    return forward ? codes[row] < fold : codes[row] != fold;
  }
  /// Training and test rows of a judged fold, each ascending.
  Rows Split(Eigen::Index fold) const;
  /// The same of every judged fold.
  std::vector<Rows> Splits() const;
};

}  // namespace errmap::fitting
