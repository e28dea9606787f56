#pragma once

#include <vector>

#include <Eigen/Core>

namespace errmap::fitting {

/// Folds of a cross-validation, and which rows each is predicted from.
struct FoldCodes {
  std::vector<Eigen::Index> codes;  // (n) fold of each row, from 0
  /// A fold is predicted from those before it alone, so the first is never
  /// judged; else from all others.
  bool forward = false;

  struct Rows {
    std::vector<Eigen::Index> train;
    std::vector<Eigen::Index> test;
  };

  /// 0 where there are no codes.
  Eigen::Index count() const;
  Eigen::Index first_judged() const { return forward ? 1 : 0; }
  /// True where `row` is among the rows that predict `fold`.
  bool Fits(Eigen::Index fold, std::size_t row) const {
    return forward ? codes[row] < fold : codes[row] != fold;
  }
  /// Rows of a judged fold, ascending.
  Rows Split(Eigen::Index fold) const;
  /// Rows of the judged folds.
  Eigen::Index NumJudged() const;
};

}  // namespace errmap::fitting
