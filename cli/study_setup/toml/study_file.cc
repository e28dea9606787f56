#include "cli/study_setup/toml/study_file.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "cli/study_setup/study_options.h"
#include "cli/study_setup/toml/toml_keys.h"
#include "cli/study_setup/toml/toml_text.h"
#include "data/argument_name.h"
#include "data/files/atomic_file.h"
#include "data/input_error.h"
#include "data/sha256.h"
#include "data/text.h"
#include "models/recipe_catalog.h"
#include "stats/holdout.h"

namespace errmap::study_setup {
namespace {

using data::QuotedName;

// A value with colons in it, as a SPEC needs it.
std::string Quoted(const std::string& text) {
  return text.find(':') == text.npos || text.find('"') != text.npos
             ? text
             : '"' + text + '"';
}

// Reads what stands in a table of each option.
class Taker {
 public:
  explicit Taker(const Keys& keys) : keys_(keys) {}

  void operator()(const StudyOption& option, std::string& text) const {
    keys_.TakeText(option.key, &text, option.check);
  }
  void operator()(const StudyOption& option,
                  std::vector<std::string>& names) const {
    keys_.TakeList(option.key, &names);
  }
  void operator()(const StudyOption& option, bool& flag) const {
    keys_.TakeFlag(option.key, &flag);
  }
  void operator()(const StudyOption& option, GivenError& error) const {
    keys_.TakeError(option.key, option.may_be_zero, &error);
  }

  template <typename Value>
  void operator()(const StudyOption& option,
                  Value& chosen,
                  const std::vector<Value>& values) const {
    std::string word(ToString(chosen));
    keys_.TakeText(option.key, &word);
    std::vector<std::string> words;
    for (const Value value : values) {
      if (word == ToString(value)) {
        chosen = value;
        return;
      }
      words.push_back(fmt::format("\"{}\"", ToString(value)));
    }
    keys_.RefuseType(
        option.key, *keys_.Find(option.key), data::JoinWords(words, " or "));
  }

 private:
  const Keys& keys_;
};

// Collects the keys.
auto NameOf(std::vector<std::string>* keys) {
  return [keys](const StudyOption& option, const auto&... /*member*/) {
    keys->emplace_back(option.key);
  };
}

class StudyFileReader {
 public:
  explicit StudyFileReader(const std::string& file)
      : file_(file), folder_(std::filesystem::path(file).parent_path()) {}

  StudyFile Read(const toml::table& root) const {
    const Keys keys(root, "the study", file_);
    StudyFile study;
    StudyConfig& config = study.config;
    std::vector<std::string> known = {
        "seed", "holdouts", "models", "model", "component"};
    ForStudyOptions(config, NameOf(&known));
    keys.AllowOnly(known);
    keys.TakeSeed(&config.seed);
    ForStudyOptions(config, Taker(keys));
    keys.TakeList("holdouts", &config.holdouts, [](const std::string& spec) {
      stats::ParseHoldout(spec);
    });
    for (std::string& spec : config.holdouts) {
      const stats::HoldoutSpec parsed = stats::ParseHoldout(spec);
      if (parsed.kind == stats::HoldoutKind::kFile) {
        spec = "file:" + BesideStudyFile(parsed.file);
      }
    }
    keys.TakeList("models", &config.models, [](const std::string& spec) {
      models::MakeRecipe(spec);
    });
    for (const toml::table* table : keys.Tables("model")) {
      config.models.push_back(ReadModel(*table, config.models));
    }
    for (const toml::table* table : keys.Tables("component")) {
      config.components.push_back(ReadComponent(*table, &study.components));
    }
    if (config.components.empty()) {
      throw data::InputError(data::PrintablePath(file_) +
                             ": no [[component]]; add one with data = "
                             "\"FILE.csv\", or let errmap init write the file");
    }
    return study;
  }

 private:
  std::string BesideStudyFile(const std::string& path) const {
    if (folder_.empty()) return path;
    return (folder_ / path).lexically_normal().string();
  }

  // One file, or a list of those that are days of one component.
  void TakeData(const Keys& keys, ComponentConfig* component) const {
    const toml::node* const data = keys.Find("data");
    if (data == nullptr || !data->is_array()) {
      keys.TakeText("data", &component->data);
      return;
    }
    keys.TakeList("data", &component->more_data);
    if (component->more_data.empty()) return;
    component->data = component->more_data.front();
    component->more_data.erase(component->more_data.begin());
    for (std::string& file : component->more_data) {
      file = BesideStudyFile(file);
    }
  }

