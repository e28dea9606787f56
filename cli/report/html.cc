#include "cli/report/html.h"

#include <algorithm>
#include <iterator>
#include <utility>

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
  static constexpr std::pair<char, const char*> kEntities[] = {{'&', "&amp;"},
                                                               {'<', "&lt;"},
                                                               {'>', "&gt;"},
                                                               {'"', "&quot;"},
                                                               {'\'', "&#39;"}};
  std::string html;
  for (const char c : Plain(text)) {
    const auto entity =
        std::ranges::find(kEntities, c, &std::pair<char, const char*>::first);
    html += entity == std::end(kEntities) ? std::string(1, c) : entity->second;
  }
  return html;
}

std::string HtmlSentence(std::string_view text) {
  constexpr std::string_view kNoBreak = "\u00a0";
  std::string html = HtmlText(text);
  for (std::size_t i = 1; i + 1 < html.size(); ++i) {
    if (html[i] != ' ' || html[i - 1] < '0' || html[i - 1] > '9') continue;
    const std::string_view next = std::string_view(html).substr(i + 1);
    if (next.starts_with('%') || next.starts_with("µ") ||
        next.starts_with("°")) {
      html.replace(i, 1, kNoBreak);
    }
  }
  return html;
}

std::string HtmlName(std::string_view name) {
  return "<bdi>" + HtmlText(name) + "</bdi>";
}

std::string ScrolledTable(std::string_view label, const std::string& rows) {
  return "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"" +
         HtmlText(label) + "\"><table>" + rows + "</table></div>";
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
