#include "cli/desk/toml/toml_text.h"

#include <fmt/format.h>

namespace errmap::desk {
std::size_t LineOfLongKey(std::string_view text) {
  constexpr std::string_view kEndsAKeyOrValue = "\n=,{}[]";
  std::size_t dots = 0;  // since then
  std::size_t line = 1;
  for (const char c : text) {
    if (c == '.') {
      if (++dots >= kMostKeyParts) return line;
    } else if (kEndsAKeyOrValue.find(c) != std::string_view::npos) {
      dots = 0;
    }
    if (c == '\n') ++line;
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

}  // namespace errmap::desk
