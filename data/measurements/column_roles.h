#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "data/csv.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

inline constexpr std::ptrdiff_t kNoColumn = -1;

/// Which column serves as what besides the inputs: indices into
/// CsvTable::columns.
struct ColumnRoles {
  std::size_t target = 0;
  std::ptrdiff_t group = kNoColumn;
  std::ptrdiff_t weight = kNoColumn;
  std::ptrdiff_t direction = kNoColumn;  // found after the others
};

/// Those that `selection` names, else the defaults of MakeDataset, before any
/// cell is looked at. Throws InputError: unknown column, one without numbers,
/// no or several candidates for the target, one column as two of them.
ColumnRoles ChooseRoles(const CsvTable& table,
                        const DatasetSelection& selection);

/// The column that numbers the cycles by its name, and the only one that is
/// called a time; kNoColumn: none. For tables that are not read whole.
std::ptrdiff_t CycleColumn(const CsvTable& table);
std::ptrdiff_t TimeColumn(const CsvTable& table);

/// Whether a column numbers or dates the rows by its name ("Cycle No.",
/// "Takt", "time_s"), or holds what no controller has.
bool KeepsRecord(std::string_view name);
/// The same, but for what has mostly digits behind the point: it measures.
bool KeepsRecord(const CsvColumn& column);

/// Whether a column goes with the number of the row, whatever it is called:
/// whole numbers without a unit, each above the one before, or each below; or
/// counts readings at each place: 1, 2, 3, 1, 2, 3.
bool CountsRows(const CsvColumn& column);

/// Whether an input is read by a sensor: it is no position and, having no unit,
/// counts no cycles, runs or alike ("elapsed_cycles", "n_runs").
bool IsSensor(const ColumnInfo& column);

/// Whether a column's name says that it counts cycles, runs or alike
/// ("elapsed_cycles"). Days are none: an age in days is a state that wears.
bool CountsCycles(const ColumnInfo& column);

/// Whether the values of a column make errors of their own, as up and down
/// motion differ by hysteresis: named direction, axis, machine or alike, with 2
/// to 24 values and no empty cell.
bool PartsComponents(const CsvTable& table, const CsvColumn& column);

}  // namespace errmap::data
