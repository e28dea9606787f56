
#include "cli/study_setup/study_options.h"

#include <optional>
#include <type_traits>
#include <utility>

namespace errmap::study_setup {

namespace {

// As a flag takes it; nothing where it is the default.
std::optional<std::string> Word(const std::string& text,
                                const std::string& by_default) {
  if (text == by_default) return {};
  return text;
}

std::optional<std::string> Word(const std::vector<std::string>& names,
                                const std::vector<std::string>& by_default) {
  if (names == by_default) return {};
  return NameList(names);
}

std::optional<std::string> Word(bool flag, bool by_default) {
  if (flag == by_default) return {};
  return "";
}

template <typename Value>
requires std::is_enum_v<Value> std::optional<std::string> Word(
    Value word, Value by_default) {
  if (word == by_default) return {};
  return std::string(ToString(word));
}

}  // namespace

models::ByName<std::string> DataOptions(const data::DatasetSelection& selection,
                                        std::uint64_t seed) {
  models::ByName<std::string> options;
  ForSelectionOptions(selection,
                      [&]<typename Member>(const StudyOption& option,
                                           const Member& said,
                                           const auto&... /*values*/) {
                        if (auto word = Word(said, Member{})) {
                          options.emplace_back(option.key, std::move(*word));
                        }
                      });
  if (seed != StudyConfig{}.seed) {
    options.emplace_back("seed", std::to_string(seed));
  }
  return options;
}

std::string NameList(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) {
    list += list.empty() ? "" : ",";
    if (name.find_first_of(",\"") == std::string::npos) {
      list += name;
      continue;
    }
    // RFC 4180: two quotes stand for one.
    list += '"';
    for (const char c : name) list += c == '"' ? "\"\"" : std::string(1, c);
    list += '"';
  }
  return list;
}

}  // namespace errmap::study_setup
