#pragma once

#include <vector>

#include <Eigen/Core>

#include "models/study/study.h"

namespace errmap::models {

/// An input in the rows that a fold trains on and in those it holds out.
struct FoldValues {
  Eigen::VectorXd trained;
  Eigen::VectorXd tested;
};
FoldValues ValuesOfFold(const data::Dataset& dataset,
                        const Holdout& holdout,
                        const stats::Fold& fold,
                        Eigen::Index input);

/// Of the rows that each fold holds out, in its order, whether an input of the
/// map lies outside what the fold was trained on: there it extrapolates.
std::vector<Eigen::Array<bool, Eigen::Dynamic, 1>> ExtrapolatedRows(
    const data::Dataset& dataset,
    const Holdout& holdout,
    const FittedModel& map);

}  // namespace errmap::models
