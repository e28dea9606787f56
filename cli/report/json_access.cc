#include "cli/report/json_access.h"

#include <cmath>
#include <limits>

#include "data/text.h"

namespace errmap::cli {
namespace {

const Json& Nothing() {
  static const Json nothing;
  return nothing;
}

}  // namespace

const Json& At(const Json& json, std::string_view key) {
  if (!json.is_object()) return Nothing();
  const auto found = json.find(key);
  return found == json.end() ? Nothing() : *found;
}

const Json& At(const Json& json, std::initializer_list<std::string_view> path) {
  const Json* here = &json;
  for (const std::string_view key : path) here = &At(*here, key);
  return *here;
}

const Json& At(const Json& json, std::size_t index) {
  return json.is_array() && index < json.size() ? json[index] : Nothing();
}

double NumberOf(const Json& json) {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  if (!json.is_number()) return kNothing;
  const double value = json.get<double>();
  return std::isfinite(value) ? value : kNothing;
}

double NumberAt(const Json& json, std::string_view key) {
  return NumberOf(At(json, key));
}

std::string TextOf(const Json& json) {
  return json.is_string() ? data::AsUtf8(json.get_ref<const std::string&>())
                          : "";
}

std::string TextAt(const Json& json, std::string_view key) {
  return TextOf(At(json, key));
}

bool IsTrue(const Json& json, std::string_view key) {
  const Json& value = At(json, key);
  return value.is_boolean() && value.get<bool>();
}

std::vector<double> NumbersOf(const Json& json) {
  std::vector<double> numbers;
  if (!json.is_array()) return numbers;
  numbers.reserve(json.size());
  for (const Json& value : json) numbers.push_back(NumberOf(value));
  return numbers;
}

std::vector<std::string> TextsOf(const Json& json) {
  std::vector<std::string> texts;
  if (!json.is_array()) return texts;
  for (const Json& value : json) {
    if (value.is_string()) texts.push_back(TextOf(value));
  }
  return texts;
}

const Json& Find(const Json& list,
                 std::string_view key,
                 std::string_view text) {
  if (!list.is_array()) return Nothing();
  for (const Json& entry : list) {
    const Json& value = At(entry, key);
    if (value.is_string() && value.get_ref<const std::string&>() == text) {
      return entry;
    }
  }
  return Nothing();
}

}  // namespace errmap::cli
