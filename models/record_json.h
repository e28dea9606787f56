#pragma once

// Converts records to JSON and back. Not for public headers: only code that
// touches a RecordJson itself needs nlohmann's library.

#include <cmath>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <utility>

#include <nlohmann/json_fwd.hpp>

#include "models/record.h"

namespace errmap::data {
struct ColumnInfo;
}

namespace errmap::models {

using RecordJson = nlohmann::ordered_json;

// Functions that read and write one JSON value each, for all records; compiled
// once.
namespace record_json {

void SetNull(RecordJson* json);
void Set(double value, RecordJson* json);
void Set(bool value, RecordJson* json);
void Set(std::int64_t value, RecordJson* json);
void Set(std::uint64_t value, RecordJson* json);
void Set(std::string_view value, RecordJson* json);
void SetObject(RecordJson* json);
void SetArray(RecordJson* json);
/// Sets the value from a JSON text.
void SetText(std::string_view text, RecordJson* json);
/// Returns the member of that name; creates it if there is none.
RecordJson* Member(std::string_view key, RecordJson* object);
RecordJson* Append(RecordJson* array);

bool IsObject(const RecordJson& json);
bool IsArray(const RecordJson& json);
bool IsText(const RecordJson& json);
bool IsInteger(const RecordJson& json);
bool IsNull(const RecordJson& json);
std::size_t Size(const RecordJson& json);
const RecordJson& At(const RecordJson& array, std::size_t i);
/// Returns null if it is not an object or has no such member.
const RecordJson* Find(const RecordJson& json, std::string_view key);
void ForMembers(const RecordJson& object,
                const std::function<void(std::string name,
                                         const RecordJson& value)>& visit);
/// Returns the text in one line; bytes that are not UTF-8 are replaced.
std::string OneLine(const RecordJson& json);
/// Passes the text to the callback in pieces, without members that are not
/// `kept`.
void ForText(const RecordJson& json,
             const std::function<bool(std::string_view key)>& kept,
             const std::function<void(std::string_view text)>& take);
// Returns true if it has this type; else leaves *value unchanged.
bool Get(const RecordJson& json, double* value);
bool Get(const RecordJson& json, bool* value);
bool Get(const RecordJson& json, std::int64_t* value);
bool Get(const RecordJson& json, std::uint64_t* value);
bool Get(const RecordJson& json, std::string* value);
bool IsWord(const RecordJson& json, std::string_view word);
/// Returns ".key" or "[3]": the path from the enclosing value.
std::string PlaceOf(std::string_view key);
std::string PlaceOf(std::size_t i);

/// Adds name, unit and, if known, role. If a column is a member of a record,
/// its keys are stored beside those of the record.
void AddColumn(const data::ColumnInfo& column, RecordJson* json);
bool ColumnFrom(const RecordJson& json,
                data::ColumnInfo* column,
                std::string* misfit);

template <typename T>
concept Named = std::is_enum_v<T> && requires(T value) {
  ToString(value);
};

/// The integer type of JSON that holds T.
template <std::integral T>
using Wide =
    std::conditional_t<std::is_signed_v<T>, std::int64_t, std::uint64_t>;

/// A JSON tree, for code that does not include its library.
class Tree {
 public:
  Tree();
  ~Tree();
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;
  /// Returns false if it is not JSON.
  bool Parse(std::string_view text);
  /// Returns the text with an indent of this many spaces, or in one line (-1).
  /// Replaces bytes that are not UTF-8.
  std::string Text(int indent) const;
  RecordJson* root() { return root_.get(); }

