#pragma once

#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"

namespace errmap::data {

/// Keeps these rows of target, inputs and weights; `kept` are indices into
/// parts->rows, ascending.
void KeepRows(const std::vector<Eigen::Index>& kept, Dataset::Parts* parts);

/// Leaves out the marked inputs (p). Returns the new index of each input, -1
/// for those left out.
std::vector<Eigen::Index> LeaveOutInputs(const std::vector<bool>& left_out,
                                         Dataset::Parts* parts);

}  // namespace errmap::data
