#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "models/members.h"

namespace errmap::models {

/// The value that means unknown.
inline constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

// Member types of a record, besides numbers, texts, truths, enumerators with
// ToString, records, and vectors and optionals (null) of them.

/// A key that is left out if it has no value.
template <typename T>
struct LeftOut : std::optional<T> {
  using std::optional<T>::optional;
};

/// An object whose keys are data, in a fixed order.
template <typename T>
using ByName = std::vector<std::pair<std::string, T>>;

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

/// A record whose keys are stored beside those of the enclosing record. An
/// empty optional one has no keys.
template <typename T>
struct Inline {
  T value = {};
};

/// Further keys of the enclosing object, in order, such as those of slices.
/// Each is JSON in one line, written unchanged.
struct OtherKeys : ByName<std::string> {};
template <>
inline constexpr bool kIsRecord<OtherKeys> = false;

template <typename T>
struct IsLeftOut : std::false_type {};
template <typename T>
struct IsLeftOut<LeftOut<T>> : std::true_type {};
template <typename T>
struct IsInline : std::false_type {};
template <typename T>
struct IsInline<Inline<T>> : std::true_type {};

/// True if two records hold the same values; NaN equals NaN.
template <typename T>
bool Same(const T& a, const T& b) {
  if constexpr (Record<T>) {
    const auto of_a = MembersOf(a);
    const auto of_b = MembersOf(b);
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return (Same(members::Get<I>(of_a), members::Get<I>(of_b)) && ...);
    }
    (std::make_index_sequence<members::kCount<T>>{});
  } else if constexpr (std::floating_point<T>) {
    return a == b || (std::isnan(a) && std::isnan(b));
  } else if constexpr (requires { a.has_value(); }) {
    return a.has_value() == b.has_value() && (!a || Same(*a, *b));
  } else if constexpr (requires { std::tuple_size<T>::value; }) {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return (Same(std::get<I>(a), std::get<I>(b)) && ...);
    }
    (std::make_index_sequence<std::tuple_size_v<T>>{});
  } else if constexpr (requires { a.valueless_by_exception(); }) {
    return a.index() == b.index() &&
           std::visit(
               [&](const auto& value) {
                 return Same(value, std::get<std::decay_t<decltype(value)>>(b));
               },
               a);
  } else if constexpr (!std::same_as<T, std::string> &&
                       requires { a.begin(); }) {
    return std::equal(a.begin(),
                      a.end(),
                      b.begin(),
                      b.end(),
                      [](const auto& x, const auto& y) { return Same(x, y); });
  } else {
    return a == b;
  }
}

}  // namespace errmap::models
