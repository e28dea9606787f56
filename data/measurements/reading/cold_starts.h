#pragma once

#include <vector>

#include <Eigen/Core>

#include "data/csv.h"

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

}  // namespace errmap::data
