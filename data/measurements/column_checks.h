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

/// What a column serves as; decides what its cells may be and what a message
/// about them advises.
enum class ColumnUse { kTarget, kInput, kWeight, kGroup, kOther };

struct ColumnInUse {
  std::size_t index;  // into CsvTable::columns
  ColumnUse use;
};

/// The column of `known` that was probably meant, whether its unit was named or
/// not ("eror" for "error_mm"), or "".
std::string NearestColumn(std::string_view name,
                          const std::vector<std::string>& known);

/// Index of a column that somebody named by an argument (ArgumentName). Throws
/// InputError, with the known columns, where there is none.
std::size_t RequireColumn(const CsvTable& table,
                          std::string_view name,
                          std::string_view argument);

/// Throws InputError where the column holds no number at all.
void RequireNumbers(const CsvTable& table, const ColumnInUse& column);

/// Why the text that might be a column's unit is not read as one.
std::string WhyNoUnit(const Header& header);

/// Throws InputError, with the units known, where the name carries a unit that
/// is none we know: in brackets or parentheses, of the target bare, too.
void RequireKnownUnit(const CsvTable& table, const ColumnInUse& column);

/// Throws InputError where the column holds no number, though it is one of
/// numbers: positions by its name, or every text in it a number with a unit or
/// thousands separators ("12.7 mm", "1.234,5").
void RefuseNumbersAsText(const CsvTable& table, const CsvColumn& column);

/// Throws InputError where some numbers of these columns have a decimal comma
/// and others a decimal point: "1.234" may then be a thousand. Columns used as
/// groups are passed over, since they are labels ("03.05.").
void RefuseMixedDecimals(const CsvTable& table,
                         const std::vector<ColumnInUse>& columns);

struct KeptRows {
  std::vector<Eigen::Index> rows;  // ascending, never empty
  std::size_t num_passed = 0;      // of which they are kept
  std::string first_missing;       // where; "" where all that pass are kept
};

/// Takes from `passes` (one flag per row of the table) the rows that do not
/// pass `filter`, whose column must be there; false where none is left.
bool KeepPassing(const CsvTable& table,
                 const ColumnFilter& filter,
                 std::vector<bool>* passes);

/// Whether each row of the table passes all `filters`. Throws InputError where
/// a column is unknown or no row is left, naming the values that there are.
std::vector<bool> RowsThatPass(const CsvTable& table,
                               const std::vector<ColumnFilter>& filters);

/// Those of the rows that pass (one flag per row of the table) whose cells in
/// these columns are all finite numbers (groups: not missing). Throws
/// InputError on the first cell that is not, save that rows with an empty, NA,
/// NaN or infinite cell are dropped where `missing` says so.
KeptRows CheckCells(const CsvTable& table,
                    const std::vector<ColumnInUse>& columns,
                    const std::vector<bool>& passes,
                    MissingPolicy missing);

/// Throws InputError where the cell is missing (IsMissingNumber).
void RefuseMissingCell(const CsvTable& table,
                       const ColumnInUse& column,
                       std::size_t row);

/// Values of a column in these data rows.
Eigen::VectorXd ValuesOfRows(const CsvColumn& column,
                             const std::vector<Eigen::Index>& rows);

/// Throws InputError that names the table's file.
[[noreturn]] void ThrowUnusable(const CsvTable& table, const std::string& what);

/// A column's name for a remark: printable, and never cut short.
std::string NameInRemark(const std::string& name);

/// Names for a message, separated by commas; many are cut short.
std::string ListOfNames(const std::vector<std::string>& names);

}  // namespace errmap::data
