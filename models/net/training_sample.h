#pragma once

#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"

namespace errmap::models {

/// Returns at most `most` representative rows of `training`, ascending; all if
/// there are no more. Takes whole groups if enough of them fit: one drawn from
/// each stretch of groups in file order. Else takes one row drawn from each
/// stretch of rows, since regular steps might hit the same positions
/// repeatedly. The draw depends only on `training` and `most`. Throws
/// std::invalid_argument if most < 1.
std::vector<Eigen::Index> StratifiedRows(const data::Dataset& training,
                                         Eigen::Index most);

/// Returns the same for `count` rows without groups.
std::vector<Eigen::Index> StratifiedRows(Eigen::Index count, Eigen::Index most);

}  // namespace errmap::models
