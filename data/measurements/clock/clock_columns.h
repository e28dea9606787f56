#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// Returns columns that may hold the times of these rows, judged by names and
/// values: groups of indices into the table, the most likely first.
std::vector<std::vector<std::size_t>> ColumnsOfTime(
    const CsvTable& table,
    const DatasetSelection& selection,
    const std::vector<Eigen::Index>& rows);

/// Returns the only column of dates without hours, or -1.
std::ptrdiff_t ColumnOfDates(const CsvTable& table,
                             const DatasetSelection& selection);

}  // namespace errmap::data
