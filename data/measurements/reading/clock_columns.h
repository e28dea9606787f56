#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// Columns that could tell when these rows were measured, by their names and
/// values: groups of indices into the table, the likeliest first.
std::vector<std::vector<std::size_t>> ColumnsOfTime(
    const CsvTable& table,
    const DatasetSelection& selection,
    const std::vector<Eigen::Index>& rows);

/// The only column of dates without hours, or -1.
std::ptrdiff_t ColumnOfDates(const CsvTable& table,
                             const DatasetSelection& selection);

}  // namespace errmap::data
