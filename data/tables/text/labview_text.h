#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace errmap::data {

/// Returns a LabVIEW measurement file (.lvm) as a plain table. The lines of its
/// headers are empty, X_Value becomes time_s, and the units of the last header
/// are below the names. Each row keeps its line. Returns nothing for other
/// files, or if X is not time.
std::optional<std::string> LabviewText(std::string_view text);

}  // namespace errmap::data
