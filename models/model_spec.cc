#include "models/model_spec.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "data/text.h"

namespace errmap::models {
namespace {

std::string Refusal(std::string_view text, const std::string& why) {
  return fmt::format("model '{}': {}", text, why);
}

[[noreturn]] void RefuseSpec(std::string_view text, const std::string& why) {
  throw std::invalid_argument(Refusal(text, why));
}

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

template <typename Number>
bool ParseWhole(const std::string& text, Number* value) {
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, *value);
  return error == std::errc() && stopped == end;
}

}  // namespace

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
      RefuseSpec(text,
                 fmt::format("'{}' is no option; options are KEY=VALUE, set "
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
    if (spec.empty()) RefuseSpec(text, "the list has an empty place");
  }
  return specs;
}

const std::string* SpecOptions::Find(const std::string& key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) {
    known_.push_back(key);
  }
  for (const auto& [name, value] : spec_.options) {
    if (name == key) return &value;
  }
  return nullptr;
}

void SpecOptions::Refuse(const std::string& why) const {
  RefuseSpec(spec_.text, why);
}

std::int64_t SpecOptions::TakeInteger(const std::string& key,
                                      std::int64_t fallback,
                                      std::int64_t least,
                                      std::int64_t most) {
  const std::string* text = Find(key);
  if (text == nullptr) return fallback;
  std::int64_t value = 0;
  if (!ParseWhole(*text, &value) || value < least || value > most) {
    const bool bounded = most != std::numeric_limits<std::int64_t>::max();
    Refuse(fmt::format("{} must be {}a whole number from {}{}, found '{}'",
                       key,
                       WordBefore(key),
                       least,
                       bounded ? fmt::format(" to {}", most) : " on",
                       *text));
  }
  return value;
}

double SpecOptions::TakeNumber(const std::string& key,
                               double fallback,
                               double least,
                               double most) {
  const std::string* text = Find(key);
  if (text == nullptr) return fallback;
  double value = 0.0;
  if (!ParseWhole(*text, &value) || !(value >= least && value <= most)) {
    const bool bounded = most != std::numeric_limits<double>::max();
    Refuse(fmt::format("{} must be {}a number from {}{}, found '{}'",
                       key,
                       WordBefore(key),
                       least,
                       bounded ? fmt::format(" to {}", most) : " on",
                       *text));
  }
  return value;
}

std::string SpecOptions::TakeText(const std::string& key,
                                  const std::string& fallback) {
  const std::string* text = Find(key);
  if (text == nullptr) return fallback;
  if (text->empty()) Refuse(key + " is empty");
  return *text;
}

std::string SpecOptions::WordBefore(const std::string& key) const {
  for (const auto& [name, word] : words_) {
    if (name == key) return word + " or ";
  }
  return "";
}

bool SpecOptions::IsWord(const std::string& key, std::string_view word) {
  const std::string* text = Find(key);
  words_.emplace_back(key, word);
  return text != nullptr && *text == word;
}

std::size_t SpecOptions::TakeChoice(const std::string& key,
                                    std::size_t fallback,
                                    const std::vector<std::string>& allowed) {
  const std::string* text = Find(key);
  if (text == nullptr) return fallback;
  const auto found = std::find(allowed.begin(), allowed.end(), *text);
  if (found == allowed.end()) {
    Refuse(fmt::format("{} must be one of {}, found '{}'",
                       key,
                       fmt::join(allowed, ", "),
                       *text));
  }
  return static_cast<std::size_t>(found - allowed.begin());
}

void SpecOptions::RefuseOthers() const {
  for (const auto& [key, value] : spec_.options) {
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    const std::string nearest = data::NearestName(key, known_);
    throw UnknownOption(
        Refusal(
            spec_.text,
            known_.empty()
                ? fmt::format(
                      "{} takes no options, found '{}'", spec_.type, key)
                : fmt::format(
                      "no option '{}'; {}{} has {}",
                      key,
                      nearest.empty() ? "" : "did you mean '" + nearest + "'? ",
                      spec_.type,
                      fmt::join(known_, ", "))),
        known_);
  }
}

}  // namespace errmap::models
