#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "data/column_header.h"
#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "data/tables/cells/missing_cells.h"

namespace errmap::data {

/// The role of a column. It determines which cells are allowed, and the advice
/// in messages about them.
enum class ColumnUse { kTarget, kInput, kWeight, kGroup, kOther };

struct ColumnInUse {
  std::size_t index;  // into CsvTable::columns
  ColumnUse use;
};

/// Returns the column of `known` that was probably meant, with or without its
/// unit ("eror" for "error_mm"), or "".
std::string NearestColumn(std::string_view name,
                          const std::vector<std::string>& known);

/// Returns the index of a column that the user named by an argument
/// (ArgumentName). Throws InputError, with the known columns, if there is none.
std::size_t RequireColumn(const CsvTable& table,
                          std::string_view name,
                          std::string_view argument);

/// Throws InputError if the column holds no numbers at all.
void RequireNumbers(const CsvTable& table, const ColumnInUse& column);

/// Returns why a text that looks like a column's unit is not read as one.
std::string WhyNoUnit(const Header& header);

/// Throws InputError, with the known units, if a name has an unknown unit: in
/// brackets or parentheses, or for the target also bare.
void RequireKnownUnit(const CsvTable& table, const ColumnInUse& column);

/// Throws InputError if a column of numbers holds none. A column is meant to
/// have numbers if its name means a position. So is one whose every text is a
/// number with a unit or thousands separators ("12.7 mm", "1.234,5").
void RefuseNumbersAsText(const CsvTable& table, const CsvColumn& column);

/// Throws InputError if some numbers of these columns have a decimal comma and
/// others a decimal point: "1.234" may then be a thousand. Columns of groups
/// are skipped, since they have labels ("03.05.").
void RefuseMixedDecimals(const CsvTable& table,
                         const std::vector<ColumnInUse>& columns);

struct KeptRows {
  std::vector<Eigen::Index> rows;  // ascending, never empty
  std::size_t num_passed = 0;      // of which they are kept
  std::string first_missing;       // where; "" where all that pass are kept
};

/// Clears the flags in `passes` (one per row of the table) of rows that do not
/// pass `filter`, whose column must exist. Returns false if no row is left.
bool KeepPassing(const CsvTable& table,
                 const ColumnFilter& filter,
                 std::vector<bool>* passes);

/// Returns for each row of the table whether it passes all `filters`. Throws
/// InputError if a column is unknown or no row is left, listing the existing
/// values.
std::vector<bool> RowsThatPass(const CsvTable& table,
                               const std::vector<ColumnFilter>& filters);

/// Of the rows that pass (one flag per row of the table), returns those whose
/// cells in these columns are all finite numbers (groups: not missing). Throws
/// InputError on the first other cell. If `missing` says so, rows with an
/// empty, NA, NaN or infinite cell are dropped instead.
KeptRows CheckCells(const CsvTable& table,
                    const std::vector<ColumnInUse>& columns,
                    const std::vector<bool>& passes,
                    MissingPolicy missing);

/// Throws InputError if the cell is missing (IsMissingNumber).
void RefuseMissingCell(const CsvTable& table,
                       const ColumnInUse& column,
                       std::size_t row);

/// Returns the values of a column in these data rows.
Eigen::VectorXd ValuesOfRows(const CsvColumn& column,
                             const std::vector<Eigen::Index>& rows);

/// Throws InputError naming the table's file.
[[noreturn]] void ThrowUnusable(const CsvTable& table, const std::string& what);

/// Returns a column's name for a remark, printable and in full.
std::string NameInRemark(const std::string& name);

/// Returns names for a message, separated by commas, shortened if there are
/// many.
std::string ListOfNames(const std::vector<std::string>& names);

}  // namespace errmap::data
