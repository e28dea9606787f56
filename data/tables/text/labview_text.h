#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace errmap::data {

/// A LabVIEW measurement file (.lvm) as a plain table: the lines of its headers
/// are empty, its X_Value is called time_s, and the units of the last header
/// stand below the names. Each row keeps its line. Nothing of other files, or
/// where X is no time.
std::optional<std::string> LabviewText(std::string_view text);

}  // namespace errmap::data
