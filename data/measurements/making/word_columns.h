#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// What is said of a column of words.
struct PartingRemark {
  std::string text;
  bool is_doubt = false;  // its rows err differently
};

/// Looks whether columns of words (indices into the table) part the rows of a
/// data set into things that err differently, as machines, tools and directions
/// do, by plain linear maps of all rows and of each value: columns of 2 to 12
/// values that change within one of `sessions` (a code for each of the rows;
/// empty: one). Those that PartsComponents are mentioned in any case.
std::vector<PartingRemark> FindParts(const CsvTable& table,
                                     const std::vector<std::size_t>& words,
                                     const Dataset::Parts& parts,
                                     const std::vector<Eigen::Index>& sessions);

}  // namespace errmap::data
