#pragma once

#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"

namespace errmap::models {

/// A candidate to measure next.
struct NextState {
  Eigen::Index candidate = 0;  // row of the candidates
  /// Mean prediction variance over all rows, measured and candidate, once this
  /// one and those before it are measured, over that before any of them.
  double variance_left = 1.0;
  /// Distance to the nearest measured state in whitened space.
  double distance = 0.0;
};

/// Which of the candidate states (rows of the same inputs) to measure next, the
/// best first, chosen one by one so that the mean variance of predictions over
/// all rows becomes least (I-optimality; Atkinson, Donev & Tobias 2007, Section
/// 10.6). The map is one in whitened inputs: quadratic in the position, linear
/// in the leading directions of the other inputs, and their products with the
/// position. Each candidate counts as `rows_per_candidate` measured rows: it is
/// visited as long as a state of the data is, some rows of it.
/// Throws std::invalid_argument where the inputs differ in number.
std::vector<NextState> ChooseNext(const data::Dataset& measured,
                                  const Eigen::MatrixXd& candidates,
                                  Eigen::Index most,
                                  double rows_per_candidate = 10.0);

}  // namespace errmap::models
