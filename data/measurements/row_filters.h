#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "data/measurements/dataset.h"

namespace errmap::data {

/// Whether a word says that the position increases ("up", "+", "1",
/// "positive") or decreases; nothing where it is another. "forward" is no such
/// word: on some slides the position decreases then.
std::optional<bool> IsUpwards(std::string_view word);

/// Whether the first of two words for ways says that the position increases and
/// the other that it decreases, or the reverse; nothing where they are others,
/// "forward" and "back" among them.
std::optional<bool> FirstIsUp(std::string_view first, std::string_view second);

/// The filter that keeps rows of one direction of motion, by its column
/// ("direction", "approach") or its word; null where there is none.
const ColumnFilter* DirectionFilter(std::span<const ColumnFilter> filters);

/// "direction down and tool 3"; "" for none.
std::string FiltersText(std::span<const ColumnFilter> filters);

}  // namespace errmap::data
