#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"

namespace errmap::data {

/// The same numbers without a copy of them; `table` must outlive it.
CsvTable Borrowed(const CsvTable& table);

/// The rows of a table in another order (indices, each once); each keeps its
/// line of the file.
CsvTable InOrder(const CsvTable& table, const std::vector<Eigen::Index>& order);

/// A column of numbers; NaN is an empty cell.
CsvColumn NumberColumn(const std::string& name, std::vector<double> values);

/// A column that has words[code] in each row.
CsvColumn WordColumn(const std::string& name,
                     const std::vector<int>& codes,
                     std::vector<std::string> words);

/// "-correction_um" of a correction: its values with the other sign.
CsvColumn Negative(const CsvColumn& column);

}  // namespace errmap::data
