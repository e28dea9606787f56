#include "models/export/program/safe_names.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "data/text.h"

namespace errmap::models {
namespace {

// Of ASCII only, whatever the locale.
bool IsLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

void DropTrailingUnderscores(std::string* text) {
  while (!text->empty() && text->back() == '_') text->pop_back();
}

}  // namespace

std::string SafeIdentifier(std::string_view text, std::size_t longest) {
  std::string safe;
  for (const char c : text) {
    if (IsLetter(c) || data::IsDigit(c)) {
      safe += c;
    } else if (!safe.empty() && safe.back() != '_') {
      safe += '_';
    }
  }
  if (safe.empty() || !IsLetter(safe.front())) safe = "m_" + safe;
  safe.resize(std::min(safe.size(), longest));
  DropTrailingUnderscores(&safe);
  return safe;
}

std::vector<std::string> SafeIdentifiers(const std::vector<std::string>& texts,
                                         std::size_t longest) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const std::string& text : texts) {
    std::string name = SafeIdentifier(text, longest);
    for (int number = 2; !taken.insert(data::LowerCase(name)).second;
         ++number) {
      const std::string end = fmt::format("_{}", number);
      name = SafeIdentifier(text, longest - end.size()) + end;
    }
    names.push_back(std::move(name));
  }
  return names;
}

std::string CommentText(std::string_view text) {
  constexpr std::size_t kLongest = 80;
  std::string safe;
  for (const char c : text.substr(0, kLongest)) {
    const bool is_plain =
        c >= ' ' && c <= '~' && c != '*' && c != '\\' && c != '?' && c != '"';
    safe += is_plain ? c : '_';
  }
  return safe;
}

std::string RealText(double value, bool single) {
  std::string text = single ? fmt::format("{}", static_cast<float>(value))
                            : fmt::format("{}", value);
  if (text.find('.') != std::string::npos) return text;
  const std::size_t exponent = text.find('e');
  if (exponent == std::string::npos) return text + ".0";
  return text.insert(exponent, ".0");
}

}  // namespace errmap::models
