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

// What a record's members may be besides numbers, texts, truths, enumerators
// with ToString, records, and vectors and optionals (null) of them.

/// A key that is left out where there is nothing.
template <typename T>
struct LeftOut : std::optional<T> {
  using std::optional<T>::optional;
};

/// An object whose keys are data, in order.
template <typename T>
using ByName = std::vector<std::pair<std::string, T>>;

/// A record whose keys stand among those of the record around it; those of an
/// optional one are left out where there is nothing.
template <typename T>
struct Inline {
  T value = {};
};

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

/// Whether all that two records hold is the same; NaN is the same as NaN.
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
