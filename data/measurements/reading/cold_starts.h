#pragma once

#include <vector>

#include <Eigen/Core>

#include "data/csv.h"

namespace errmap::data {

/// Rows (n) at which the thermometers fall: a machine takes hours to cool, so
/// there was a pause before each, as between days that stand one below the
/// other.
struct ColdStarts {
  std::vector<Eigen::Index> rows;  // places among those given; may be empty
  bool at_rest = false;            // true: back to where the machine rests
};

/// Finds falls of most thermometers that warm, from one row to the next and by
/// far more than at any other row. Falls of nearly each of the `passes` (n, may
/// be empty) do not count as falls to rest: pauses cool, too.
ColdStarts FindColdStarts(const CsvTable& table,
                          const std::vector<Eigen::Index>& rows,
                          const std::vector<Eigen::Index>& passes);

}  // namespace errmap::data
