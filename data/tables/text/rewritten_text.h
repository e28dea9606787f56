#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace errmap::data {

/// Text whose cells are parted in a way that no delimiter tells, in another
/// way: cells in single quotes get double ones; columns that are set apart by
/// two blanks or more, so that names may have one, get tabs; lines that are
/// quoted each as a whole lose those quotes. Nothing where the text is of no
/// such kind.
std::optional<std::string> RewrittenText(std::string_view text);

}  // namespace errmap::data
