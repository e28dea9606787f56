#pragma once

#include <optional>
#include <string_view>

namespace errmap::data {

/// Returns whether a word means that the position increases ("up", "+", "1",
/// "positive") or decreases; nothing for other words. "forward" is not such a
/// word, since on some slides it means decreasing positions.
std::optional<bool> IsUpwards(std::string_view word);

/// Returns true if the first of two direction words says that the position
/// increases and the other that it decreases; false if the reverse. Nothing for
/// other words, including "forward" and "back".
std::optional<bool> FirstIsUp(std::string_view first, std::string_view second);

}  // namespace errmap::data
