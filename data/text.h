#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace errmap::data {

/// Returns the text without the blanks (spaces and tabs) at its ends.
std::string_view Trimmed(std::string_view text);

/// Compares texts, ignoring the case of ASCII letters.
bool EqualsIgnoringCase(std::string_view a, std::string_view b);
bool StartsWithIgnoringCase(std::string_view text, std::string_view prefix);
bool EndsWithIgnoringCase(std::string_view text, std::string_view ending);
/// Returns the text with its ASCII letters in lower case.
std::string LowerCase(std::string_view text);

/// Returns the words of "one two", separated by single blanks or other
/// characters `between`; views into the text.
std::vector<std::string_view> SplitWords(std::string_view text,
                                         std::string_view between = " ");

/// True if a word is among those of "one two", in any case.
bool IsOneOf(std::string_view word, std::string_view words);

constexpr bool IsDigit(char c) { return c >= '0' && c <= '9'; }
/// True if one of its characters is 0 to 9.
bool HasDigit(std::string_view text);

/// Returns true, with the value in `value`, if the whole text is one finite
/// decimal number. It may have a sign, a decimal point and an exponent. It may
/// not be hexadecimal, "inf", "nan" or beyond the range of a double.
bool ParseNumber(std::string_view text, double* value);

/// Returns the seconds of "30s", "90min", "2h", "1d" or a bare number; nothing
/// for other text, or if not above 0.
std::optional<double> ParseInterval(std::string_view text);

/// Returns the number of bytes of the UTF-8 character at `text[i]`, or 0 if
/// there is none. Refuses overlong forms, surrogates and values beyond
/// U+10FFFF.
std::size_t Utf8Length(std::string_view text, std::size_t i);

/// Returns text for a one-line message, with control characters escaped, cut
/// after `limit` characters.
std::string Printable(std::string_view text,
                      std::size_t limit = std::string_view::npos);

/// Returns a path at full length for a one-line message.
std::string PrintablePath(std::string_view path);

/// Returns the printable text of a cell, or the name of a column, in single
/// quotes.
std::string QuotedText(std::string_view text);
std::string QuotedName(std::string_view name);

/// Returns "1 row" or "3 rows".
std::string CountText(std::size_t count, std::string_view what);

/// Joins words with `between`. If there are more than `most`, "and 3 more"
/// replaces the rest.
std::string ShortList(const std::vector<std::string>& words,
                      std::size_t most,
                      std::string_view between = ", ",
                      std::string_view before_more = " and ");

/// Returns "x, y, z" for three words with ", " between them.
std::string JoinWords(const std::vector<std::string>& words,
                      std::string_view between);

/// Returns the text as UTF-8. Text that is not valid UTF-8 is read as Windows
/// 1252, the encoding of spreadsheets on western Windows, so that a degree sign
/// survives.
std::string AsUtf8(std::string_view text);

/// "did you mean 'compare'? ", or "" if no candidate is near (NearestName).
std::string DidYouMean(std::string_view name,
                       const std::vector<std::string>& candidates);

/// Returns the candidate that `name` was probably meant to be (other case, or a
/// few wrong letters), or "".
std::string NearestName(std::string_view name,
                        const std::vector<std::string>& candidates);

/// Returns the name of an enumerator by its index in `names`. Returns "" beyond
/// the last, so that callers can loop over all.
template <typename Names, typename Enumerator>
constexpr std::string_view NameOf(const Names& names, Enumerator value) {
  const auto place = static_cast<std::size_t>(value);
  return place < names.size() ? names[place] : std::string_view();
}

/// Rounds to three digits, and from 100 to a million to the next whole number.
std::string Rounded(double value);

}  // namespace errmap::data
