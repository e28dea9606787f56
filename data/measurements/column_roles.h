#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "data/csv.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

inline constexpr std::ptrdiff_t kNoColumn = -1;

/// The columns with a role other than input: indices into CsvTable::columns.
struct ColumnRoles {
  std::size_t target = 0;
  std::ptrdiff_t group = kNoColumn;
  std::ptrdiff_t weight = kNoColumn;
  std::ptrdiff_t direction = kNoColumn;  // found after the others
};

/// Returns the columns that `selection` names, else the defaults of
/// MakeDataset, before any cell is examined. Throws InputError for an unknown
/// column, one without numbers, no or several candidates for the target, or one
/// column in two roles.
ColumnRoles ChooseRoles(const CsvTable& table,
                        const DatasetSelection& selection);

/// Returns the column named as a number of cycles, and the only one named as a
/// time; kNoColumn if there is none. For tables that are only partly read.
std::ptrdiff_t CycleColumn(const CsvTable& table);
std::ptrdiff_t TimeColumn(const CsvTable& table);

/// True if a column, judged by its name, numbers or dates the rows ("Cycle
/// No.", "Takt", "time_s"), or is unknown to controllers.
bool KeepsRecord(std::string_view name);
/// As above, but false for a column whose values mostly have decimals: that is
/// a measurement.
bool KeepsRecord(const CsvColumn& column);

/// True if a column follows the row number, whatever its name. Its values are
/// whole numbers without a unit that always rise or always fall, or that count
/// the readings at each position: 1, 2, 3, 1, 2, 3.
bool CountsRows(const CsvColumn& column);

/// True if an input is read by a sensor: it is not a position, and does not
/// count cycles, runs or the like without a unit ("elapsed_cycles", "n_runs").
bool IsSensor(const ColumnInfo& column);

/// True if a column's name says that it counts cycles, runs or the like
/// ("elapsed_cycles"). False for days: an age in days is a state of wear.
bool CountsCycles(const ColumnInfo& column);

/// True if each value of a column has its own error, as directions of motion
/// have because of hysteresis. The name means direction, axis, machine or the
/// like. The column has 2 to 24 values and no empty cell.
bool PartsComponents(const CsvTable& table, const CsvColumn& column);

}  // namespace errmap::data
