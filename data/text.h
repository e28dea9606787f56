#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace errmap::data {

/// Text without the blanks (spaces and tabs) at its ends.
std::string_view Trimmed(std::string_view text);

/// ASCII letters are compared without regard to case.
bool EqualsIgnoringCase(std::string_view a, std::string_view b);
bool StartsWithIgnoringCase(std::string_view text, std::string_view prefix);

/// The words of "one two", parted by single blanks; views into the text.
std::vector<std::string_view> SplitWords(std::string_view text);

/// Whether a word is among those of "one two", in any case.
bool IsOneOf(std::string_view word, std::string_view words);

/// Whether one of its characters is 0 to 9.
bool HasDigit(std::string_view text);

/// True, and the value in `value`, where the whole text is one finite decimal
/// number: an optional sign, a decimal point, an exponent; no hexadecimal, no
/// "inf" or "nan", nothing beyond the range of a double.
bool ParseNumber(std::string_view text, double* value);

/// Seconds of "30s", "90min", "2h", "1d" or a bare number; nothing where it is
/// none of them, or not above 0.
std::optional<double> ParseInterval(std::string_view text);

/// Text fit for a one-line message: control characters escaped, cut after
/// `limit` characters.
std::string Printable(std::string_view text, std::size_t limit);

/// A path at full length, fit for a one-line message.
std::string PrintablePath(std::string_view path);

/// Printable text of a cell, or name of a column, in single quotes.
std::string QuotedText(std::string_view text);
std::string QuotedName(std::string_view name);

/// "and 3 more" with `most` words and their `between` before it where there are
/// more than that; else JoinWords of all.
std::string ShortList(const std::vector<std::string>& words,
                      std::size_t most,
                      std::string_view between = ", ",
                      std::string_view before_more = " and ");

/// "x, y, z" of three words with ", " between them.
std::string JoinWords(const std::vector<std::string>& words,
                      std::string_view between);

/// The text as UTF-8. What is no valid UTF-8 is taken for Latin-1, as
/// spreadsheets of western Windows write it, so that a degree sign survives.
std::string AsUtf8(std::string_view text);

/// The candidate that `name` was probably meant to be (other case, or a few
/// letters amiss), or "".
std::string NearestName(std::string_view name,
                        const std::vector<std::string>& candidates);

/// The name of an enumerator by its place in `names`; "" beyond the last, as
/// for whoever asks each number for its name.
template <typename Names, typename Enumerator>
constexpr std::string_view NameOf(const Names& names, Enumerator value) {
  const auto place = static_cast<std::size_t>(value);
  return place < names.size() ? names[place] : std::string_view();
}

}  // namespace errmap::data
