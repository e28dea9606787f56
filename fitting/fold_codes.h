#pragma once

#include <vector>

#include "stats/eigen.h"

namespace errmap::fitting {

/// Folds of a cross-validation, and the rows from which each is predicted.
struct FoldCodes {
  std::vector<Index> codes;  // (n) fold of each row, from 0
  /// True if a fold is predicted only from earlier folds, so that the first is
  /// never judged. False if it is predicted from all others.
  bool forward = false;

  struct Rows {
    std::vector<Index> train;
    std::vector<Index> test;
  };

  /// Number of folds; 0 if there are no codes.
  Index count() const;
  Index first_judged() const { return forward ? 1 : 0; }
  /// True if `row` is among the rows that predict `fold`.
  bool Fits(Index fold, std::size_t row) const {
    return forward ? codes[row] < fold : codes[row] != fold;
  }
  /// Training and test rows of a judged fold, each ascending.
  Rows Split(Index fold) const;
  /// The same of every judged fold.
  std::vector<Rows> Splits() const;
};

}  // namespace errmap::fitting
