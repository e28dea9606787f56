#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "models/study/record/record.h"

// Shared by the records of results.json: the value for unknown, values of
// options, intervals, and search by name.

namespace errmap::models {

inline constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

/// Returns the entry of `list` with this `name`, or null.
template <typename T>
requires requires(const T& entry) { entry.name; }
const T* FindNamed(const std::vector<T>& list, std::string_view name) {
  const auto found = std::ranges::find(list, name, &T::name);
  return found == list.end() ? nullptr : &*found;
}
template <typename T>
const T* FindNamed(const ByName<T>& list, std::string_view name) {
  const auto found =
      std::ranges::find(list, name, &std::pair<std::string, T>::first);
  return found == list.end() ? nullptr : &found->second;
}

/// Value of an option.
using OptionValue = std::variant<std::int64_t, double, std::string>;

/// A 95 % interval; NaN if there is none.
using IntervalRecord = std::array<double, 2>;

}  // namespace errmap::models
