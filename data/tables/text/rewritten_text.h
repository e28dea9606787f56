#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace errmap::data {

/// Rewrites text whose cells no single delimiter separates. Cells in single
/// quotes get double ones, and quotes behind backslashes lose these. Columns
/// aligned by two blanks or more, so that names may contain one, get tabs.
/// Lines that are each quoted as a whole lose those quotes. Returns nothing for
/// any other text.
std::optional<std::string> RewrittenText(std::string_view text);

/// Returns a LabVIEW measurement file (.lvm) as a plain table. The lines of its
/// headers are empty, X_Value becomes time_s, and the units of the last header
/// are below the names. Each row keeps its line. Returns nothing for other
/// files, or if X is not time.
std::optional<std::string> LabviewText(std::string_view text);

}  // namespace errmap::data
