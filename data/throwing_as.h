#pragma once

#include <stdexcept>
#include <string>

namespace errmap::data {

/// Returns action(). Rethrows an exception From as To, with `before` in front
/// of its text, since only the caller knows the file or argument.
///
///   ThrowingAs<InputError>("map.json: ", [&] { return Parse(text); })
template <typename To, typename From = std::invalid_argument, typename Action>
auto ThrowingAs(const std::string& before, const Action& action) {
  try {
    return action();
  } catch (const From& error) {
    throw To(before + error.what());
  }
}

}  // namespace errmap::data
