#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// Where numbers of cycles begin anew.
struct CycleRestarts {
  std::string column;
  std::vector<bool> begins;  // (rows) the first row is none
};

/// Those of the first of `cycles` (indices into the table; -1 is none) whose
/// cycles, some of these rows each, count up or down and anew now and then.
/// The rows are in the order of measurement.
std::optional<CycleRestarts> FindCycleRestarts(
    const CsvTable& table,
    const std::vector<Eigen::Index>& rows,
    const std::vector<std::ptrdiff_t>& cycles);

/// Whether cycles begin anew less often than a date changes: they go on over
/// midnight.
bool CountOver(const CycleRestarts& restarts,
               const CsvColumn& date,
               const std::vector<Eigen::Index>& rows);

/// Whether cycles begin anew more often than there are sessions, each time in
/// another one or where what else is called a session changes: days and the
/// shifts of each.
bool PartFurther(const CycleRestarts& restarts,
                 const Grouping& sessions,
                 const CsvTable& table,
                 const std::vector<Eigen::Index>& rows);

}  // namespace errmap::data
