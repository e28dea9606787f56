#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "data/csv.h"

namespace errmap::data {

/// Features of a column of numbers that reveal thousands separators.
struct ColumnShape {
  bool all_threes = true;  // each point or comma has three digits behind it
  bool any_parted = false;
  double most_parted = 0.0;  // the largest of those, read as decimals
  double least_parted = std::numeric_limits<double>::infinity();
  double most_whole = 0.0;  // the largest number without
  char groups_mark = 0;     // the '.' or ',' of "1.000.000"
  bool by_thousands = false;
};

/// "1.050", "-215.900": one to three digits, the first not 0, a point or comma
/// (at `point`), three digits.
bool MayPartThousands(std::string_view number, std::size_t point);

/// Finds the columns of numbers in which points or commas separate thousands,
/// with a remark. Returns true if there is one; the rows must then be read
/// again.
bool PartThousands(std::vector<ColumnShape>* shapes, CsvTable* table);

}  // namespace errmap::data
