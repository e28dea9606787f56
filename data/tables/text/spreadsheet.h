#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace errmap::data {

/// Returns the cells of a sheet of an xlsx file (Office Open XML, ECMA-376) as
/// text for the CSV parser. Tabs separate cells, and row 7 is on line 7.
/// Numbers are as stored. Dates, which are stored as days, become 2024-03-01
/// 12:00:05 if their format shows a date. Formulas give their stored value.
/// Empty `sheet`: the only visible one with cells. Returns nothing if `bytes`
/// is not an xlsx file. Throws InputError, without the file's name, if the file
/// is damaged, has no such sheet or several, or a formula has no value.
std::optional<std::string> SheetText(std::string_view bytes,
                                     const std::string& sheet);

}  // namespace errmap::data
