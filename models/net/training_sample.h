#pragma once

#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"

namespace errmap::models {

/// At most `most` rows of `training`, ascending, that stand for all of them;
/// all where they are no more. Whole groups, one by chance out of each stretch
/// of groups in order of the file, while enough of them fit to stand for the
/// others; else one row by chance out of each stretch of rows: regular steps
/// might meet the same positions again and again. The draw depends on nothing
/// but `training` and `most`. Throws std::invalid_argument where most < 1.
std::vector<Eigen::Index> StratifiedRows(const data::Dataset& training,
                                         Eigen::Index most);

/// The same of `count` rows without groups.
std::vector<Eigen::Index> StratifiedRows(Eigen::Index count, Eigen::Index most);

}  // namespace errmap::models
