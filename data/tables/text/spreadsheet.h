#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace errmap::data {

/// The cells of a sheet of an xlsx file (Office Open XML, ECMA-376), as a text
/// of a line per row and tabs between cells, for the parser of CSV: row 7 is
/// line 7. Numbers as they are stored; dates, which are stored as days, as
/// 2024-03-01 12:00:05 by the format that shows them; formulas by the value
/// kept beside them. Empty `sheet`: the only one that is not hidden and has
/// cells. Nothing where `bytes` is no xlsx file.
///
/// Throws InputError, without the file's name, where the file is damaged, has
/// no such sheet or several, or a formula has no value.
std::optional<std::string> SheetText(std::string_view bytes,
                                     const std::string& sheet);

}  // namespace errmap::data
