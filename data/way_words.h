#pragma once

#include <optional>
#include <string_view>

namespace errmap::data {

/// Returns whether a word says that the position increases ("up", "+", "1",
/// "positive") or decreases; nothing for other words. "forward" is not such a
/// word: on some slides the position then decreases.
std::optional<bool> IsUpwards(std::string_view word);

/// Returns true if the first of two direction words says that the position
/// increases and the other that it decreases; false if the reverse. Nothing for
/// other words, including "forward" and "back".
std::optional<bool> FirstIsUp(std::string_view first, std::string_view second);

}  // namespace errmap::data
