#include "models/history/view_options.h"

#include <algorithm>
#include <cmath>
#include <exception>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace errmap::models {
namespace {

// "auto", "none" or "600+3600".
struct TimeConstants {
  using Value = std::optional<std::vector<double>>;

  std::string values() const {
    return "auto, none or time constants above 0 joined by +";
  }

  std::optional<Value> Read(const std::string& text) const {
    if (text == "auto") return Value();
    if (text == "none") return Value(std::in_place);
    std::vector<double> constants;
    std::size_t begin = 0;
    while (begin <= text.size()) {
      const std::size_t end = std::min(text.find('+', begin), text.size());
      const std::string item = text.substr(begin, end - begin);
      std::size_t used = 0;
      try {
        constants.push_back(std::stod(item, &used));
      } catch (const std::exception&) {
        return std::nullopt;
      }
      if (used != item.size()) return std::nullopt;
      begin = end + 1;
    }
    return Value(std::move(constants));
  }

  bool Allows(const Value& value) const {
    return !value || std::ranges::all_of(*value, [](double constant) {
      return constant > 0.0 && std::isfinite(constant);
    });
  }

  OptionText Write(const Value& value) const {
    if (!value) return "auto";
    if (value->empty()) return "none";
    return fmt::format("{}", fmt::join(*value, "+"));
  }
};

OptionList<ViewOptions> List() {
  OptionList<ViewOptions> list = {
      OptionFor("view",
                "the form in which it sees its inputs",
                &ViewOptions::view,
                AutoOrEnum<View>(ViewWords()))
          .Always(),
      OptionFor("history",
                "filters of its inputs, in the unit of time",
                &ViewOptions::time_constants,
                TimeConstants()),
      OptionFor("zero",
                "minus the values at the start of a session",
                &ViewOptions::zero,
                OneOf<bool>{{{"session", true}, {"none", false}}}),
      OptionFor("intercept",
                "an error where a session begins",
                &ViewOptions::intercept,
                OneOf<bool>{{{"yes", true}, {"no", false}}}),
      OptionFor(
          "angles",
          "sine and cosine in place of angles",
          &ViewOptions::sine_and_cosine,
          OneOf<std::optional<bool>>{
              {{"auto", std::nullopt}, {"sincos", true}, {"none", false}}})};
  return list;
}

const auto kIn = [](auto& options) { return options ? &*options : nullptr; };

}  // namespace

const OptionList<std::optional<ViewOptions>>& ViewOptionList() {
  using Asked = std::optional<ViewOptions>;
  static const OptionList<Asked> list = [] {
    OptionList<Asked> all;
    AddWithin(List(), kIn, &all);
    // The first is what makes it a view.
    const Option<ViewOptions> view = List().front();
    all.front().read = [view](const std::string& text, Asked* asked) {
      ViewOptions options = asked->value_or(ViewOptions());
      if (!view.read(text, &options)) return false;
      *asked = options;
      return true;
    };
    all.front().is_set = [view](const Asked& asked, const Asked& defaults) {
      return asked && (!defaults || view.is_set(*asked, *defaults));
    };
    return all;
  }();
  return list;
}

void NameTheView(ModelSpec* spec, bool intercept_counts) {
  const auto word = [&](std::string_view key) -> std::string {
    for (const auto& [name, value] : spec->options) {
      if (name == key) return value;
    }
    return "";
  };
  const std::string history = word("history");
  const std::string zero = word("zero");
  const bool any = !history.empty() || !zero.empty() ||
                   !word("angles").empty() ||
                   (intercept_counts && word("intercept") == "no");
  if (!any || !word("view").empty()) return;
  const bool filters = !history.empty() && history != "none";
  const bool zeroes = zero == "session";
  spec->options.emplace_back("view",
                             ToString(filters && zeroes ? View::kHistoryAndZero
                                      : filters         ? View::kHistory
                                      : zeroes          ? View::kZero
                                                        : View::kRaw));
}

std::string KeyOf(const std::optional<ViewOptions>& options) {
  std::string key;
  for (const Option<std::optional<ViewOptions>>& option : ViewOptionList()) {
    if (option.name == "view" || !option.is_set(options, std::nullopt)) {
      continue;
    }
    key += SpecWord(option.name, *option.write(options));
  }
  return key;
}

}  // namespace errmap::models
