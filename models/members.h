#pragma once

#include <concepts>
#include <string_view>
#include <tuple>
#include <type_traits>

namespace errmap::models {

/// Lists the members of a struct, which are the keys of its JSON, in the order
/// in which they are written: once, for writing, reading, comparing and the
/// schema's test. Compiles only if each is a member and none is missing. In the
/// struct's namespace.
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

}  // namespace errmap::models
