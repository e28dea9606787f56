#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

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

/// Lists the members of a struct, which are the keys of its JSON: once, for
/// writing, reading, comparing and the schema's test. Compiles only if each is
/// a member and none is missing. At namespace scope.
#define ERRMAP_RECORD(Struct, ...)                               \
  template <typename Self>                                       \
  requires std::same_as<std::remove_const_t<Self>, Struct>       \
  auto MembersOf(Self& self) {                                   \
    [[maybe_unused]] auto& [__VA_ARGS__] = self;                 \
    return std::tie(ERRMAP_EXPAND(ERRMAP_OF_SELF(__VA_ARGS__))); \
  }                                                              \
  constexpr std::string_view KeysOf(const Struct* /*type*/) {    \
    return #__VA_ARGS__;                                         \
  }

// self.a, self.b, ...: each step expands the next name, 256 at most.
#define ERRMAP_OF_SELF(member, ...) \
  self.member __VA_OPT__(, ERRMAP_AGAIN ERRMAP_PARENTHESES(__VA_ARGS__))
#define ERRMAP_AGAIN() ERRMAP_OF_SELF
#define ERRMAP_PARENTHESES ()
#define ERRMAP_EXPAND(...) \
  ERRMAP_EXPAND_64(ERRMAP_EXPAND_64(ERRMAP_EXPAND_64(__VA_ARGS__)))
#define ERRMAP_EXPAND_64(...) \
  ERRMAP_EXPAND_16(ERRMAP_EXPAND_16(ERRMAP_EXPAND_16(__VA_ARGS__)))
#define ERRMAP_EXPAND_16(...) \
  ERRMAP_EXPAND_4(ERRMAP_EXPAND_4(ERRMAP_EXPAND_4(__VA_ARGS__)))
#define ERRMAP_EXPAND_4(...) \
  ERRMAP_EXPAND_1(ERRMAP_EXPAND_1(ERRMAP_EXPAND_1(__VA_ARGS__)))
#define ERRMAP_EXPAND_1(...) __VA_ARGS__

template <typename T>
concept Record = requires(const T& record) {
  MembersOf(record);
  KeysOf(&record);
};

/// Calls visit(key, member) for every member in order.
template <typename T, typename Visit>
requires Record<std::remove_const_t<T>>
void VisitMembers(T& record, const Visit& visit) {
  std::string_view keys = KeysOf(&record);
  const auto next = [&keys] {
    const std::size_t comma = keys.find(',');
    const std::string_view key = keys.substr(0, comma);
    keys.remove_prefix(comma == keys.npos ? keys.size() : comma + 2);
    return key;
  };
  std::apply([&](auto&... member) { (visit(next(), member), ...); },
             MembersOf(record));
}

/// Whether all that two records hold is the same; NaN is the same as NaN.
template <typename T>
bool Same(const T& a, const T& b) {
  if constexpr (Record<T>) {
    const auto of_a = MembersOf(a);
    const auto of_b = MembersOf(b);
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return (Same(std::get<I>(of_a), std::get<I>(of_b)) && ...);
    }
    (std::make_index_sequence<std::tuple_size_v<decltype(MembersOf(a))>>{});
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
