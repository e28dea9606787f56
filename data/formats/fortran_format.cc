#include "data/formats/fortran_format.h"

#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

namespace errmap::data {
namespace {

std::string RightAligned(const std::string& text, int width) {
  return fmt::format("{:>{}}", text, width);
}

std::string NotFinite(double value) {
  if (std::isnan(value)) return "NaN";
  return value < 0 ? "-Infinity" : "Infinity";
}

// Digits and exponent of a finite value: |value| = 0.DIGITS * 10^exponent.
struct Decimal {
  bool negative = false;
  std::string digits;
  int exponent = 0;
};

Decimal RoundedTo(int digits, double value) {
  const std::string text = fmt::format("{:.{}e}", std::abs(value), digits - 1);
  const std::size_t e = text.find('e');
  Decimal decimal{.negative = std::signbit(value),
                  .digits = text.substr(0, 1),
                  .exponent = std::atoi(text.c_str() + e + 1) + 1};
  if (e > 2) decimal.digits += text.substr(2, e - 2);
  if (value == 0.0) decimal.exponent = 0;
  return decimal;
}

// "E+01", "E-002", "-120".
std::string Exponent(int exponent, int exponent_digits) {
  std::string text = std::to_string(std::abs(exponent));
  const auto wanted = static_cast<std::size_t>(exponent_digits);
  const bool has_room = text.size() <= wanted;
  if (has_room) text.insert(0, wanted - text.size(), '0');
  return (has_room ? "E" : "") + std::string(exponent < 0 ? "-" : "+") + text;
}

// Significant digits with `before` of them before the point.
std::string Scientific(
    double value, int width, int significant, int before, int exponent_digits) {
  if (!std::isfinite(value)) return RightAligned(NotFinite(value), width);
  Decimal decimal = RoundedTo(significant, value);
  const auto at = static_cast<std::size_t>(before);
  const std::string whole = before == 0 ? "0" : decimal.digits.substr(0, at);
  const int exponent = value == 0.0 ? 0 : decimal.exponent - before;
  return RightAligned((decimal.negative ? "-" : "") + whole + "." +
                          decimal.digits.substr(at) +
                          Exponent(exponent, exponent_digits),
                      width);
}

// Gw.d with `before` digits before the point where it is of the form E.
std::string General(
    double value, int width, int significant, int before, int exponent_digits) {
  if (!std::isfinite(value)) return RightAligned(NotFinite(value), width);
  const int exponent = RoundedTo(significant, value).exponent;
  if (value != 0.0 && (exponent < 0 || exponent > significant)) {
    return Scientific(value, width, significant, before, exponent_digits);
  }
  const int behind = exponent_digits + 2;
  const int decimals = value == 0.0 ? significant - 1 : significant - exponent;
  return EditF(value, width - behind, decimals) +
         std::string(static_cast<std::size_t>(behind), ' ');
}

}  // namespace

std::string EditI(long long value, int width) {
  return RightAligned(std::to_string(value), width);
}

std::string EditF(double value, int width, int decimals) {
  if (!std::isfinite(value)) return RightAligned(NotFinite(value), width);
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (decimals == 0) text += '.';
  return RightAligned(text, width);
}

std::string EditE(double value, int width, int digits) {
  return Scientific(value, width, digits, 0, 2);
}

std::string Edit1PE(double value, int width, int digits) {
  return Scientific(value, width, digits + 1, 1, 2);
}

std::string EditG(double value, int width, int digits) {
  return General(value, width, digits, 0, 2);
}

std::string ListDirected(float value) {
  constexpr int kWidth = 17;
  constexpr int kDigits = 9;
  return General(static_cast<double>(value), kWidth, kDigits, 1, 2);
}

std::string ListDirected(double value) {
  constexpr int kWidth = 26;
  constexpr int kDigits = 17;
  return General(value, kWidth, kDigits, 1, 3);
}

std::string ListDirected(long long value) {
  constexpr int kWidth = 12;
  return EditI(value, kWidth);
}

}  // namespace errmap::data
