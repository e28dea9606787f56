#pragma once

#include <stdexcept>
#include <string>

namespace errmap::data {

/// Returns action(). What it throws as From is thrown as To, with `before` in
/// front of its text: the caller knows which file or argument is meant.
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
