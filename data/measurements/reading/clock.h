#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "data/measurements/reading/reading.h"

namespace errmap::data {

/// When the rows asked for (n) were measured.
struct Clock {
  std::ptrdiff_t column = -1;       // index into the table; -1: row numbers
  std::ptrdiff_t date_column = -1;  // of the days, beside hours alone
  Eigen::VectorXd time;             // (n) s, or numbers of rows
  std::vector<bool> known;          // (n) false: missing there
  bool dated = false;               // from 1970, by dates
  bool hours_alone = false;         // times of day without a date
  std::string unit = "rows";        // of the column: "s", "ms", "date", ...
  std::string origin;               // "1970", "midnight", "begin"
  Evidence evidence = Evidence::kNone;
  bool sure = true;
  std::optional<std::string> alternative;
  std::vector<std::string> remarks;  // on its unit, its order of dates, others

  bool is_found() const { return column >= 0; }
};

/// The column that `selection` names, else the one that by its name and its
/// values tells the time: text of dates and times of day (a column of dates and
/// one of hours serve together), or numbers. Their unit is that of the name
/// where steps and span are then those of a measurement (0.01 s to a day; under
/// ten years), else the one in which they are. Throws InputError where a named
/// column will not do, OpenQuestion where no unit or more than one will.
Clock FindClock(const CsvTable& table,
                const DatasetSelection& selection,
                const std::vector<Eigen::Index>& rows);

}  // namespace errmap::data