 private:
  std::unique_ptr<RecordJson> root_;
};

template <typename T>
void Write(const T& value, RecordJson* json);

template <typename T>
void Add(const T& record, RecordJson* json) {
  VisitMembers(record, [&](std::string_view key, const auto& member) {
    using Held = std::decay_t<decltype(member)>;
    if constexpr (std::same_as<Held, OtherKeys>) {
      for (const auto& [name, text] : member) SetText(text, Member(name, json));
    } else if constexpr (IsInline<Held>::value) {
      if constexpr (requires { member.value.has_value(); }) {
        if (member.value) Add(*member.value, json);
      } else {
        Add(member.value, json);
      }
    } else if constexpr (std::same_as<Held, data::ColumnInfo>) {
      AddColumn(member, json);
    } else if constexpr (IsLeftOut<Held>::value) {
      if (member) Write(*member, Member(key, json));
    } else {
      Write(member, Member(key, json));
    }
  });
}

template <typename T>
concept Tabular = requires(T value) {
  value.rowwise();
  requires T::ColsAtCompileTime != 1;
};

/// Writes values that are not finite as null, and matrices by rows.
template <typename T>
void Write(const T& value, RecordJson* json) {
  if constexpr (std::same_as<T, data::ColumnInfo>) {
    SetObject(json);
    AddColumn(value, json);
  } else if constexpr (Tabular<T>) {
    SetArray(json);
    for (const auto& row : value.rowwise()) {
      Write(std::vector<double>(row.begin(), row.end()), Append(json));
    }
  } else if constexpr (Record<T>) {
    SetObject(json);
    Add(value, json);
  } else if constexpr (Named<T>) {
    Set(std::string_view(ToString(value)), json);
  } else if constexpr (std::floating_point<T>) {
    Set(double{value}, json);
  } else if constexpr (std::same_as<T, bool>) {
    Set(value, json);
  } else if constexpr (std::integral<T>) {
    Set(static_cast<Wide<T>>(value), json);
  } else if constexpr (std::convertible_to<T, std::string_view>) {
    Set(std::string_view(value), json);
  } else if constexpr (requires { value.has_value(); }) {
    if (value) {
      Write(*value, json);
    } else {
      SetNull(json);
    }
  } else if constexpr (requires { std::tuple_size<T>::value; }) {
    SetArray(json);
    std::apply([&](const auto&... held) { (Write(held, Append(json)), ...); },
               value);
  } else if constexpr (requires { std::get<std::int64_t>(value); }) {
    std::visit([&](const auto& held) { Write(held, json); }, value);
  } else if constexpr (requires { value.front().second; }) {
    SetObject(json);
    for (const auto& [name, held] : value) Write(held, Member(name, json));
  } else {
    SetArray(json);
    for (const auto& held : value) Write(held, Append(json));
  }
}

template <typename T>
bool HasKey(std::string_view name) {
  bool has = false;
  const T record{};
  VisitMembers(record, [&](std::string_view key, const auto& /*member*/) {
    has = has || key == name;
  });
  return has;
}

template <typename T>
bool HasAnyKey(const RecordJson& json) {
  bool any = false;
  const T record{};
  VisitMembers(record, [&](std::string_view key, const auto& /*member*/) {
    any = any || Find(json, key) != nullptr;
  });
  return any;
}

}  // namespace record_json

/// Values that are not finite become null. Callers include nlohmann's library.
template <typename T, typename Json = RecordJson>
Json ToJson(const T& value) {
  Json json;
  record_json::Write(value, &json);
  return json;
}

/// Returns ToJson as text.
template <typename T>
std::string JsonText(const T& value, int indent) {
  record_json::Tree tree;
  record_json::Write(value, tree.root());
  return tree.Text(indent);
}

/// Reads a value. If a part has the wrong type, returns false and puts the path
/// of the first such part into `misfit` (".folds[2].stop"). Missing keys keep
/// the values of a new record, since older files lack later keys. Null leaves
/// an optional empty, and makes a floating-point number NaN.
template <typename T>
bool FromJson(const RecordJson& json, T* value, std::string* misfit = nullptr);

namespace record_json {

/// Reads a part; `misfit` gets its path before the path within it.
template <typename T>
bool FromPart(const RecordJson& json,
              const auto& place,
              T* value,
              std::string* misfit) {
  std::string inner;
  if (FromJson(json, value, &inner)) return true;
  if (misfit != nullptr && misfit->empty()) *misfit = PlaceOf(place) + inner;
  return false;
}

template <typename T>
bool MembersFrom(const RecordJson& json, T* value, std::string* misfit) {
  bool fits = IsObject(json);
  VisitMembers(*value, [&](std::string_view key, auto& member) {
    using Held = std::decay_t<decltype(member)>;
    if constexpr (std::same_as<Held, OtherKeys>) {
      if (!IsObject(json)) return;
      ForMembers(json, [&](std::string name, const RecordJson& other) {
        if (!HasKey<T>(name)) member.emplace_back(name, OneLine(other));
      });
    } else if constexpr (!IsInline<Held>::value) {
      const RecordJson* found = Find(json, key);
      if (found != nullptr && !FromPart(*found, key, &member, misfit)) {
        fits = false;
      }
    } else if constexpr (requires { member.value.has_value(); }) {
      using Inlined = typename decltype(member.value)::value_type;
      if (HasAnyKey<Inlined>(json) &&
          !MembersFrom(json, &member.value.emplace(), misfit)) {
        fits = false;
      }
    } else if (!MembersFrom(json, &member.value, misfit)) {
      fits = false;
    }
  });
  return fits;
}

template <typename T>
bool WordFrom(const RecordJson& json, T* value) {
  // No enumeration has more; ToString returns "" beyond its last.
  constexpr int kMostEnumerators = 256;
  for (int i = 0; i < kMostEnumerators; ++i) {
    const std::string_view word = ToString(static_cast<T>(i));
    if (word.empty() || !IsWord(json, word)) continue;
    *value = static_cast<T>(i);
    return true;
  }
  return false;
}

template <typename T>
bool TupleFrom(const RecordJson& json, T* value, std::string* misfit) {
  bool fits = IsArray(json) && Size(json) == std::tuple_size_v<T>;
  std::size_t i = 0;
  const auto read = [&](auto& held) {
    if (fits) fits = FromPart(At(json, i), i, &held, misfit);
    ++i;
  };
  std::apply([&](auto&... held) { (read(held), ...); }, *value);
  return fits;
}

template <typename T>
bool MapFrom(const RecordJson& json, T* value, std::string* misfit) {
  if (!IsObject(json)) return false;
  bool fits = true;
  ForMembers(json, [&](std::string name, const RecordJson& held) {
    value->emplace_back(std::move(name), typename T::value_type::second_type{});
    auto& [key, of_key] = value->back();
    if (!FromPart(held, key, &of_key, misfit)) fits = false;
  });
  return fits;
}

template <typename T>
bool ListFrom(const RecordJson& json, T* value, std::string* misfit) {
  if (!IsArray(json)) return false;
  value->resize(static_cast<decltype(value->size())>(Size(json)));
  std::size_t i = 0;
  for (auto& held : *value) {
    if (!FromPart(At(json, i), i, &held, misfit)) return false;
    ++i;
  }
  return true;
}

template <typename T>
bool MatrixFrom(const RecordJson& json, T* value, std::string* misfit) {
  std::vector<std::vector<double>> rows;
  if (!ListFrom(json, &rows, misfit)) return false;
  value->resize(std::ssize(rows), rows.empty() ? 0 : std::ssize(rows.front()));
  auto to = value->rowwise().begin();
  for (const std::vector<double>& row : rows) {
    if (std::ssize(row) != value->cols()) return false;
    std::copy(row.begin(), row.end(), (*to++).begin());
  }
  return true;
}

/// Parses the text as JSON of one of these schemas. Otherwise throws
/// data::InputError with what the text is, followed by `remedy`.
void ParseAs(std::string_view text,
             std::initializer_list<std::string_view> schemas,
             std::string_view remedy,
             Tree* json);
[[noreturn]] void RefuseMisfit(std::string_view misfit,
                               std::string_view schema,
                               std::string_view remedy);

}  // namespace record_json

template <typename T>
bool FromJson(const RecordJson& json, T* value, std::string* misfit) {
  using namespace record_json;
  if constexpr (std::same_as<T, data::ColumnInfo>) {
    return ColumnFrom(json, value, misfit);
  } else if constexpr (Tabular<T>) {
    return MatrixFrom(json, value, misfit);
  } else if constexpr (Record<T>) {
    return MembersFrom(json, value, misfit);
  } else if constexpr (Named<T>) {
    return WordFrom(json, value);
  } else if constexpr (std::floating_point<T>) {
    double read = std::numeric_limits<double>::quiet_NaN();
    const bool fits = Get(json, &read) || IsNull(json);
    *value = std::isfinite(read) ? static_cast<T>(read)
                                 : std::numeric_limits<T>::quiet_NaN();
    return fits;
  } else if constexpr (std::same_as<T, bool> || std::same_as<T, std::string>) {
    return Get(json, value);
  } else if constexpr (std::integral<T>) {
    auto read = static_cast<Wide<T>>(*value);
    const bool is_integer = Get(json, &read);
    *value = static_cast<T>(read);
    return is_integer;
  } else if constexpr (requires { value->has_value(); }) {
    return IsNull(json) || FromJson(json, &value->emplace(), misfit);
  } else if constexpr (requires { std::tuple_size<T>::value; }) {
    return TupleFrom(json, value, misfit);
  } else if constexpr (requires { std::get<std::int64_t>(*value); }) {
    if (IsText(json)) {
      return FromJson(json, &value->template emplace<std::string>(), misfit);
    }
    return IsInteger(json)
               ? FromJson(
                     json, &value->template emplace<std::int64_t>(), misfit)
               : FromJson(json, &value->template emplace<double>(), misfit);
  } else if constexpr (requires { value->front().second; }) {
    return MapFrom(json, value, misfit);
  } else {
    return ListFrom(json, value, misfit);
  }
}

/// Returns the record in parsed JSON. Throws data::InputError if a key's value
/// is not of the schema's type; the message ends with `remedy`.
template <typename T>
T RecordOf(const RecordJson& json,
           std::string_view schema,
           std::string_view remedy) {
  T record;
  std::string misfit;
  if (!FromJson(json, &record, &misfit)) {
    record_json::RefuseMisfit(misfit, schema, remedy);
  }
  return record;
}

/// Returns the record in the text of a file; throws as ParseAs and RecordOf.
template <typename T>
T RecordFromText(std::string_view text,
                 std::string_view schema,
                 std::string_view remedy) {
  record_json::Tree json;
  record_json::ParseAs(text, {schema}, remedy, &json);
  return RecordOf<T>(*json.root(), schema, remedy);
}

}  // namespace errmap::models
