#pragma once

#include <vector>

#include "models/study/study.h"
#include "stats/eigen.h"

namespace errmap::models {

/// An input in a fold's training rows and in its held-out rows.
struct FoldValues {
  VectorXd trained;
  VectorXd tested;
};
FoldValues ValuesOfFold(const data::Dataset& dataset,
                        const Holdout& holdout,
                        const stats::Fold& fold,
                        Index input);

/// Tells for each fold's held-out rows, in their order, if an input of the map
/// lies outside the fold's training range: the fold extrapolates there.
std::vector<Eigen::Array<bool, Eigen::Dynamic, 1>> ExtrapolatedRows(
    const data::Dataset& dataset,
    const Holdout& holdout,
    const FittedModel& map);

}  // namespace errmap::models
