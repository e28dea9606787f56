#pragma once

// How records become JSON and back. Not for public headers: it needs
// nlohmann's library.

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include <nlohmann/json.hpp>

#include "data/text.h"
#include "models/study/record/record.h"

namespace errmap::models {

using RecordJson = nlohmann::ordered_json;

template <typename T>
RecordJson ToJson(const T& value);

namespace record_json {

template <typename T>
void ReadInline(const RecordJson& json, T* value);

template <typename T>
concept Named = std::is_enum_v<T> && requires(T value) {
  ToString(value);
};

template <typename T>
void Add(const T& record, RecordJson* json) {
  VisitMembers(record, [&](std::string_view key, const auto& member) {
    using Member = std::decay_t<decltype(member)>;
    if constexpr (IsInline<Member>::value) {
      if constexpr (requires { member.value.has_value(); }) {
        if (member.value) Add(*member.value, json);
      } else {
        Add(member.value, json);
      }
    } else if constexpr (IsLeftOut<Member>::value) {
      if (member) (*json)[std::string(key)] = ToJson(*member);
    } else {
      (*json)[std::string(key)] = ToJson(member);
    }
  });
}

template <typename T>
bool HasAnyKey(const RecordJson& json) {
  bool any = false;
  const T record{};
  VisitMembers(record, [&](std::string_view key, const auto& /*member*/) {
    any = any || json.contains(key);
  });
  return any;
}

}  // namespace record_json

/// What is not finite becomes null.
template <typename T>
RecordJson ToJson(const T& value) {
  if constexpr (Record<T>) {
    RecordJson json = RecordJson::object();
    record_json::Add(value, &json);
    return json;
  } else if constexpr (record_json::Named<T>) {
    return std::string(ToString(value));
  } else if constexpr (std::floating_point<T>) {
    return std::isfinite(value) ? RecordJson(value) : RecordJson();
  } else if constexpr (requires { value.has_value(); }) {
    return value ? ToJson(*value) : RecordJson();
  } else if constexpr (requires { std::tuple_size<T>::value; }) {
    RecordJson json = RecordJson::array();
    std::apply(
        [&](const auto&... held) { (json.push_back(ToJson(held)), ...); },
        value);
    return json;
  } else if constexpr (requires { std::get<std::int64_t>(value); }) {
    return std::visit([](const auto& held) { return ToJson(held); }, value);
  } else if constexpr (requires { value.front().second; }) {
    RecordJson json = RecordJson::object();
    for (const auto& [name, held] : value) json[name] = ToJson(held);
    return json;
  } else if constexpr (!std::same_as<T, std::string> &&
                       requires { value.begin(); }) {
    RecordJson json = RecordJson::array();
    for (const auto& held : value) json.push_back(ToJson(held));
    return json;
  } else {
    return value;
  }
}

/// Reads what stands there and says whether it was of the right type; what is
/// missing, null or of another type stays as a new record has it: NaN, "",
/// nothing.
template <typename T>
bool FromJson(const RecordJson& json, T* value) {
  if constexpr (Record<T>) {
    VisitMembers(*value, [&](std::string_view key, auto& member) {
      using Member = std::decay_t<decltype(member)>;
      if constexpr (IsInline<Member>::value) {
        record_json::ReadInline(json, &member.value);
      } else if (json.is_object()) {
        const auto found = json.find(key);
        if (found != json.end()) FromJson(*found, &member);
      }
    });
    return json.is_object();
  } else if constexpr (record_json::Named<T>) {
    if (!json.is_string()) return false;
    constexpr int kMostEnumerators = 32;
    for (int i = 0; i < kMostEnumerators; ++i) {
      const T candidate = static_cast<T>(i);
      const std::string_view word = ToString(candidate);
      if (word.empty() || json.get_ref<const std::string&>() != word) continue;
      *value = candidate;
      return true;
    }
    return false;
  } else if constexpr (std::floating_point<T>) {
    *value =
        json.is_number() ? json.get<T>() : std::numeric_limits<T>::quiet_NaN();
    if (!std::isfinite(*value)) *value = std::numeric_limits<T>::quiet_NaN();
    return json.is_number();
  } else if constexpr (std::same_as<T, bool>) {
    if (json.is_boolean()) *value = json.get<bool>();
    return json.is_boolean();
  } else if constexpr (std::integral<T>) {
    if (json.is_number_integer()) *value = json.get<T>();
    return json.is_number_integer();
  } else if constexpr (std::same_as<T, std::string>) {
    if (!json.is_string()) return false;
    *value = data::AsUtf8(json.get_ref<const std::string&>());
    return true;
  } else if constexpr (requires { value->has_value(); }) {
    typename T::value_type held{};
    if (FromJson(json, &held)) value->emplace(std::move(held));
    return true;
  } else if constexpr (requires { std::tuple_size<T>::value; }) {
    if (!json.is_array()) return false;
    std::size_t i = 0;
    const auto read = [&](auto& held) {
      if (i < json.size()) FromJson(json[i], &held);
      ++i;
    };
    std::apply([&](auto&... held) { (read(held), ...); }, *value);
    return true;
  } else if constexpr (requires { std::get<std::int64_t>(*value); }) {
    if (json.is_string()) {
      return FromJson(json, &value->template emplace<std::string>());
    }
    return json.is_number_integer()
               ? FromJson(json, &value->template emplace<std::int64_t>())
               : FromJson(json, &value->template emplace<double>());
  } else if constexpr (requires { value->front().second; }) {
    if (!json.is_object()) return false;
    for (const auto& [name, held] : json.items()) {
      value->emplace_back(data::AsUtf8(name),
                          typename T::value_type::second_type{});
      FromJson(held, &value->back().second);
    }
    return true;
  } else {
    if (!json.is_array()) return false;
    value->resize(json.size());
    for (std::size_t i = 0; i < json.size(); ++i) {
      FromJson(json[i], &(*value)[i]);
    }
    return true;
  }
}

namespace record_json {

template <typename T>
void ReadInline(const RecordJson& json, T* value) {
  if constexpr (requires { value->has_value(); }) {
    if (HasAnyKey<typename T::value_type>(json)) {
      FromJson(json, &value->emplace());
    }
  } else {
    FromJson(json, value);
  }
}

}  // namespace record_json

}  // namespace errmap::models