  ComponentConfig ReadComponent(const toml::table& table,
                                std::vector<ComponentInFile>* in_file) const {
    const Keys keys(table, "[[component]]", file_);
    ComponentConfig component;
    std::vector<std::string> known = {"name", "data", "where"};
    ForComponentOptions(component, NameOf(&known));
    keys.AllowOnly(known);
    keys.TakeText("name", &component.name);
    TakeData(keys, &component);
    if (component.data.empty()) {
      keys.RefuseTable("needs data = \"FILE.csv\"");
    }
    in_file->push_back(
        {.data = component.data,
         .place = Place(file_, table.source()) + "[[component]]: "});
    component.data = BesideStudyFile(component.data);
    component.selection.where = ReadWhere(keys);
    ForComponentOptions(component, Taker(keys));
    return component;
  }

  std::vector<data::ColumnFilter> ReadWhere(const Keys& keys) const {
    std::vector<data::ColumnFilter> filters;
    const toml::node* const node = keys.Find("where");
    if (node == nullptr) return filters;
    if (node->as_table() == nullptr) {
      keys.RefuseType(
          "where", *node, "columns and values: { direction = \"down\" }");
    }
    const Keys columns(*node->as_table(), "where", file_);
    for (const auto& [column, value] : *node->as_table()) {
      if (const auto* const text = value.as_string()) {
        filters.push_back({std::string(column.str()), text->get()});
      } else if (value.is_number()) {
        filters.push_back({std::string(column.str()), NumberOf(value)});
      } else {
        columns.RefuseType(column.str(), value, "text in quotes or a number");
      }
    }
    return filters;
  }

  // use = "poly:stepwise", degree = 2 -> "poly:stepwise:degree=2"
  std::string ReadModel(const toml::table& table,
                        const std::vector<std::string>& earlier) const {
    const Keys keys(table, "[[model]]", file_);
    std::string spec;
    keys.TakeText("use", &spec);
    if (spec.empty()) keys.RefuseTable("needs use = \"SPEC\"");
    for (const auto& [key, node] : InOrderOfTheFile(table)) {
      spec += OptionText(keys, key, *node);
    }
    try {
      models::MakeRecipe(spec);
    } catch (const std::invalid_argument& error) {
      Refuse(file_, table.source(), error.what());
    }
    if (std::ranges::find(earlier, spec) != earlier.end()) {
      keys.RefuseTable("model " + QuotedName(spec) + " is given twice");
    }
    return spec;
  }

  // The options of a model (toml++ sorts its keys by name).
  static std::vector<std::pair<std::string, const toml::node*>>
  InOrderOfTheFile(const toml::table& table) {
    std::vector<std::pair<std::string, const toml::node*>> options;
    for (const auto& [key, value] : table) {
      if (key.str() != "use") options.emplace_back(key.str(), &value);
    }
    const auto place = [](const auto& option) {
      const toml::source_region& at = option.second->source();
      const bool is_override =
          at.path != nullptr && at.path->starts_with(kOverride);
      return std::tuple(is_override, at.begin.line, at.begin.column);
    };
    std::ranges::stable_sort(options, {}, place);
    return options;
  }

  static std::string OptionText(const Keys& keys,
                                const std::string& key,
                                const toml::node& node) {
    if (const auto* const flag = node.as_boolean()) {
      return fmt::format(":{}={}", key, flag->get() ? "yes" : "no");
    }
    if (const auto* const integer = node.as_integer()) {
      return fmt::format(":{}={}", key, integer->get());
    }
    if (const auto* const number = node.as_floating_point()) {
      return fmt::format(":{}={}", key, number->get());
    }
    if (const auto* const text = node.as_string()) {
      return fmt::format(":{}={}", key, Quoted(text->get()));
    }
    constexpr std::string_view kWanted =
        "text, a number, true, false or a list of texts";
    const toml::array* const array = node.as_array();
    if (array == nullptr) keys.RefuseType(key, node, kWanted);
    std::vector<std::string> names;
    for (const toml::node& item : *array) {
      if (!item.is_string()) keys.RefuseType(key, item, kWanted);
      names.push_back(Quoted(item.ref<std::string>()));
    }
    return fmt::format(":{}={}", key, data::JoinWords(names, "+"));
  }

