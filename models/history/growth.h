#pragma once

#include <map>
#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"

namespace errmap::models {

/// Inputs of `rows` that hardly ever return to values they had, as an age does:
/// with three sessions or more the sessions' means only rise or only fall, and
/// of a later session on average less than a tenth of the rows lies within what
/// the earlier ones had. Rows held out of the middle lie between others there,
/// and all that is to come lies beyond them.
std::vector<bool> ColumnsThatOnlyGrow(const data::Dataset& rows);

/// Rows by session, in the order of the sessions.
std::map<Eigen::Index, std::vector<Eigen::Index>> RowsOfSessions(
    const data::Dataset& rows);

}  // namespace errmap::models
