#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace errmap::models {

/// Letters, digits and single underscores in place of whatever else there is,
/// beginning with a letter and ending with none of `_`: an identifier in C,
/// Python and IEC 61131-3 (which knows neither `__` nor a trailing `_`).
/// Never empty, at most `longest` characters (at least 8).
std::string SafeIdentifier(std::string_view text, std::size_t longest);

/// SafeIdentifier of each, told apart by a number at the end where two would
/// be the same without regard to case.
std::vector<std::string> SafeIdentifiers(const std::vector<std::string>& texts,
                                         std::size_t longest);

/// Text that ends no comment and begins none in C, Python or IEC 61131-3:
/// printable ASCII without * \ ? and double quotes, cut at 80 characters.
std::string CommentText(std::string_view text);

/// The number with a decimal point, in as few digits as read back to the same
/// double (or float): "5.0", "1.0e-05". Real literals of all three languages.
std::string RealText(double value, bool single = false);

}  // namespace errmap::models
