#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/axis/motion.h"
#include "data/measurements/dataset.h"
#include "data/measurements/reading/reading.h"

namespace errmap::data {

/// The columns of directions and cycles, derived from the positions if the
/// table has none.
inline constexpr const char* kDirectionColumn = "direction";
inline constexpr const char* kCycleColumn = "cycle";

/// Returns a column of two words or numbers with the name of a direction; -1:
/// none.
std::ptrdiff_t NamedDirection(const CsvTable& table,
                              const DatasetSelection& selection,
                              const std::vector<Eigen::Index>& rows);

/// Returns a column of two values, whatever its name, that follows the
/// direction of motion through the positions; -1: none. `motion` is that of
/// `rows`.
std::ptrdiff_t DirectionByValues(const CsvTable& table,
                                 std::size_t target,
                                 const std::vector<Eigen::Index>& rows,
                                 const Motion& motion);

/// Returns which of the two values of a column means upwards, by words for
/// positions ("up" and "down", "+" and "-"). For other words ("forward", "A"),
/// the order of the rows decides. If the order contradicts the words, it may
/// not be that of measurement. The file's words then count, but as uncertain.
/// `motion` is that of `rows`, without passes if there is none. `ordered`: the
/// rows are in the order of measurement.
Reading::Direction ReadDirection(const CsvTable& table,
                                 const CsvColumn& column,
                                 const std::vector<Eigen::Index>& rows,
                                 const Motion& motion,
                                 bool ordered);

/// Returns the index of the requested direction: the one with that word in the
/// file, else the one with that motion. Nothing if there is none.
std::optional<std::size_t> PlaceOfWay(const Reading::Direction& found,
                                      const std::string& wanted);

/// Returns filters for the rows of each of the two directions; none if there is
/// only one, or if `selection` has chosen one.
std::vector<ColumnFilter> DirectionsOf(const Reading& reading,
                                       const DatasetSelection& selection);

/// Returns the column of "up" and "down" that motion gives for `rows`, "" in
/// other rows.
CsvColumn DirectionColumn(const CsvTable& table,
                          const std::vector<Eigen::Index>& rows,
                          const Motion& motion);

}  // namespace errmap::data
