#include "models/option_list.h"

#include <algorithm>
#include <charconv>
#include <limits>

#include <fmt/format.h>

#include "data/text.h"

namespace errmap::models {
namespace {

template <typename Value>
std::optional<Value> ReadWhole(const std::string& text) {
  Value value{};
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stopped != end) return std::nullopt;
  return value;
}

template <typename Value>
std::string RangeText(std::string_view what, Value least, Value most) {
  const bool bounded = most != std::numeric_limits<Value>::max();
  return fmt::format("{} from {}{}",
                     what,
                     least,
                     bounded ? fmt::format(" to {}", most) : " on");
}

}  // namespace

std::string IntegerRange::values() const {
  return RangeText("a whole number", least, most);
}

std::optional<std::int64_t> IntegerRange::Read(const std::string& text) const {
  return ReadWhole<std::int64_t>(text);
}

std::string Number::values() const {
  return RangeText("a number", least, most);
}

std::optional<double> Number::Read(const std::string& text) const {
  return ReadWhole<double>(text);
}

std::optional<std::string> Words::Read(const std::string& text) const {
  if (text.empty()) return std::nullopt;
  return text;
}

std::string OneOfWords(const std::vector<std::string>& words) {
  return fmt::format("one of {}", data::JoinWords(words, ", "));
}

void RefuseValue(std::string_view spec,
                 const OptionInfo& option,
                 const std::string& found) {
  if (found.empty() && option.values == Words().values()) {
    RefuseSpec(spec, option.name + " is empty");
  }
  RefuseSpec(
      spec,
      fmt::format(
          "{} must be {}, found '{}'", option.name, option.values, found));
}

void RefuseOthers(const ModelSpec& spec, const std::vector<OptionInfo>& known) {
  std::vector<std::string> names;
  for (const OptionInfo& option : known) names.push_back(option.name);
  for (const auto& [key, value] : spec.options) {
    if (std::ranges::find(names, key) != names.end()) continue;
    if (names.empty()) {
      RefuseSpec(
          spec.text,
          fmt::format("{} takes no options, found '{}'", spec.type, key));
    }
    const std::string nearest = data::NearestName(key, names);
    RefuseSpec(
        spec.text,
        fmt::format("no option '{}'; {}{} has {}",
                    key,
                    nearest.empty() ? "" : "did you mean '" + nearest + "'? ",
                    spec.type,
                    data::JoinWords(names, ", ")));
  }
}

std::string TextOf(const OptionText& value) {
  return std::visit([](const auto& one) { return fmt::format("{}", one); },
                    value);
}

std::string SpecWord(const std::string& key, const OptionText& value) {
  std::string text = TextOf(value);
  // Lists of terms quote the names in them that need it.
  if (text.find_first_of(":,") != std::string::npos &&
      text.find('"') == std::string::npos) {
    text = '"' + text + '"';
  }
  return fmt::format(":{}={}", key, text);
}

}  // namespace errmap::models
