#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "models/members.h"

namespace errmap::models {

// Member types of a record, besides numbers, texts, truths, enumerators with
// ToString, records, and vectors and optionals (null) of them.

/// A key that is left out if it has no value.
template <typename T>
struct LeftOut : std::optional<T> {
  using std::optional<T>::optional;
};

/// An object whose keys are data, in order.
template <typename T>
using ByName = std::vector<std::pair<std::string, T>>;

/// A record whose keys are stored among those of the enclosing record; the keys
/// of an empty optional one are left out.
template <typename T>
struct Inline {
  T value = {};
};

/// Keys of the object around it that are none of its record's, in order: what
/// slices add, as JSON in one line. They are kept and written as they are.
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
template <typename T>
inline constexpr bool kIsRecord<Inline<T>> = false;

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
  } else if constexpr (IsInline<T>::value) {
    return Same(a.value, b.value);
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
