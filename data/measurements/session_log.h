#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/column_faults.h"
#include "data/measurements/dataset.h"
#include "data/measurements/sessions.h"

namespace errmap::data {

/// Gives `parts` a log of `log_rows` (n, ascending rows of the table), which
/// include those of `parts`, with the sessions (n) `found`. If they are the
/// same rows, the input values of `parts` become those of the log. Otherwise
/// cells of `blanked` are NaN in the log.
void TakeLog(const CsvTable& table,
             const std::vector<Eigen::Index>& log_rows,
             std::span<const ColumnFault> blanked,
             FoundSessions found,
             Dataset::Parts* parts);

/// Subtracts from the target the first value kept of each session (kFirst);
/// `parts` has a log. Returns the remark on it.
std::string AlignTarget(Dataset::Parts* parts);

}  // namespace errmap::data
