#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "models/error_model.h"
#include "models/model_options.h"
#include "models/model_spec.h"

namespace errmap::models {

// The list of a family's options. It yields reading and writing of SPECs, their
// error messages, the options in effect, the checks of `Validate`, help and
// completion. To add an option, add a member and one list entry.

using OptionText = decltype(EffectiveOption::value);

/// An option as described to users.
struct OptionInfo {
  std::string name;
  std::string about;   // "hidden nodes"
  std::string values;  // "a whole number from 1 to 10000"
};

// Kinds of value. Each one reads words, checks the range, and writes a value so
// that it reads back.

struct IntegerRange {
  using Value = std::int64_t;
  std::int64_t least;
  std::int64_t most;  // no limit if the largest int64_t

  std::string values() const;
  std::optional<Value> Read(const std::string& text) const;
  bool Allows(Value value) const { return value >= least && value <= most; }
  OptionText Write(Value value) const { return value; }
};

struct Number {
  using Value = double;
  double least;
  double most;  // no limit if the largest double

  std::string values() const;
  std::optional<Value> Read(const std::string& text) const;
  bool Allows(Value value) const { return value >= least && value <= most; }
  OptionText Write(Value value) const { return value; }
};

/// Any text that is not empty.
struct Words {
  using Value = std::string;

  std::string values() const { return "text"; }
  std::optional<Value> Read(const std::string& text) const;
  bool Allows(const Value& /*value*/) const { return true; }
  OptionText Write(const Value& value) const { return value; }
};

std::string OneOfWords(const std::vector<std::string>& words);

template <typename T>
struct OneOf {
  using Value = T;
  std::vector<std::pair<std::string, T>> words;

  std::string values() const {
    std::vector<std::string> all;
    for (const auto& [word, value] : words) all.push_back(word);
    return OneOfWords(all);
  }
  std::optional<Value> Read(const std::string& text) const {
    for (const auto& [word, value] : words) {
      if (word == text) return value;
    }
    return std::nullopt;
  }
  bool Allows(const Value& wanted) const {
    for (const auto& [word, value] : words) {
      if (value == wanted) return true;
    }
    return false;
  }
  OptionText Write(const Value& wanted) const {
    for (const auto& [word, value] : words) {
      if (value == wanted) return word;
    }
    return "?";
  }
};

/// Returns the values of an enumeration in its order, one for each word.
template <typename Enum>
OneOf<Enum> EnumWords(const std::vector<std::string>& words) {
  OneOf<Enum> kind;
  for (std::size_t i = 0; i < words.size(); ++i) {
    kind.words.emplace_back(words[i], static_cast<Enum>(i));
  }
  return kind;
}

/// Returns the same values after "auto", which lets the fit choose.
template <typename Enum>
OneOf<std::optional<Enum>> AutoOrEnum(const std::vector<std::string>& words) {
  OneOf<std::optional<Enum>> kind{{{"auto", std::nullopt}}};
  for (std::size_t i = 0; i < words.size(); ++i) {
    kind.words.emplace_back(words[i], static_cast<Enum>(i));
  }
  return kind;
}

/// A value of another kind, or `special`, which is written as a word.
template <typename T, typename Kind>
struct WordOr {
  using Value = T;
  std::string word;
  T special;
  Kind kind;

  std::string values() const { return word + " or " + kind.values(); }
  std::optional<Value> Read(const std::string& text) const {
    if (text == word) return special;
    const auto value = kind.Read(text);
    if (!value || !kind.Allows(*value)) return std::nullopt;
    return static_cast<T>(*value);
  }
  bool Allows(const Value& value) const {
    return value == special ||
           kind.Allows(static_cast<typename Kind::Value>(value));
  }
  OptionText Write(const Value& value) const {
    if (value == special) return word;
    return kind.Write(static_cast<typename Kind::Value>(value));
  }
};

/// One option of `Options`.
template <typename Options>
struct Option : OptionInfo {
  /// Reads a word; false if it is not an allowed value.
  std::function<bool(const std::string& text, Options*)> read;
  std::function<bool(const Options&)> allows;
  /// Returns nothing if the options lack the value or leave it unset.
  std::function<std::optional<OptionText>(const Options&)> write;
  /// True if it differs from its value in `defaults`.
  std::function<bool(const Options&, const Options& defaults)> is_set;
  /// True if it is listed among the options in effect; empty: listed if set.
  std::function<bool(const Options&)> is_shown;
  bool always_in_spec = false;

