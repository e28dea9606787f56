#pragma once

#include <vector>

#include "stats/eigen.h"

namespace errmap::fitting {

/// Folds of a cross-validation, and the training rows of each.
struct FoldCodes {
  std::vector<Index> codes;  // (n) fold of each row, from 0
  /// True if each fold is predicted from earlier folds only, so the first is
  /// never tested. False if it is predicted from all others.
  bool forward = false;

  struct Rows {
    std::vector<Index> train;
    std::vector<Index> test;
  };

  /// Number of folds; 0 if there are no codes.
  Index count() const;
  Index first_judged() const { return forward ? 1 : 0; }
  /// True if `row` is a training row of `fold`.
  bool Fits(Index fold, std::size_t row) const {
    return forward ? codes[row] < fold : codes[row] != fold;
  }
  /// Training and test rows of a fold, each ascending.
  Rows Split(Index fold) const;
  /// The same for every tested fold.
  std::vector<Rows> Splits() const;
};

}  // namespace errmap::fitting
