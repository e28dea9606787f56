#pragma once

#include <vector>

#include "models/map_experience.h"
#include "models/study/study.h"
#include "stats/eigen.h"

namespace errmap::models {

using RowFlags = Eigen::Array<bool, Eigen::Dynamic, 1>;

/// The range of an input in a fold's training rows, and its values in the
/// held-out ones. Values beyond a bound by up to kRangeTolerance of the range
/// count as inside, since readings are noisy.
struct FoldValues {
  double low;
  double high;
  VectorXd tested;

  RowFlags Below() const { return tested.array() < low - tolerance(); }
  RowFlags Above() const { return tested.array() > high + tolerance(); }

 private:
  double tolerance() const { return kRangeTolerance * (high - low); }
};
FoldValues ValuesOfFold(const data::Dataset& dataset,
                        const Holdout& holdout,
                        const stats::Fold& fold,
                        Index input);

/// Returns for each fold's held-out rows, in their order, whether an input of
/// the map lies outside the fold's training range: the fold extrapolates there.
std::vector<RowFlags> ExtrapolatedRows(const data::Dataset& dataset,
                                       const Holdout& holdout,
                                       const FittedModel& map);

}  // namespace errmap::models
