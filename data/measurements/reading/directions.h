#pragma once

#include <cstddef>
#include <optional>
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

/// Which of the two values of a column is upwards, by words that say it of the
/// positions ("up" and "down", "+" and "-"). Others ("forward", "A") say
/// nothing of them, and the order of the rows tells. Where it contradicts the
/// words it may be another than that of measurement: the file's words are kept,
/// unsure. `motion` is that of `rows`, without passes where there is none;
/// `ordered`: the rows are in the order of measurement.
Reading::Direction ReadDirection(const CsvTable& table,
                                 const CsvColumn& column,
                                 const std::vector<Eigen::Index>& rows,
                                 const Motion& motion,
                                 bool ordered);

/// Index of the way that somebody wants: the one that the file calls so, else
/// the one that goes so; nothing where none does.
std::optional<std::size_t> PlaceOfWay(const Reading::Direction& found,
                                      const std::string& wanted);

/// The rows of each of the two ways through the positions, as filters; none
/// where there is one way, or `selection` has taken one.
std::vector<ColumnFilter> DirectionsOf(const Reading& reading,
                                       const DatasetSelection& selection);

/// The column of "up" and "down" that motion tells of `rows`, "" in others.
CsvColumn DirectionColumn(const CsvTable& table,
                          const std::vector<Eigen::Index>& rows,
                          const Motion& motion);

}  // namespace errmap::data
