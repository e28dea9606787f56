#include "data/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>
#include <system_error>

namespace errmap::data {
namespace {

constexpr std::size_t kCellLimit = 40;
constexpr std::size_t kNameLimit = 80;

char Lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool IsContinuation(unsigned char byte) { return (byte & 0xC0U) == 0x80U; }

std::string Escaped(unsigned char byte) {
  switch (byte) {
    case '\n':
      return "\\n";
    case '\r':
      return "\\r";
    case '\t':
      return "\\t";
    default: {
      constexpr std::string_view kDigits = "0123456789abcdef";
      return {'\\', 'x', kDigits[byte >> 4U], kDigits[byte & 0xFU]};
    }
  }
}

// Letters inserted, left out, replaced, or neighbours swapped, from a to b
// (Damerau 1964, each letter edited once), row by row of the usual table.
std::size_t EditDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::vector<std::size_t> above = row;
  std::vector<std::size_t> two_above = row;
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    two_above.swap(above);
    above.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({above[j] + 1,
                         row[j - 1] + 1,
                         above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], two_above[j - 2] + 1);
      }
    }
  }
  return row.back();
}

}  // namespace

std::size_t Utf8Length(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) {
    return i + k < text.size() ? static_cast<unsigned char>(text[i + k])
                               : static_cast<unsigned char>(0);
  };
  const unsigned char first = byte(0);
  if (first < 0x80U) return 1;
  if (first < 0xC2U || first > 0xF4U) return 0;
  if (!IsContinuation(byte(1))) return 0;
  if (first < 0xE0U) return 2;
  if (!IsContinuation(byte(2))) return 0;
  if (first < 0xF0U) {
    if (first == 0xE0U && byte(1) < 0xA0U) return 0;
    if (first == 0xEDU && byte(1) > 0x9FU) return 0;
    return 3;
  }
  if (!IsContinuation(byte(3))) return 0;
  if (first == 0xF0U && byte(1) < 0x90U) return 0;
  if (first == 0xF4U && byte(1) > 0x8FU) return 0;
  return 4;
}

std::string_view Trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

bool EqualsIgnoringCase(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return Lower(x) == Lower(y);
  });
}

bool StartsWithIgnoringCase(std::string_view text, std::string_view prefix) {
  return text.size() >= prefix.size() &&
         EqualsIgnoringCase(text.substr(0, prefix.size()), prefix);
}

bool EndsWithIgnoringCase(std::string_view text, std::string_view ending) {
  return text.size() >= ending.size() &&
         EqualsIgnoringCase(text.substr(text.size() - ending.size()), ending);
}

std::string LowerCase(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(), Lower);
  return lower;
}

std::vector<std::string_view> SplitWords(std::string_view text,
                                         std::string_view between) {
  std::vector<std::string_view> words;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(between), text.size());
    words.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

bool IsOneOf(std::string_view word, std::string_view words) {
  while (!words.empty()) {
    const std::size_t blank = std::min(words.find(' '), words.size());
    if (EqualsIgnoringCase(word, words.substr(0, blank))) return true;
    words.remove_prefix(std::min(blank + 1, words.size()));
  }
  return false;
}

bool HasDigit(std::string_view text) {
  return text.find_first_of("0123456789") != text.npos;
}

bool ParseNumber(std::string_view text, double* value) {
  // from_chars takes no plus sign, but would take the minus of "+-1".
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return false;
  }
  const char* const end = text.data() + text.size();
  double parsed = 0.0;
  const auto [stop, error] = std::from_chars(text.data(), end, parsed);
  if (error != std::errc() || stop != end || !std::isfinite(parsed)) {
    return false;
  }
  *value = parsed;
  return true;
}

std::optional<double> ParseInterval(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, double>, 5> kSecondsOf = {
      {{"s", 1.0}, {"min", 60.0}, {"h", 3600.0}, {"d", 86400.0}, {"", 1.0}}};
  const std::size_t end = text.find_last_of("0123456789.") + 1;
  double number = 0.0;
  if (!ParseNumber(text.substr(0, end), &number) || !(number > 0.0)) {
    return std::nullopt;
  }
  for (const auto& [unit, seconds] : kSecondsOf) {
    if (text.substr(end) == unit) return number * seconds;
  }
  return std::nullopt;
}

