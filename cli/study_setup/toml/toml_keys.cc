#include "cli/study_setup/toml/toml_keys.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "cli/study_setup/toml/toml_text.h"
#include "data/argument_name.h"
#include "data/input_error.h"
#include "data/text.h"

namespace errmap::study_setup {
namespace {

using data::QuotedName;
using data::QuotedText;

std::string Found(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return "text (" + QuotedText(node.ref<std::string>()) + ")";
    case toml::node_type::integer:
      return fmt::format("a number ({})", node.ref<std::int64_t>());
    case toml::node_type::floating_point:
      return fmt::format("a number ({})", node.ref<double>());
    case toml::node_type::boolean:
      return node.ref<bool>() ? "true" : "false";
    default:
      return "a date or time";
  }
}

}  // namespace

std::string NameOfOverride(std::string_view change) {
  return data::PrintablePath(data::ArgumentName("set", change));
}

std::string Place(const std::string& file, const toml::source_region& at) {
  return fmt::format(
      "{}:{}:{}: ", data::PrintablePath(file), at.begin.line, at.begin.column);
}

void Refuse(const std::string& file,
            const toml::source_region& at,
            const std::string& what) {
  if (at.path != nullptr && at.path->starts_with(kOverride)) {
    throw std::invalid_argument(
        NameOfOverride(at.path->substr(kOverride.size())) + ": " + what);
  }
  throw data::InputError(Place(file, at) + what);
}

double NumberOf(const toml::node& node) {
  const auto* const whole = node.as_integer();
  return whole != nullptr ? static_cast<double>(whole->get())
                          : node.ref<double>();
}

toml::table ParseToml(const std::string& text, const std::string& path) {
  if (const std::size_t line = LineOfLongKey(text); line > 0) {
    throw data::InputError(
        fmt::format("{}: line {}: a key of more than {} parts",
                    data::PrintablePath(path),
                    line,
                    kMostKeyParts));
  }
  // The parser asserts that there is none.
  if (const std::size_t at = text.find('\0'); at != std::string::npos) {
    const auto before = std::count(
        text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    throw data::InputError(
        fmt::format("{}: line {}: a NUL byte; this is not a text file",
                    data::PrintablePath(path),
                    before + 1));
  }
  try {
    return toml::parse(text, path);
  } catch (const toml::parse_error& error) {
    throw data::InputError(
        Place(path, error.source()) +
        data::PrintablePath(std::string(error.description())));
  }
}

Keys::Keys(const toml::table& table, std::string where, const std::string& file)
    : table_(table), where_(std::move(where)), file_(file) {}

void Keys::AllowOnly(const std::vector<std::string>& known) const {
  for (const auto& [key, value] : table_) {
    if (std::ranges::find(known, key.str()) != known.end()) continue;
    Refuse(file_,
           key.source(),
           fmt::format("unknown key {} in {}; {}allowed are {}",
                       QuotedName(key.str()),
                       where_,
                       data::DidYouMean(key.str(), known),
                       data::JoinWords(known, ", ")));
  }
}

void Keys::TakeText(std::string_view key,
                    std::string* text,
                    void (*check)(const std::string&)) const {
  const toml::node* const node = Find(key);
  if (node == nullptr) return;
  const auto* const value = node->as_string();
  if (value == nullptr) RefuseType(key, *node, "text in quotes");
  if (value->get().empty()) {
    Refuse(file_,
           node->source(),
           fmt::format("'{}' must not be empty; leave it out for the default",
                       key));
  }
  try {
    if (check != nullptr) check(value->get());
  } catch (const std::invalid_argument& error) {
    Refuse(file_, node->source(), fmt::format("'{}' {}", key, error.what()));
  }
  *text = value->get();
}

void Keys::TakeFlag(std::string_view key, bool* flag) const {
  const toml::node* const node = Find(key);
  if (node == nullptr) return;
  const auto* const value = node->as_boolean();
  if (value == nullptr) RefuseType(key, *node, "true or false");
  *flag = value->get();
}

void Keys::TakeError(std::string_view key,
                     bool may_be_zero,
                     GivenError* error) const {
  const toml::node* const node = Find(key);
  if (node == nullptr) return;
  const auto* const text = node->as_string();
  if (text == nullptr && !node->is_number()) {
    RefuseType(key, *node, "a number or a text such as \"2um\"");
  }
  try {
    *error = ParseGivenError(
        text == nullptr ? fmt::format("{}", NumberOf(*node)) : text->get(),
        may_be_zero);
  } catch (const std::invalid_argument& refusal) {
    Refuse(file_, node->source(), fmt::format("'{}' {}", key, refusal.what()));
  }
}

void Keys::TakeSeed(std::uint64_t* seed) const {
  const toml::node* const node = Find("seed");
  if (node == nullptr) return;
  const auto* const value = node->as_integer();
  if (value == nullptr || value->get() < 0) {
    RefuseType("seed", *node, "a whole number from 0");
  }
  *seed = static_cast<std::uint64_t>(value->get());
}

void Keys::TakeList(
    std::string_view key,
    std::vector<std::string>* list,
    const std::function<void(const std::string&)>& check) const {
  constexpr std::string_view kWanted = "a list of texts such as [\"a\"]";
  const toml::node* const node = Find(key);
  if (node == nullptr) return;
  const toml::array* const array = node->as_array();
  if (array == nullptr) RefuseType(key, *node, kWanted);
  for (const toml::node& item : *array) {
    const auto* const text = item.as_string();
    if (text == nullptr) RefuseType(key, item, kWanted);
    if (std::ranges::find(*list, text->get()) != list->end()) {
      Refuse(file_,
             item.source(),
             fmt::format("'{}' has {} twice", key, QuotedName(text->get())));
    }
    try {
      if (check) check(text->get());
    } catch (const std::invalid_argument& error) {
      Refuse(file_, item.source(), error.what());
    }
    list->push_back(text->get());
  }
}

void Keys::RefuseType(std::string_view key,
                      const toml::node& node,
                      std::string_view wanted) const {
  Refuse(file_,
         node.source(),
         fmt::format("{} in {} must be {}, found {}",
                     QuotedName(key),
                     where_,
                     wanted,
                     Found(node)));
}

void Keys::RefuseTable(const std::string& what) const {
  Refuse(file_, table_.source(), where_ + ": " + what);
}

std::vector<const toml::table*> Keys::Tables(std::string_view key) const {
  std::vector<const toml::table*> tables;
  const toml::node* const node = Find(key);
  if (node == nullptr) return tables;
  const std::string wanted = fmt::format("tables, each headed [[{}]]", key);
  const toml::array* const array = node->as_array();
  if (array == nullptr) RefuseType(key, *node, wanted);
  for (const toml::node& item : *array) {
    if (item.as_table() == nullptr) RefuseType(key, item, wanted);
    tables.push_back(item.as_table());
  }
  return tables;
}

}  // namespace errmap::study_setup
