#pragma once

#include <vector>

#include "data/measurements/dataset.h"
#include "stats/eigen.h"

namespace errmap::models {

/// A candidate state to measure next.
struct NextState {
  Index row = 0;  // of the candidates
  /// Mean prediction variance over all measured and candidate rows, after this
  /// and all earlier choices, relative to the variance before the first choice.
  double variance_left = 1.0;
  /// Distance to the nearest measured state in whitened space.
  double distance = 0.0;
};

/// Chooses which candidate states (rows of the same inputs) to measure next,
/// best first. Chooses them one by one so that the mean prediction variance
/// over all rows is smallest (I-optimality; Atkinson, Donev & Tobias 2007,
/// Section 10.6). The assumed map has whitened inputs. It is quadratic in the
/// position and linear in the leading directions of the others, with products
/// of both. A candidate counts as 10 measured rows, since one visit gives
/// several rows. Throws std::invalid_argument if the numbers of inputs differ,
/// or if a candidate is so far away that its effect overflows.
std::vector<NextState> ChooseNext(const data::Dataset& measured,
                                  const MatrixXd& candidates,
                                  Index most);

}  // namespace errmap::models
