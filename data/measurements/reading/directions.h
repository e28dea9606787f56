#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "data/measurements/reading/motion.h"
#include "data/measurements/reading/reading.h"

namespace errmap::data {

/// The column that says which way rows went, where the table has none and the
/// positions tell; and that of cycles.
inline constexpr const char* kDirectionColumn = "direction";
inline constexpr const char* kCycleColumn = "cycle";

/// A column of two words or numbers that is called a direction; -1: none.
std::ptrdiff_t NamedDirection(const CsvTable& table,
                              const DatasetSelection& selection,
                              const std::vector<Eigen::Index>& rows);

/// A column of two values, whatever it is called, that goes with the way
/// through the positions; -1: none. `motion` is that of `rows`.
std::ptrdiff_t DirectionByValues(const CsvTable& table,
                                 std::size_t target,
                                 const std::vector<Eigen::Index>& rows,
                                 const Motion& motion);

/// The rows of each of the two ways through the positions, as filters; none
/// where there is one way, or `selection` has taken one.
std::vector<ColumnFilter> DirectionsOf(const Reading& reading,
                                       const DatasetSelection& selection);

/// The column of "up" and "down" that motion tells of `rows`, "" in others.
CsvColumn DirectionColumn(const CsvTable& table,
                          const std::vector<Eigen::Index>& rows,
                          const Motion& motion);

/// The columns that `filters`, `target` and `session` name and a table lacks,
/// where its positions or labels can tell them: for files that a map is used
/// on.
void AddDerivedColumns(const std::vector<ColumnFilter>& filters,
                       const std::string& position,
                       const std::string& target,
                       const std::string& session,
                       CsvTable* table);

}  // namespace errmap::data
