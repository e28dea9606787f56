#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"

namespace errmap::models {

/// A hash of each row of `inputs` and, unless null, its target; in single
/// precision, as conversions of units change last digits.
std::vector<std::uint64_t> RowHashes(const Eigen::MatrixXd& inputs,
                                     const Eigen::VectorXd* targets);

/// The share of rows whose hash stands in another session too, or in another
/// group where there is one session: what new rows share by chance.
double ShareAlike(const data::Dataset& training,
                  const std::vector<std::uint64_t>& hashes);

/// Whether so many of `looked` rows are more than rows share by chance.
bool AreMoreThanChance(double found, double looked, double share_by_chance);

/// How many rows of `judged` stand in `training` too, inputs and target; 0
/// where they are no more than chance would make. `judged` has its inputs.
Eigen::Index CountRowsOf(const data::Dataset& training,
                         const data::Dataset& judged);

}  // namespace errmap::models
