#pragma once

#include <string>
#include <string_view>

namespace errmap::data {

/// First line of a CSV file in which texts that a spreadsheet would run as a
/// formula stand after an apostrophe. Our reader takes that off again where it
/// finds this line; of a file without it an apostrophe is the user's own.
inline constexpr std::string_view kFormulaMark =
    "# errmap: an apostrophe before = + - @ is not part of a text";

/// Whether a cell needs an apostrophe: '=1+1', '@SUM(A1)', '-down', also after
/// apostrophes of its own. Numbers and a sign alone do not.
bool NeedsApostrophe(std::string_view text);

/// A text as CsvField had it before it put an apostrophe there, if it did.
std::string_view WithoutApostrophe(std::string_view text);

/// A CSV text with cells by CsvField, under kFormulaMark where one of them has
/// such an apostrophe: all other files stay as plain as they are.
std::string MarkedCsv(std::string text);

}  // namespace errmap::data