  const std::string& file_;
  std::filesystem::path folder_;
};

// ---- KEY=VALUE in place of what the file says

// Where the first '=' outside double quotes stands.
std::size_t FindEquals(const std::string& text) {
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') quoted = !quoted;
    if (text[i] == '\\' && quoted) ++i;
    if (text[i] == '=' && !quoted) return i;
  }
  return std::string::npos;
}

// An override as a small TOML document. A value that is not TOML is text.
toml::table ParseOverride(const std::string& text) {
  const std::size_t equals = FindEquals(text);
  if (equals == std::string::npos || equals == 0) {
    throw std::invalid_argument(data::PrintablePath(fmt::format(
        "{} must be KEY=VALUE, found '{}'", data::ArgumentName("set"), text)));
  }
  if (LineOfLongKey(text) > 0) {
    throw std::invalid_argument(fmt::format("{}: a key of more than {} parts",
                                            data::ArgumentName("set"),
                                            kMostKeyParts));
  }
  const std::string source = std::string(kOverride) + text;
  const std::string key = text.substr(0, equals);
  try {
    return toml::parse(text, source);
  } catch (const toml::parse_error&) {
    // Then the value is text, or the key is wrong.
  }
  try {
    return toml::parse(key + " = " + TomlText(text.substr(equals + 1)), source);
  } catch (const toml::parse_error& error) {
    throw std::invalid_argument(
        fmt::format("{}: {}; keys are dotted names such as "
                    "component.0.target, odd ones in quotes",
                    NameOfOverride(text),
                    error.description()));
  }
}

// Puts overrides in the place of what the file says.
class Overrider {
 public:
  explicit Overrider(std::string text) : text_(std::move(text)) {}

  void Apply(toml::table&& changes, toml::table* target) const {
    for (auto&& [key, value] : changes) {
      toml::node* const old = target->get(key.str());
      toml::table* const nested = value.as_table();
      const bool descends = nested != nullptr && !nested->is_inline();
      if (descends && old != nullptr && old->is_table()) {
        Apply(std::move(*nested), old->as_table());
      } else if (descends && old != nullptr && old->is_array()) {
        ApplyToList(key.str(), std::move(*nested), old->as_array());
      } else if (descends &&
                 (key.str() == "component" || key.str() == "model")) {
        RefuseItem(key.str(), nested->begin()->first.str(), 0);
      } else {
        // A key that is there would keep its place in the file.
        target->erase(key.str());
        const toml::key& name = key;
        std::move(value).visit([&](auto&& node) {
          target->insert(toml::key(name), std::forward<decltype(node)>(node));
        });
      }
    }
  }

 private:
  void ApplyToList(std::string_view list,
                   toml::table&& changes,
                   toml::array* items) const {
    for (auto&& [key, value] : changes) {
      toml::table* const item = FindItem(key.str(), items);
      if (item == nullptr) RefuseItem(list, key.str(), items->size());
      if (value.as_table() == nullptr) {
        throw std::invalid_argument(fmt::format(
            "{}: {}.{} is a table; name one of its keys: {}.{}.KEY=VALUE",
            NameOfOverride(text_),
            list,
            data::PrintablePath(key.str()),
            list,
            data::PrintablePath(key.str())));
      }
      Apply(std::move(*value.as_table()), item);
    }
  }

  // By name, else by number from 0.
  static toml::table* FindItem(std::string_view key, toml::array* items) {
    for (toml::node& item : *items) {
      toml::table* const table = item.as_table();
      if (table != nullptr && (*table)["name"].value<std::string>() == key) {
        return table;
      }
    }
    for (std::size_t i = 0; i < items->size(); ++i) {
      if (std::to_string(i) == key) return items->get(i)->as_table();
    }
    return nullptr;
  }

  [[noreturn]] void RefuseItem(std::string_view list,
                               std::string_view key,
                               std::size_t size) const {
    throw std::invalid_argument(
        fmt::format("{}: no {} {}; the study file has {}",
                    NameOfOverride(text_),
                    list,
                    QuotedName(key),
                    size == 0 ? "none" : fmt::format("0 to {}", size - 1)));
  }

  std::string text_;
};

}  // namespace

StudyFile ParseStudyFile(const std::string& text,
                         const std::string& path,
                         const std::vector<std::string>& set) {
  toml::table root = ParseToml(text, path);
  for (const std::string& change : set) {
    Overrider(change).Apply(ParseOverride(change), &root);
  }
  return StudyFileReader(path).Read(root);
}

StudyFile ReadStudyFile(const std::string& path,
                        const std::vector<std::string>& set) {
  const std::string text = data::ReadFile(path, data::kMostTextOfPeople);
  StudyFile study = ParseStudyFile(text, path, set);
  study.file = {.file = path, .sha256 = data::Sha256(text)};
  return study;
}

StudyPlan PlanStudy(const StudyFile& file,
                    const Remark& remark,
                    const MakeOwnRecipes& own) {
  StudyPlan plan = PlanStudy(file.config, remark, own);
  plan.inputs.insert(plan.inputs.begin(), file.file);
  return plan;
}

}  // namespace errmap::study_setup
