#pragma once

#include <string>
#include <string_view>

namespace errmap::data {

/// First line of a CSV file in which an apostrophe precedes every text that a
/// spreadsheet would run as a formula. Our reader removes these apostrophes if
/// it finds this line. In a file without it, apostrophes are the user's.
inline constexpr std::string_view kFormulaMark =
    "# errmap: an apostrophe before = + - @ is not part of a text";

/// True if a cell needs an apostrophe: '=1+1', '@SUM(A1)', '-down', also after
/// its own apostrophes. Numbers and a lone sign do not.
bool NeedsApostrophe(std::string_view text);

/// Returns a text without the apostrophe that CsvField may have added.
std::string_view WithoutApostrophe(std::string_view text);

/// Returns a CSV text with cells by CsvField. kFormulaMark is its first line if
/// a cell got an apostrophe; all other files have no such line.
std::string MarkedCsv(std::string text);

}  // namespace errmap::data
