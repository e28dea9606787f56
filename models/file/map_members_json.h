#pragma once

// Reads a map's parts from the JSON of model files, member by member, as
// record_json.h writes them; not for public headers. Callers read the rest of
// the file.

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "models/error_model.h"
#include "models/file/model_json.h"
#include "models/history/history.h"
#include "models/members.h"

namespace errmap::models {

/// Returns the key of a form in model files; forms without one cannot be saved.
constexpr const char* FileKeyOf(const PolynomialForm* /*form*/) {
  return "polynomial";
}
constexpr const char* FileKeyOf(const NetForm* /*form*/) { return "net"; }
constexpr const char* FileKeyOf(const BlendForm* /*form*/) { return "blend"; }

data::ColumnInfo ReadColumn(const ModelJsonNode& node);

/// Calls visit(key, member) for each member stored under its own key.
template <typename T, typename Visit>
void VisitKeys(T& record, const Visit& visit) {
  VisitMembers(record, [&](std::string_view key, auto& member) {
    using Member = std::decay_t<decltype(member)>;
    constexpr bool kIsForm =
        std::is_same_v<Member, decltype(BlendForm::Member::form)>;
    if constexpr (!kIsForm) visit(std::string(key), member);
  });
}

/// Returns the enumerator with this name in ToString.
template <typename T>
T ReadWord(const ModelJsonNode& node) {
  const std::string word = node.Text();
  std::vector<std::string> words;
  for (int i = 0;; ++i) {
    const auto known = static_cast<T>(i);
    const std::string name(ToString(known));
    // Unknown is the first enumerator, and has no name.
    if (name.empty() && i == 0) continue;
    if (name == word) return known;
    // For values past the last, ToString returns "" or the last name again.
    if (name.empty() || std::ranges::count(words, name) > 0) break;
    words.push_back(name);
  }
  node.RefuseWord(words, word);
}

/// Reads every member except those with keys in `except`, which the caller
/// reads. Members in `may_lack`, which older files do not have, keep their
/// values if they are missing or null.
template <typename T>
void ReadMembers(const ModelJsonNode& node,
                 T* value,
                 const std::vector<std::string_view>& except = {},
                 const std::vector<std::string_view>& may_lack = {}) {
  if constexpr (Record<T>) {
    VisitKeys(*value, [&](const std::string& key, auto& member) {
      if (std::ranges::count(except, key) > 0) return;
      if (std::ranges::count(may_lack, key) > 0 && !node.Find(key)) return;
      if constexpr (std::is_same_v<std::decay_t<decltype(member)>,
                                   data::ColumnInfo>) {
        member = ReadColumn(node);
      } else if constexpr (requires { member.has_value(); }) {
        if (const auto found = node.Find(key)) {
          typename std::decay_t<decltype(member)>::value_type read{};
          ReadMembers(*found, &read, {}, may_lack);
          member = std::move(read);
        }
      } else {
        ReadMembers(node.At(key), &member, {}, may_lack);
      }
    });
  } else if constexpr (std::is_floating_point_v<T>) {
    *value = node.Number();
  } else if constexpr (std::is_enum_v<T>) {
    *value = ReadWord<T>(node);
  } else if constexpr (std::is_same_v<T, bool>) {
    *value = node.Truth();
  } else if constexpr (std::is_same_v<T, int>) {
    *value = static_cast<int>(node.Number());
  } else if constexpr (std::is_integral_v<T>) {
    const Index count = node.Count();
    if (std::cmp_greater(count, std::numeric_limits<T>::max())) {
      node.Refuse("is too large");
    }
    *value = static_cast<T>(count);
  } else if constexpr (std::is_same_v<T, VectorXd>) {
    *value = node.Vector();
  } else if constexpr (std::is_same_v<T, MatrixXd>) {
    *value = node.Matrix();
  } else if constexpr (std::is_same_v<T, std::string>) {
    *value = node.Text();
  } else {
    for (const ModelJsonNode& element : node.Elements()) {
      ReadMembers(element, &value->emplace_back());
    }
  }
}

}  // namespace errmap::models
