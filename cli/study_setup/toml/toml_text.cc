#include "cli/study_setup/toml/toml_text.h"

#include <algorithm>

#include <fmt/format.h>

namespace errmap::study_setup {
namespace {

// Where the string that begins at `begin` with a quotation mark ends; strings
// in three marks may hold lines.
std::size_t EndOfString(std::string_view text, std::size_t begin) {
  const char mark = text[begin];
  const std::string three(3, mark);
  const bool is_long = text.substr(begin).starts_with(three);
  std::size_t at = begin + (is_long ? 3 : 1);
  while (at < text.size()) {
    if (text[at] == '\\' && mark == '"') {
      at += 2;
    } else if (is_long ? text.substr(at).starts_with(three)
                       : text[at] == mark) {
      return at + (is_long ? 3 : 1);
    } else if (!is_long && text[at] == '\n') {
      return at;  // the parser will say so
    } else {
      ++at;
    }
  }
  return text.size();
}

}  // namespace

std::size_t LineOfLongKey(std::string_view text) {
  constexpr std::string_view kEndsAKeyOrValue = "\n=,{}[]";
  std::size_t dots = 0;  // since then
  std::size_t line = 1;
  std::size_t at = 0;
  while (at < text.size()) {
    const char c = text[at];
    std::size_t next = at + 1;
    if (c == '"' || c == '\'') {
      next = EndOfString(text, at);
    } else if (c == '#') {
      next = std::min(text.find('\n', at), text.size());
    } else if (c == '.') {
      if (++dots >= kMostKeyParts) return line;
    } else if (kEndsAKeyOrValue.find(c) != std::string_view::npos) {
      dots = 0;
    }
    const std::string_view passed = text.substr(at, next - at);
    line += static_cast<std::size_t>(std::ranges::count(passed, '\n'));
    at = next;
  }
  return 0;
}

std::string TomlText(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (byte < 0x20U || byte == 0x7FU) {
      quoted += fmt::format("\\u{:04X}", byte);
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

std::string TomlKey(std::string_view text) {
  constexpr std::string_view kBare =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  const bool is_bare =
      !text.empty() && text.find_first_not_of(kBare) == std::string_view::npos;
  return is_bare ? std::string(text) : TomlText(text);
}

std::string TomlList(const std::vector<std::string>& items) {
  constexpr std::size_t kLineLength = 60;
  std::size_t length = 0;
  for (const std::string& item : items) length += item.size() + 4;
  const bool one_line = length <= kLineLength;
  std::string text = "[";
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) text += ",";
    text += one_line ? (i > 0 ? " " : "") : "\n  ";
    text += TomlText(items[i]);
  }
  return text + (one_line ? "]" : ",\n]");
}

}  // namespace errmap::study_setup
