#pragma once

#include <optional>
#include <string_view>

namespace errmap::data {

/// Seconds from 1970-01-01T00:00:00 of a date and time as ISO 8601 has it:
/// "2024-03-01T12:00:05.25", the same with a blank for the T, without seconds,
/// without time (midnight), with "Z" or an offset ("+01:00") at the end; or of
/// a time alone ("12:00:05") from midnight. Nothing where the text is none, or
/// names a day or time that there is not.
std::optional<double> ParseDateTime(std::string_view text);

}  // namespace errmap::data
