#pragma once

#include <optional>
#include <string_view>

namespace errmap::data {

/// Whether a word says that the position increases ("up", "+", "1",
/// "positive") or decreases; nothing where it is another. "forward" is no such
/// word: on some slides the position decreases then.
std::optional<bool> IsUpwards(std::string_view word);

/// Whether the first of two words for ways says that the position increases and
/// the other that it decreases, or the reverse; nothing where they are others,
/// "forward" and "back" among them.
std::optional<bool> FirstIsUp(std::string_view first, std::string_view second);

}  // namespace errmap::data
