#include "cli/report/html.h"

#include "data/text.h"

namespace errmap::report {
namespace {

// Line breaks and the like as blanks.
std::string Plain(std::string_view text) {
  constexpr unsigned char kDelete = 0x7f;
  std::string plain = data::AsUtf8(text);
  for (char& c : plain) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < ' ' || byte == kDelete) c = ' ';
  }
  return plain;
}

}  // namespace

std::string HtmlText(std::string_view text) {
  std::string html;
  for (const char c : Plain(text)) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      case '\'':
        html += "&#39;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

std::string HtmlName(std::string_view name) {
  return "<bdi>" + HtmlText(name) + "</bdi>";
}

std::string MarkdownText(std::string_view text) {
  constexpr std::string_view kSpecial = "\\`*_{}[]<>()#+!|~&$";
  std::string escaped;
  for (const char c : Plain(text)) {
    if (kSpecial.find(c) != std::string_view::npos) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

}  // namespace errmap::report
