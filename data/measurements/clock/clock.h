#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "data/measurements/reading/reading.h"

namespace errmap::data {

/// The times at which the requested rows (n) were measured.
struct Clock {
  std::ptrdiff_t column = -1;       // index into the table; -1: row numbers
  std::ptrdiff_t date_column = -1;  // of dates beside times of day
  Eigen::VectorXd time;             // (n) s, or numbers of rows
  std::vector<bool> known;          // (n) false: missing there
  bool dated = false;               // dates, in seconds since 1970
  bool hours_alone = false;         // times of day without dates
  std::string unit = "rows";        // of the column: "s", "ms", "date", ...
  std::string origin;               // "1970", "midnight", "begin"
  Evidence evidence = Evidence::kNone;
  bool sure = true;
  std::optional<std::string> alternative;
  std::vector<std::string> remarks;  // on its unit, the order of dates, ...
  /// A cell without which a column would be the clock, or its dates: column and
  /// row of the table. Few are missing.
  std::optional<std::pair<std::size_t, std::size_t>> lacks;

  bool is_found() const { return column >= 0; }
  /// True if each row has a later date than the previous one, so that no
  /// reading occurs twice.
  bool DatesRise() const;
};

/// Finds the column of times: the one that `selection` names, else one whose
/// name and values are times. These are dates and times of day as text (one
/// column or two), or numbers. Numbers have the unit in the name if steps and
/// span are then plausible (0.01 s to a day; under ten years). Otherwise they
/// have the unit that makes them plausible. Throws InputError if a named column
/// is unusable, OpenQuestion if no unit is plausible, or several are.
Clock FindClock(const CsvTable& table,
                const DatasetSelection& selection,
                const std::vector<Eigen::Index>& rows);

/// Makes a clock continuous, for rows in the order of measurement, with a
/// remark if it changes a time. It corrects times of day that pass midnight,
/// hours from 1 to 12 after noon, and a dated clock set back by up to an hour
/// (to three steps), as at the end of summer time.
void GoOnOverMidnight(const CsvTable& table,
                      const std::vector<Eigen::Index>& rows,
                      Clock* clock);

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
