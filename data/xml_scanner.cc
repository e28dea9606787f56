#include "data/xml_scanner.h"

#include <charconv>
#include <cstdint>
#include <system_error>
#include <utility>

#include "data/input_error.h"
#include "data/text_encoding.h"

namespace errmap::data {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

[[noreturn]] void ThrowBreaksOff() {
  throw InputError("is damaged: its XML breaks off");
}

std::string_view WithoutPrefix(std::string_view name) {
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

// "amp", "#10", "#x3bc"; false where it is none of these.
bool AppendCharacter(std::string_view code, std::string* text) {
  constexpr std::pair<std::string_view, char> kNamed[] = {
      {"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"quot", '"'}, {"apos", '\''}};
  for (const auto& [name, character] : kNamed) {
    if (code == name) {
      *text += character;
      return true;
    }
  }
  if (!code.starts_with('#')) return false;
  code.remove_prefix(1);
  const bool by_sixteen = code.starts_with('x');
  if (by_sixteen) code.remove_prefix(1);
  std::uint32_t number = 0;
  const char* const end = code.data() + code.size();
  const auto [rest, error] =
      std::from_chars(code.data(), end, number, by_sixteen ? 16 : 10);
  constexpr std::uint32_t kLast = 0x10FFFF;
  if (error != std::errc() || rest != end || number == 0 || number > kLast ||
      (number >= 0xD800U && number < 0xE000U)) {
    return false;
  }
  AppendUtf8(number, text);
  return true;
}

std::string Decoded(std::string_view text) {
  std::string decoded;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t mark = text.find('&', at);
    decoded += text.substr(at, mark - at);
    if (mark == std::string_view::npos) break;
    const std::size_t end = text.find(';', mark);
    if (end == std::string_view::npos ||
        !AppendCharacter(text.substr(mark + 1, end - mark - 1), &decoded)) {
      throw InputError("is damaged: an unknown character in its XML");
    }
    at = end + 1;
  }
  return decoded;
}

}  // namespace

XmlScanner::XmlScanner(std::string_view text) : rest_(text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (rest_.starts_with(kMark)) rest_.remove_prefix(kMark.size());
}

// What comes before `mark`; both are taken.
std::string_view XmlScanner::TakeUntil(std::string_view mark) {
  const std::size_t end = rest_.find(mark);
  if (end == std::string_view::npos) ThrowBreaksOff();
  const std::string_view taken = rest_.substr(0, end);
  rest_.remove_prefix(end + mark.size());
  return taken;
}

XmlScanner::Kind XmlScanner::Next() {
  if (closes_at_once_) {
    closes_at_once_ = false;
    return kind_ = Kind::kClose;
  }
  for (;;) {
    if (rest_.empty()) return kind_ = Kind::kEnd;
    if (!rest_.starts_with('<')) {
      is_literal_ = false;
      text_ = rest_.substr(0, rest_.find('<'));
      rest_.remove_prefix(text_.size());
      return kind_ = Kind::kText;
    }
    if (rest_.starts_with("<?")) {
      TakeUntil("?>");
    } else if (rest_.starts_with("<!--")) {
      TakeUntil("-->");
    } else if (constexpr std::string_view kLiteral = "<![CDATA[";
               rest_.starts_with(kLiteral)) {
      rest_.remove_prefix(kLiteral.size());
      is_literal_ = true;
      text_ = TakeUntil("]]>");
      return kind_ = Kind::kText;
    } else {
      break;
    }
  }
  if (rest_.starts_with("<!")) {
    throw InputError("has a DOCTYPE in its XML, which no spreadsheet has");
  }
  rest_.remove_prefix(1);
  // '>' may stand within an attribute.
  std::size_t end = 0;
  for (char quote = '\0'; end < rest_.size(); ++end) {
    const char c = rest_[end];
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      break;
    }
  }
  if (end == rest_.size()) ThrowBreaksOff();
  std::string_view tag = rest_.substr(0, end);
  rest_.remove_prefix(end + 1);
  kind_ = tag.starts_with('/') ? Kind::kClose : Kind::kOpen;
  if (kind_ == Kind::kClose) tag.remove_prefix(1);
  closes_at_once_ = tag.ends_with('/');
  if (closes_at_once_) tag.remove_suffix(1);
  const std::size_t name_end = tag.find_first_of(kBlanks);
  name_ = WithoutPrefix(tag.substr(0, name_end));
  attributes_ = name_end == std::string_view::npos ? std::string_view()
                                                   : tag.substr(name_end);
  return kind_;
}

std::string XmlScanner::Attribute(std::string_view name) const {
  std::string_view rest = attributes_;
  for (;;) {
    const std::size_t begin = rest.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return "";
    rest.remove_prefix(begin);
    const std::size_t equals = rest.find('=');
    const std::size_t quote = rest.find_first_of("\"'");
    if (equals == std::string_view::npos || quote == std::string_view::npos) {
      return "";
    }
    std::string_view found = rest.substr(0, equals);
    found = found.substr(0, found.find_first_of(kBlanks));
    const std::size_t end = rest.find(rest[quote], quote + 1);
    if (end == std::string_view::npos) return "";
    if (WithoutPrefix(found) == name) {
      return Decoded(rest.substr(quote + 1, end - quote - 1));
    }
    rest.remove_prefix(end + 1);
  }
}

std::string XmlScanner::Text() const {
  return is_literal_ ? std::string(text_) : Decoded(text_);
}

}  // namespace errmap::data
