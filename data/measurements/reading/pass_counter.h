#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "data/measurements/reading/motion.h"

namespace errmap::data {

/// The column that numbers the passes of an axis, whatever it is called, from
/// its first number on or anew with each session; -1: none. `motion` is that of
/// `rows`; `target` is an index into the table.
std::ptrdiff_t PassCounter(const CsvTable& table,
                           const DatasetSelection& selection,
                           std::size_t target,
                           const std::vector<Eigen::Index>& rows,
                           const Motion& motion);

}  // namespace errmap::data