std::string Printable(std::string_view text, std::size_t limit) {
  std::string printable;
  std::size_t count = 0;
  for (std::size_t i = 0; i < text.size(); ++count) {
    if (count == limit) return printable + "...";
    const auto byte = static_cast<unsigned char>(text[i]);
    const std::size_t length = Utf8Length(text, i);
    // U+0080 to U+009F command some terminals just as the C0 controls do.
    const bool c1_control = length == 2 && byte == 0xC2U &&
                            static_cast<unsigned char>(text[i + 1]) < 0xA0U;
    if (length == 0 || byte < 0x20U || byte == 0x7FU) {
      printable += Escaped(byte);
      ++i;
    } else if (c1_control) {
      printable += Escaped(static_cast<unsigned char>(text[i + 1]));
      i += length;
    } else {
      printable += text.substr(i, length);
      i += length;
    }
  }
  return printable;
}

std::string PrintablePath(std::string_view path) {
  return Printable(path, std::string_view::npos);
}

std::string QuotedText(std::string_view text) {
  return "'" + Printable(text, kCellLimit) + "'";
}

std::string QuotedName(std::string_view name) {
  return "'" + Printable(name, kNameLimit) + "'";
}

std::string CountText(std::size_t count, std::string_view what) {
  return std::to_string(count) + " " + std::string(what) +
         (count == 1 ? "" : "s");
}

std::string AsUtf8(std::string_view text) {
  std::size_t i = 0;
  while (i < text.size()) {
    const std::size_t length = Utf8Length(text, i);
    if (length == 0) break;
    i += length;
  }
  if (i == text.size()) return std::string(text);
  // What Windows has where Latin-1 has control characters.
  constexpr auto kOfWindows = std::to_array<std::string_view>(
      {"€", "�", "‚", "ƒ", "„", "…", "†", "‡", "ˆ", "‰", "Š",
       "‹", "Œ", "�", "Ž", "�", "�", "‘", "’", "“", "”", "•",
       "–", "—", "˜", "™", "š", "›", "œ", "�", "ž", "Ÿ"});
  std::string utf8;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80U) {
      utf8 += c;
    } else if (byte < 0xA0U) {
      utf8 += kOfWindows[byte - 0x80U];
    } else {
      utf8 += static_cast<char>(0xC0U | (byte >> 6U));
      utf8 += static_cast<char>(0x80U | (byte & 0x3FU));
    }
  }
  return utf8;
}

std::string JoinWords(const std::vector<std::string>& words,
                      std::string_view between) {
  std::string text;
  for (const std::string& word : words) {
    if (&word != words.data()) text += between;
    text += word;
  }
  return text;
}

std::string ShortList(const std::vector<std::string>& words,
                      std::size_t most,
                      std::string_view between,
                      std::string_view before_more) {
  if (words.size() <= most) return JoinWords(words, between);
  const auto end = words.begin() + static_cast<std::ptrdiff_t>(most);
  return JoinWords({words.begin(), end}, between) + std::string(before_more) +
         std::to_string(words.size() - most) + " more";
}

std::string NearestName(std::string_view name,
                        const std::vector<std::string>& candidates) {
  constexpr std::size_t kMaxDistance = 2;
  // The table of distances grows with the square of the length.
  constexpr std::size_t kMaxLength = 200;
  std::string nearest;
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (const std::string& candidate : candidates) {
    if (EqualsIgnoringCase(name, candidate)) return candidate;
    const auto [shorter, longer] = std::minmax({name.size(), candidate.size()});
    if (longer > kMaxLength || longer - shorter > kMaxDistance) continue;
    const std::size_t distance = EditDistance(name, candidate);
    // Half the letters must be right: "t1" is not a slip for "ab".
    if (distance <= kMaxDistance && 2 * distance < shorter + 1 &&
        distance < least) {
      least = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string DidYouMean(std::string_view name,
                       const std::vector<std::string>& candidates) {
  const std::string nearest = NearestName(name, candidates);
  return nearest.empty() ? "" : "did you mean '" + nearest + "'? ";
}

std::string Rounded(double value) {
  const double size = std::abs(value);
  const bool is_whole = size >= 100.0 && size < 1e6;
  std::array<char, 32> digits{};
  const auto [end, error] = std::to_chars(
      digits.begin(),
      digits.end(),
      value,
      is_whole ? std::chars_format::fixed : std::chars_format::general,
      is_whole ? 0 : 3);
  return {digits.data(), end};
}

}  // namespace errmap::data
