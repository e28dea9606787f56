#pragma once

#include <cstddef>
#include <string_view>

namespace errmap::data {

/// Brackets within brackets that a JSON file may have: ours have some ten. A
/// document is copied, written and freed by functions that call themselves
/// once for each, and the stack ends before a hostile file does.
inline constexpr std::size_t kMostNesting = 64;

bool IsShallowJson(std::string_view text);

/// Throws InputError ("is nested deeper than ...") where a JSON text is
/// not.
void RequireShallowJson(std::string_view text);

}  // namespace errmap::data
