#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace errmap::data {

/// Rewrites text whose cells no single delimiter separates. Cells in single
/// quotes get double ones. Columns aligned by two blanks or more, so that names
/// may contain one, get tabs. Lines that are each quoted as a whole lose those
/// quotes. Returns nothing for any other text.
std::optional<std::string> RewrittenText(std::string_view text);

}  // namespace errmap::data
