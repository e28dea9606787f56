#include "cli/report/wrap_text.h"

#include <algorithm>

namespace errmap::report {
namespace {

bool Continues(char c) {
  constexpr unsigned kMask = 0xC0U;
  constexpr unsigned kContinuation = 0x80U;
  return (static_cast<unsigned char>(c) & kMask) == kContinuation;
}

// Bytes of the first `most` characters.
std::size_t BytesOf(std::string_view text, std::size_t most) {
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < most && bytes < text.size(); ++i) {
    do {
      ++bytes;
    } while (bytes < text.size() && Continues(text[bytes]));
  }
  return bytes;
}

// Whether the word is a number, which a unit may follow: "(11.481", "92".
bool EndsInDigit(std::string_view word) {
  return !word.empty() && word.back() >= '0' && word.back() <= '9';
}

// "%", "um)." and the like: what no line begins with.
bool IsUnit(std::string_view word) {
  while (!word.empty() && std::string_view(".,;:)").find(word.back()) !=
                              std::string_view::npos) {
    word.remove_suffix(1);
  }
  return word == "%" || word == "um" || word == "urad" || word == "arcsec";
}

}  // namespace

std::size_t WidthOf(std::string_view text) {
  return text.size() -
         static_cast<std::size_t>(std::ranges::count_if(text, Continues));
}

std::vector<std::string> WrapLines(std::string_view text,
                                   std::size_t width,
                                   LongWords long_words) {
  width = std::max<std::size_t>(width, 1);
  std::vector<std::string> lines;
  std::string line;
  while (!text.empty()) {
    std::string_view word = text.substr(0, text.find(' '));
    if (EndsInDigit(word) && word.size() < text.size()) {
      const std::string_view rest = text.substr(word.size() + 1);
      const std::string_view next = rest.substr(0, rest.find(' '));
      if (IsUnit(next) && WidthOf(word) + 1 + WidthOf(next) <= width) {
        word = text.substr(0, word.size() + 1 + next.size());
      }
    }
    text.remove_prefix(std::min(word.size() + 1, text.size()));
    if (word.empty()) continue;
    if (!line.empty() && WidthOf(line) + 1 + WidthOf(word) > width) {
      lines.push_back(std::move(line));
      line.clear();
    }
    while (long_words == LongWords::kBroken && WidthOf(word) > width) {
      const std::size_t bytes = BytesOf(word, width);
      lines.emplace_back(word.substr(0, bytes));
      word.remove_prefix(bytes);
    }
    if (!line.empty()) line += ' ';
    line += word;
  }
  if (!line.empty()) lines.push_back(std::move(line));
  return lines;
}

std::string WrapText(std::string_view text, std::size_t width) {
  std::string wrapped;
  for (const std::string& line : WrapLines(text, width)) {
    wrapped += (wrapped.empty() ? "" : "\n") + line;
  }
  return wrapped;
}

std::string Hanging(std::string begin,
                    std::string_view text,
                    std::size_t width) {
  const std::size_t indent = WidthOf(begin);
  std::string hanging;
  for (const std::string& line : WrapLines(text, width - indent)) {
    hanging += begin + line + "\n";
    begin.assign(indent, ' ');
  }
  return hanging;
}

std::string Squeezed(const std::string& text,
                     std::size_t most,
                     std::string_view dots) {
  const std::size_t width = WidthOf(dots);
  const std::size_t all = WidthOf(text);
  if (all <= most) return text;
  if (most <= width) return text.substr(0, BytesOf(text, most));
  const std::size_t tail = (most - width) / 2;
  const std::size_t head = most - width - tail;
  return text.substr(0, BytesOf(text, head))
      .append(dots)
      .append(text.substr(BytesOf(text, all - tail)));
}

}  // namespace errmap::report
