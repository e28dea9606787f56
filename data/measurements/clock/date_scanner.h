#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>

#include "data/text.h"

namespace errmap::data {

/// Reads parts of a date or a time from the front of a text.
class DateScanner {
 public:
  explicit DateScanner(std::string_view text) : rest_(text) {}

  bool done() const { return rest_.empty(); }

  bool Take(char c) {
    if (!rest_.starts_with(c)) return false;
    rest_.remove_prefix(1);
    return true;
  }

  bool TakeIgnoringCase(std::string_view word) {
    if (!StartsWithIgnoringCase(rest_, word)) return false;
    rest_.remove_prefix(word.size());
    return true;
  }

  // Also those that do not break a line, as Windows writes before AM and PM.
  void TakeBlanks() {
    while (Take(' ') || TakeIgnoringCase("\u00a0") ||
           TakeIgnoringCase("\u202f")) {
    }
  }

  // Of the characters of `some`; nothing where another comes next.
  std::optional<char> TakeOneOf(std::string_view some) {
    if (done() || some.find(rest_.front()) == std::string_view::npos) {
      return std::nullopt;
    }
    const char taken = rest_.front();
    rest_.remove_prefix(1);
    return taken;
  }

  struct Number {
    int value = 0;
    std::size_t digits = 0;
  };
  // Of one to `most` digits.
  std::optional<Number> TakeNumber(std::size_t most) {
    Number number;
    while (number.digits < most && !done() && IsDigit(rest_.front())) {
      number.value = 10 * number.value + (rest_.front() - '0');
      ++number.digits;
      rest_.remove_prefix(1);
    }
    return number.digits > 0 ? std::optional(number) : std::nullopt;
  }

  // Of letters; those of other alphabets are bytes above 0x7F.
  std::string_view TakeWord() {
    std::size_t size = 0;
    while (size < rest_.size() && IsLetter(rest_[size])) ++size;
    const std::string_view word = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return word;
  }

  // Whether a word is the next but for points, blanks and dashes.
  bool WordIsNear() const {
    const std::size_t at = rest_.find_first_not_of(". -/");
    return at != std::string_view::npos && IsLetter(rest_[at]) &&
           rest_.find_first_of("0123456789", at) > at + 2;
  }

  bool AtDigit() const { return !done() && IsDigit(rest_.front()); }

  // Exactly two digits, at most `most`.
  std::optional<int> TakePair(int most) {
    const auto number = TakeNumber(2);
    if (!number || number->digits != 2 || number->value > most) {
      return std::nullopt;
    }
    return number->value;
  }

  // Whether the last fraction was there, be it 0.
  bool TookPoint() const { return took_point_; }

  // Of a point or comma and digits, or a colon and three of them, as some
  // loggers write milliseconds; 0 if there is none.
  double TakeFraction() {
    constexpr std::size_t kMilliseconds = 4;  // with the colon
    const bool after_colon = rest_.starts_with(':') &&
                             std::min(rest_.find_first_not_of("0123456789", 1),
                                      rest_.size()) == kMilliseconds;
    const bool before_digit = rest_.size() > 1 && IsDigit(rest_[1]);
    took_point_ =
        before_digit && TakeOneOf(after_colon ? ":" : ".,").has_value();
    if (!took_point_) return 0.0;
    double value = 0.0;
    double place = 1.0;
    while (!done() && IsDigit(rest_.front())) {
      value = 10.0 * value + (rest_.front() - '0');
      place *= 10.0;
      rest_.remove_prefix(1);
    }
    return value / place;
  }

 private:
  static bool IsLetter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           static_cast<unsigned char>(c) > 0x7FU;
  }

  std::string_view rest_;
  bool took_point_ = false;
};

}  // namespace errmap::data
