#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace errmap::models {

/// Replaces all characters but letters, digits and single underscores. The
/// result starts with a letter and does not end with `_`. The result is an
/// identifier in C, Python and IEC 61131-3 (which allows neither `__` nor a
/// trailing `_`). It is never empty and has at most `longest` characters (at
/// least 8).
std::string SafeIdentifier(std::string_view text, std::size_t longest);

/// SafeIdentifier of each text, with a number at the end if two would be equal
/// regardless of case.
std::vector<std::string> SafeIdentifiers(const std::vector<std::string>& texts,
                                         std::size_t longest);

/// Returns the text in a form that neither begins nor ends a comment in C,
/// Python or IEC 61131-3. It is printable ASCII without * \ ? and double
/// quotes, cut at 80 characters.
std::string CommentText(std::string_view text);

/// Returns the number with a decimal point, in the fewest digits that read back
/// to the same double (or float): "5.0", "1.0e-05". It is a real literal in all
/// three languages.
std::string RealText(double value, bool single = false);

}  // namespace errmap::models
