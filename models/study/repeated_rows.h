#pragma once

#include <cstdint>
#include <vector>

#include "data/measurements/dataset.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Returns a hash of each row of `inputs` and, unless null, its target. Values
/// are rounded to single precision, since unit conversions change the last
/// digits.
std::vector<std::uint64_t> RowHashes(const MatrixXd& inputs,
                                     const VectorXd* targets);

/// Returns the share of rows expected to occur again by chance: those whose
/// hash is also in another session, or in another group if there is one
/// session.
double ShareAlike(const data::Dataset& training,
                  const std::vector<std::uint64_t>& hashes);

/// True if `found` of `looked` rows is more than expected by chance.
bool AreMoreThanChance(Index found, double looked, double share_by_chance);

/// Returns how many rows of `judged` also occur in `training` (inputs and
/// target); 0 if chance explains them. `judged` must have the inputs of
/// `training`.
Index CountRowsOf(const data::Dataset& training, const data::Dataset& judged);

}  // namespace errmap::models
