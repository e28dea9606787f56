#pragma once

#include <cstddef>
#include <string_view>

namespace errmap::data {

/// Greatest depth of brackets in a JSON file; ours have about ten. Documents
/// are copied, written and freed recursively, so a hostile file could overflow
/// the stack.
inline constexpr std::size_t kMostNesting = 64;

bool IsShallowJson(std::string_view text);

/// Throws InputError ("is nested deeper than ...") if a JSON text is nested too
/// deeply.
void RequireShallowJson(std::string_view text);

}  // namespace errmap::data
