#include "models/model_spec.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace errmap::models {
namespace {

// Splits at `separator` outside double quotes; the quotes stay.
std::vector<std::string> SplitOutsideQuotes(std::string_view text,
                                            char separator) {
  std::vector<std::string> parts(1);
  bool quoted = false;
  for (const char c : text) {
    if (c == '"') quoted = !quoted;
    if (c == separator && !quoted) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  if (quoted) RefuseSpec(text, "a double quote is never closed");
  return parts;
}

// A value wholly in quotes loses them; lists keep theirs for their reader.
std::string Unquote(const std::string& value) {
  const bool whole = value.size() >= 2 && value.front() == '"' &&
                     value.back() == '"' &&
                     std::count(value.begin(), value.end(), '"') == 2;
  return whole ? value.substr(1, value.size() - 2) : value;
}

}  // namespace

void RefuseSpec(std::string_view spec, const std::string& why) {
  throw std::invalid_argument(fmt::format("model '{}': {}", spec, why));
}

ModelSpec ParseModelSpec(std::string_view text) {
  ModelSpec spec;
  spec.text = std::string(text);
  for (const std::string& word : SplitOutsideQuotes(text, ':')) {
    const std::size_t equals = word.find('=');
    if (equals != std::string::npos && equals < word.find('"')) {
      const std::string key = word.substr(0, equals);
      for (const auto& [known, value] : spec.options) {
        if (known == key) RefuseSpec(text, "option '" + key + "' given twice");
      }
      // Lists of terms keep their quotes: they set off the names in them.
      const bool terms =
          key == "formula" || key == "include" || key == "exclude";
      const std::string value = word.substr(equals + 1);
      spec.options.emplace_back(key, terms ? value : Unquote(value));
    } else if (!spec.options.empty() || word.empty()) {
      RefuseSpec(
          text,
          fmt::format("'{}' is not an option; options are KEY=VALUE, set "
                      "off by colons",
                      word));
    } else {
      spec.type += (spec.type.empty() ? "" : ":") + word;
    }
  }
  if (spec.type.empty()) RefuseSpec(text, "names no model");
  return spec;
}

std::vector<std::string> SplitList(std::string_view text) {
  std::vector<std::string> specs = SplitOutsideQuotes(text, ',');
  for (std::string& spec : specs) {
    spec.erase(0, spec.find_first_not_of(' '));
    spec.erase(spec.find_last_not_of(' ') + 1);
    if (spec.empty())
      RefuseSpec(text,
                 "the list has an empty place; names stand between commas, "
                 "without blanks");
  }
  return specs;
}

}  // namespace errmap::models
