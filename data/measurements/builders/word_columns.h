#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// A remark on a column of words.
struct PartingRemark {
  std::string text;
  bool is_doubt = false;  // its rows err differently
};

/// Tests whether columns of words (indices into the table) divide the rows into
/// parts with different errors, such as machines, tools and directions. It
/// compares linear maps of all rows with those of each value. The columns have
/// 2 to 12 values that change within one of `sessions` (a code for each row;
/// empty: one). Columns that pass PartsComponents always get a remark.
std::vector<PartingRemark> FindParts(const CsvTable& table,
                                     const std::vector<std::size_t>& words,
                                     const Dataset::Parts& parts,
                                     const std::vector<Eigen::Index>& sessions);

}  // namespace errmap::data
