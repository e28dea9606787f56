#pragma once

#include <string>
#include <string_view>

#include "data/csv.h"

namespace errmap::data {

/// A table of plain text, as ParseCsv reads it, before its shape is looked at.
/// `delimiter`: what parts the cells, or CsvCells::kNoDelimiter where the rows
/// have to tell. `name` stands for the file in messages.
CsvTable ParseText(std::string_view text,
                   const std::string& name,
                   char delimiter,
                   OddRows odd);

}  // namespace errmap::data
