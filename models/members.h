#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

// The members of plain structs with their names, in declaration order. Code
// that writes, reads or compares them needs no list of its own. C++ offers no
// reflection before C++26. So the compiler is asked how many values build the
// struct, and how it prints each member's place.

namespace errmap::models {

/// True if T can be split into its members: a class without constructors, bases
/// or private members, in a named namespace. Specialise it to exclude a type.
template <typename T>
inline constexpr bool kIsRecord =
    std::is_class_v<T>&& std::is_aggregate_v<T> && !requires {
  std::tuple_size<T>::value;
};

template <typename T>
concept Record = kIsRecord<T>;

namespace members {

/// Represents a value of any type in unevaluated code.
struct Anything {
  template <typename T>
  operator T() const;  // NOLINT(google-explicit-constructor): that is its use
};

template <typename T, std::size_t... I>
constexpr bool IsBuiltFrom(std::index_sequence<I...> /*values*/) {
  return requires { T{(static_cast<void>(I), Anything())...}; };
}

template <typename T, std::size_t kAtLeast = 0>
constexpr std::size_t Count() {
  if constexpr (IsBuiltFrom<T>(std::make_index_sequence<kAtLeast + 1>())) {
    return Count<T, kAtLeast + 1>();
  } else {
    return kAtLeast;
  }
}

template <typename T>
inline constexpr std::size_t kCount = Count<T>();

/// Like std::tuple of references, but the compiler finds an element without
/// instantiating all earlier ones. This halves the compile time of code that
/// visits members.
template <std::size_t kPlace, typename T>
struct Reference {
  T& value;
};
template <typename Places, typename... T>
struct References;
template <std::size_t... I, typename... T>
struct References<std::index_sequence<I...>, T...> : Reference<I, T>... {};
template <typename... T>
constexpr auto Tie(T&... members) {
  return References<std::index_sequence_for<T...>, T...>{{members}...};
}
template <std::size_t kPlace, typename T>
constexpr T& Get(const Reference<kPlace, T>& reference) {
  return reference.value;
}
/// Calls take(members...).
template <typename Take, std::size_t... I, typename... T>
constexpr void Apply(const Take& take,
                     const References<std::index_sequence<I...>, T...>& all) {
  take(Get<I>(all)...);
}

}  // namespace members

/// Returns references to all members.
template <typename T>
requires Record<std::remove_const_t<T>>
constexpr auto MembersOf(T& record) {
  constexpr std::size_t kCount = members::kCount<std::remove_const_t<T>>;
  if constexpr (kCount == 0) {
    return members::Tie();
  }
#define ERRMAP_TIE(count, ...)            \
  else if constexpr (kCount == (count)) { \
    auto& [__VA_ARGS__] = record;         \
    return members::Tie(__VA_ARGS__);     \
  }
  // clang-format off
  ERRMAP_TIE(1, a)
  ERRMAP_TIE(2, a, b)
  ERRMAP_TIE(3, a, b, c)
  ERRMAP_TIE(4, a, b, c, d)
  ERRMAP_TIE(5, a, b, c, d, e)
  ERRMAP_TIE(6, a, b, c, d, e, f)
  ERRMAP_TIE(7, a, b, c, d, e, f, g)
  ERRMAP_TIE(8, a, b, c, d, e, f, g, h)
  ERRMAP_TIE(9, a, b, c, d, e, f, g, h, i)
  ERRMAP_TIE(10, a, b, c, d, e, f, g, h, i, j)
  ERRMAP_TIE(11, a, b, c, d, e, f, g, h, i, j, k)
  ERRMAP_TIE(12, a, b, c, d, e, f, g, h, i, j, k, l)
  ERRMAP_TIE(13, a, b, c, d, e, f, g, h, i, j, k, l, m)
  ERRMAP_TIE(14, a, b, c, d, e, f, g, h, i, j, k, l, m, n)
  ERRMAP_TIE(15, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o)
  ERRMAP_TIE(16, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p)
  ERRMAP_TIE(17, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q)
  ERRMAP_TIE(18, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r)
  ERRMAP_TIE(19, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s)
  ERRMAP_TIE(20, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t)
  ERRMAP_TIE(21, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u)
  ERRMAP_TIE(22, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v)
  ERRMAP_TIE(23, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w)
  ERRMAP_TIE(24, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x)
  ERRMAP_TIE(25, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y)
  ERRMAP_TIE(26, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z)
  ERRMAP_TIE(27, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, aa)
  ERRMAP_TIE(28, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, aa, ab)
  ERRMAP_TIE(29, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, aa, ab, ac)
  ERRMAP_TIE(30, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, aa, ab, ac, ad)
  ERRMAP_TIE(31, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, aa, ab, ac, ad, ae)
  ERRMAP_TIE(32, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, aa, ab, ac, ad, ae, af)
  // clang-format on
#undef ERRMAP_TIE
  else {
    static_assert(kCount == 0, "more members than anybody has thought of");
  }
}

namespace members {

#ifdef __clang__
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Wundefined-var-template"
#endif
/// A declared object, used only for the names of its members.
template <typename T>
extern const T kSome;

template <typename T>
struct Place {
  const T* member;
};
template <typename T>
Place(const T*) -> Place<T>;

/// The compiler prints the place as "... &kSome<Struct>.Struct::name)}; ...".
template <auto kPlace>
constexpr std::string_view NameOf() {
  std::string_view name = __PRETTY_FUNCTION__;
  name = name.substr(0, name.rfind('}'));
  if (name.ends_with(')')) name.remove_suffix(1);
  return name.substr(name.find_last_of(".:") + 1);
}

template <typename T, std::size_t... I>
constexpr auto NamesOf(std::index_sequence<I...> /*members*/) {
  return std::array<std::string_view, sizeof...(I)>{
      NameOf<Place{&Get<I>(MembersOf(kSome<T>))}>()...};
}
template <typename T>
inline constexpr auto kNames =
    NamesOf<T>(std::make_index_sequence<kCount<T>>());
#ifdef __clang__
#pragma clang diagnostic pop
#endif

}  // namespace members

/// Calls visit(name, member) for every member in order.
template <typename T, typename Visit>
requires Record<std::remove_const_t<T>>
void VisitMembers(T& record, const Visit& visit) {
  using Struct = std::remove_const_t<T>;
  [&]<std::size_t... I>(std::index_sequence<I...> /*members*/) {
    const auto all = MembersOf(record);
    (visit(members::kNames<Struct>[I], members::Get<I>(all)), ...);
  }
  (std::make_index_sequence<members::kCount<Struct>>());
}

}  // namespace errmap::models
