#pragma once

#include <string>
#include <string_view>

#include "data/csv.h"

namespace errmap::data {

/// Reads a table of plain text, as ParseCsv does before its shape is examined.
/// `delimiter` separates the cells; CsvCells::kNoDelimiter: found from the
/// rows. `name` stands for the file in messages.
CsvTable ParseText(std::string_view text,
                   const std::string& name,
                   char delimiter,
                   OddRows odd);

}  // namespace errmap::data
