#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// Rows at which the temperatures fall. A machine takes hours to cool, so there
/// was a pause before each, as between days in one file.
struct ColdStarts {
  std::vector<Eigen::Index> rows;  // places among those given; may be empty
  bool at_rest = false;            // true: back to where the machine rests
};

/// Finds falls of most thermometers that warm, from one of the `rows` (n) to
/// the next and by far more than elsewhere. They do not count as falls to rest
/// if they leave fewer than two of the `passes` (n, may be empty) between them:
/// short pauses cool, too.
ColdStarts FindColdStarts(const CsvTable& table,
                          const std::vector<Eigen::Index>& rows,
                          const std::vector<Eigen::Index>& passes);

/// Rows at which cycle numbers start again.
struct CycleRestarts {
  std::string column;
  std::vector<bool> begins;  // (rows) the first row is none
};

/// Returns the restarts of the first of `cycles` (indices into the table; -1 is
/// none) whose numbers count up or down and sometimes start again. The rows are
/// in the order of measurement.
std::optional<CycleRestarts> FindCycleRestarts(
    const CsvTable& table,
    const std::vector<Eigen::Index>& rows,
    const std::vector<std::ptrdiff_t>& cycles);

/// True if cycles start again less often than the date changes: they continue
/// over midnight.
bool CountOver(const CycleRestarts& restarts,
               const CsvColumn& date,
               const std::vector<Eigen::Index>& rows);

/// True if cycles start again more often than there are sessions. They must
/// start again at every new session, and elsewhere only where another column of
/// sessions changes, such as days and shifts.
bool PartFurther(const CycleRestarts& restarts,
                 const Grouping& sessions,
                 const CsvTable& table,
                 const std::vector<Eigen::Index>& rows);

}  // namespace errmap::data