  Option Always() && {
    is_shown = [](const Options&) { return true; };
    return std::move(*this);
  }
  Option Never() && {
    is_shown = [](const Options&) { return false; };
    return std::move(*this);
  }
  Option When(std::function<bool(const Options&)> shown) && {
    is_shown = std::move(shown);
    return std::move(*this);
  }
};

template <typename Options>
using OptionList = std::vector<Option<Options>>;

/// An option whose value is at `at(options)`. A null pointer means that these
/// options lack it; its word is then only checked. If the value is a
/// std::optional, an empty one is always allowed.
template <typename Options, typename At, typename Kind>
requires std::invocable<At, Options&> Option<Options> OptionFor(
    const std::string& name, const std::string& about, At at, Kind kind) {
  using Value = typename Kind::Value;
  using Place = std::remove_pointer_t<std::invoke_result_t<At, Options&>>;
  constexpr bool kMayBeOpen = requires(Place place) { place.has_value(); }
  &&!std::is_same_v<Place, Value>;
  const auto value_at = [at](const Options& options) -> std::optional<Value> {
    const auto* place = at(options);
    if (place == nullptr) return std::nullopt;
    if constexpr (kMayBeOpen) {
      if (!place->has_value()) return std::nullopt;
      return static_cast<Value>(**place);
    } else {
      return static_cast<Value>(*place);
    }
  };
  Option<Options> option;
  option.name = name;
  option.about = about;
  option.values = kind.values();
  option.read = [at, kind](const std::string& text, Options* options) {
    const auto value = kind.Read(text);
    if (!value || !kind.Allows(*value)) return false;
    auto* place = at(*options);
    if (place == nullptr) return true;
    if constexpr (kMayBeOpen) {
      *place = static_cast<typename Place::value_type>(*value);
    } else {
      *place = static_cast<Place>(*value);
    }
    return true;
  };
  option.allows = [value_at, kind](const Options& options) {
    const auto value = value_at(options);
    return !value || kind.Allows(*value);
  };
  option.write = [value_at,
                  kind](const Options& options) -> std::optional<OptionText> {
    const auto value = value_at(options);
    if (!value) return std::nullopt;
    return kind.Write(*value);
  };
  option.is_set = [value_at](const Options& options, const Options& defaults) {
    const auto value = value_at(options);
    return value && value != value_at(defaults);
  };
  return option;
}

template <typename Options, typename Member, typename Kind>
Option<Options> OptionFor(std::string name,
                          std::string about,
                          Member Options::*member,
                          Kind kind) {
  return OptionFor<Options>(
      std::move(name),
      std::move(about),
      [member](auto& options) { return &(options.*member); },
      std::move(kind));
}

/// An option of a part of `Options`: `at(options)` points at the part, or is
/// null if there is none.
template <typename Options, typename Part, typename At>
Option<Options> Within(const Option<Part>& part, At at) {
  Option<Options> option;
  static_cast<OptionInfo&>(option) = part;
  option.read = [part, at](const std::string& text, Options* options) {
    if (Part* own = at(*options)) return part.read(text, own);
    Part unused{};
    return part.read(text, &unused);
  };
  option.allows = [part, at](const Options& options) {
    const Part* own = at(options);
    return own == nullptr || part.allows(*own);
  };
  option.write = [part,
                  at](const Options& options) -> std::optional<OptionText> {
    const Part* own = at(options);
    return own == nullptr ? std::nullopt : part.write(*own);
  };
  option.is_set = [part, at](const Options& options, const Options& defaults) {
    const Part* own = at(options);
    const Part* default_part = at(defaults);
    return own != nullptr &&
           part.is_set(*own, default_part ? *default_part : Part{});
  };
  if (part.is_shown) {
    option.is_shown = [part, at](const Options& options) {
      const Part* own = at(options);
      return own != nullptr && part.is_shown(*own);
    };
  }
  option.always_in_spec = part.always_in_spec;
  return option;
}

template <typename Options, typename Part>
Option<Options> Within(const Option<Part>& part, Part Options::*member) {
  return Within<Options>(
      part, [member](auto& options) { return &(options.*member); });
}

template <typename Options, typename Part, typename At>
void AddWithin(const OptionList<Part>& parts, At at, OptionList<Options>* all) {
  for (const Option<Part>& part : parts) {
    all->push_back(Within<Options>(part, at));
  }
}

/// A model of a family, as a SPEC names it.
template <typename Options>
struct ListedModel {
  std::string name;
  std::string about;
  Options defaults;
  /// Makes the list at each call, so that the program's start does not list all
  /// options.
  std::function<OptionList<Options>()> options;
  /// Returns why options that are allowed one by one contradict each other; ""
  /// if they do not.
  std::string (*contradiction)(const Options&) = nullptr;
  /// Adds options that a SPEC implies, if any.
  void (*complete)(ModelSpec*) = nullptr;
  /// True if `compare` includes this model when no models are named.
  bool is_compared = true;
};

/// The models of a family; specialised next to its options. Each `Options` type
/// has `type()`, the name of its model.
template <typename Options>
const std::vector<ListedModel<Options>>& ListedModels();

[[noreturn]] void RefuseValue(std::string_view spec,
                              const OptionInfo& option,
                              const std::string& found);
/// Throws if the SPEC has options that are not among `known`.
void RefuseOthers(const ModelSpec& spec, const std::vector<OptionInfo>& known);
std::string TextOf(const OptionText& value);
/// Returns ":key=value", with quotes if needed.
std::string SpecWord(const std::string& key, const OptionText& value);

template <typename Options>
const ListedModel<Options>& ListedModelNamed(std::string_view spec,
                                             std::string_view name) {
  for (const ListedModel<Options>& model : ListedModels<Options>()) {
    if (model.name == name) return model;
  }
  RefuseSpec(spec, "is of another family");
}

template <typename Options>
std::vector<OptionInfo> InfoOf(const OptionList<Options>& options) {
  return {options.begin(), options.end()};
}

template <typename Options>
Options ReadOptions(ModelSpec spec) {
  const auto& model = ListedModelNamed<Options>(spec.text, spec.type);
  if (model.complete != nullptr) model.complete(&spec);
  Options taken = model.defaults;
  const OptionList<Options> options = model.options();
  for (const Option<Options>& option : options) {
    for (const auto& [key, value] : spec.options) {
      if (key != option.name) continue;
      bool is_allowed = false;
      try {
        is_allowed = option.read(value, &taken);
      } catch (const std::invalid_argument& error) {
        RefuseSpec(spec.text, error.what());
      }
      if (!is_allowed) RefuseValue(spec.text, option, value);
    }
  }
  RefuseOthers(spec, InfoOf(options));
  if (model.contradiction != nullptr) {
    const std::string why = model.contradiction(taken);
    if (!why.empty()) RefuseSpec(spec.text, why);
  }
  return taken;
}

template <typename Options>
Options OptionsOf(std::string_view spec) {
  return ReadOptions<Options>(ParseModelSpec(spec));
}

template <typename Options>
std::string SpecOf(const Options& options) {
  const auto& model = ListedModelNamed<Options>("", options.type());
  std::string spec = model.name;
  for (const Option<Options>& option : model.options()) {
    if (!option.always_in_spec && !option.is_set(options, model.defaults)) {
      continue;
    }
    const auto value = option.write(options);
    if (value) spec += SpecWord(option.name, *value);
  }
  return spec;
}

/// Throws std::invalid_argument naming the option, its value and range, or the
/// contradiction.
template <typename Options>
void ValidateOptions(const Options& options) {
  const auto& model = ListedModelNamed<Options>("", options.type());
  for (const Option<Options>& option : model.options()) {
    if (option.allows(options)) continue;
    RefuseValue(SpecOf(options), option, TextOf(*option.write(options)));
  }
  if (model.contradiction != nullptr) {
    const std::string why = model.contradiction(options);
    if (!why.empty()) RefuseSpec(SpecOf(options), why);
  }
}

/// Returns the name of a recipe of these options: `name`, or their SPEC if it
/// is empty. Throws as ValidateOptions.
template <typename Options>
std::string CheckedName(const Options& options, std::string name) {
  ValidateOptions(options);
  return name.empty() ? SpecOf(options) : std::move(name);
}

/// Returns the options in effect, without unset ones.
template <typename Options>
std::vector<EffectiveOption> InEffect(const Options& options) {
  const auto& model = ListedModelNamed<Options>("", options.type());
  std::vector<EffectiveOption> all;
  for (const Option<Options>& option : model.options()) {
    const bool shown = option.is_shown ? option.is_shown(options)
                                       : option.is_set(options, model.defaults);
    if (!shown) continue;
    if (auto value = option.write(options)) {
      all.push_back({option.name, *std::move(value)});
    }
  }
  return all;
}

/// A model of any family.
struct ModelType {
  std::string name;
  std::string about;
  std::function<std::vector<OptionInfo>()> options;
  bool is_compared;
  std::unique_ptr<ModelRecipe> (*make)(const ModelSpec& spec);
  /// Returns the SPEC in its canonical form.
  std::string (*rewrite)(const ModelSpec& spec);
};

template <typename Options>
std::vector<ModelType> TypesOf() {
  std::vector<ModelType> types;
  for (const ListedModel<Options>& model : ListedModels<Options>()) {
    types.push_back({model.name,
                     model.about,
                     [&model] { return InfoOf(model.options()); },
                     model.is_compared,
                     [](const ModelSpec& spec) -> std::unique_ptr<ModelRecipe> {
                       return MakeRecipe(ReadOptions<Options>(spec), spec.text);
                     },
                     [](const ModelSpec& spec) {
                       return SpecOf(ReadOptions<Options>(spec));
                     }});
  }
  return types;
}

}  // namespace errmap::models
