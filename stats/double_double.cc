#include "stats/double_double.h"

#include <array>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace errmap::stats {
namespace {

constexpr DoubleDouble kLn2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};
constexpr DoubleDouble kHalfPi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
constexpr double kNegligible = 0x1p-110;

// Both at once: the reduction of the argument is the same.
struct SineCosine {
  DoubleDouble sine;
  DoubleDouble cosine;
};

// Taylor's series about 0 of the odd (sine) or even part, |x| <= pi/4.
DoubleDouble AlternatingSeries(const DoubleDouble& x, bool odd) {
  const DoubleDouble square = x * x;
  DoubleDouble term = odd ? x : DoubleDouble(1.0);
  DoubleDouble sum = term;
  double factor = odd ? 2.0 : 1.0;
  while (std::abs(term.hi) > kNegligible * std::abs(sum.hi)) {
    term *= -square / DoubleDouble(factor * (factor + 1.0));
    sum += term;
    factor += 2.0;
  }
  return sum;
}

SineCosine SinCos(const DoubleDouble& x) {
  if (!std::isfinite(x.hi)) {
    return {std::sin(x.hi), std::cos(x.hi)};
  }
  const double turns = std::nearbyint(x.hi / kHalfPi.hi);
  const DoubleDouble rest = x - kHalfPi * turns;
  const DoubleDouble sine = AlternatingSeries(rest, true);
  const DoubleDouble cosine = AlternatingSeries(rest, false);
  constexpr double kQuadrants = 4.0;
  switch (
      static_cast<int>(turns - kQuadrants * std::floor(turns / kQuadrants))) {
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    case 3:
      return {-cosine, sine};
    default:
      return {sine, cosine};
  }
}

// x 10^e, with e any integer.
DoubleDouble TimesPowerOfTen(DoubleDouble x, int e) {
  // The divisor must be finite where the quotient need not be 0.
  constexpr int kLeast = -300;
  if (e < kLeast)
    return TimesPowerOfTen(TimesPowerOfTen(x, kLeast), e - kLeast);
  DoubleDouble power = 1.0;
  DoubleDouble base = 10.0;
  for (int n = std::abs(e); n > 0; n /= 2, base *= base) {
    if (n % 2 == 1) power *= base;
  }
  return e < 0 ? x / power : x * power;
}

}  // namespace

DoubleDouble sqrt(const DoubleDouble& x) {
  const double root = std::sqrt(x.hi);
  if (!(root > 0.0) || !std::isfinite(root)) return root;
  // One step of Newton's method doubles the digits.
  const DoubleDouble error = x - internal::TwoProduct(root, root);
  return DoubleDouble(root) + error.hi / (2.0 * root);
}

DoubleDouble exp(const DoubleDouble& x) {
  constexpr double kLargest = 700.0;
  if (!(std::abs(x.hi) < kLargest)) return std::exp(x.hi);
  constexpr int kHalvings = 9;
  const double twos = std::nearbyint(x.hi / kLn2.hi);
  DoubleDouble rest = x - kLn2 * twos;
  rest *= std::ldexp(1.0, -kHalvings);
  // e^r - 1 by Taylor's series, then e^2r - 1 = (e^r - 1)^2 + 2 (e^r - 1):
  // without the 1, which would cost digits in every squaring.
  DoubleDouble sum = rest;
  DoubleDouble term = rest;
  for (double k = 2.0; std::abs(term.hi) > kNegligible * std::abs(sum.hi);
       k += 1.0) {
    term *= rest / DoubleDouble(k);
    sum += term;
  }
  for (int i = 0; i < kHalvings; ++i) sum = sum * sum + sum * 2.0;
  return (sum + 1.0) * std::ldexp(1.0, static_cast<int>(twos));
}

DoubleDouble log(const DoubleDouble& x) {
  const double first = std::log(x.hi);
  if (!std::isfinite(first)) return first;
  // log x = y + log(1 + z), z = x e^-y - 1 of about 1e-16.
  const DoubleDouble z = x * exp(DoubleDouble(-first)) - 1.0;
  return DoubleDouble(first) + (z - z * z * 0.5);
}

DoubleDouble sin(const DoubleDouble& x) { return SinCos(x).sine; }

DoubleDouble cos(const DoubleDouble& x) { return SinCos(x).cosine; }

DoubleDouble atan(const DoubleDouble& x) {
  const double first = std::atan(x.hi);
  if (!std::isfinite(x.hi)) return first;
  // atan x = y + atan((x - tan y) / (1 + x tan y)), the second of about 1e-16.
  const SineCosine y = SinCos(first);
  return DoubleDouble(first) +
         (x * y.cosine - y.sine) / (y.cosine + x * y.sine);
}

DoubleDouble pow(const DoubleDouble& x, const DoubleDouble& y) {
  const double rough = std::pow(x.hi, y.hi);
  if (!(x.hi > 0.0) || !std::isfinite(rough) || rough == 0.0) return rough;
  return exp(y * log(x));
}

DoubleDouble ParseDoubleDouble(std::string_view text) {
  const auto fail = [&]() -> DoubleDouble {
    throw std::invalid_argument("ParseDoubleDouble: '" + std::string(text) +
                                "' is not a decimal number");
  };
  const auto is_digit = [&](std::size_t i) {
    return i < text.size() &&
           std::isdigit(static_cast<unsigned char>(text[i])) != 0;
  };
  std::size_t at = 0;
  bool negative = false;
  if (at < text.size() && (text[at] == '-' || text[at] == '+')) {
    negative = text[at++] == '-';
  }
  DoubleDouble digits = 0.0;
  int exponent = 0;
  bool any = false;
  for (bool point = false;; ++at) {
    if (is_digit(at)) {
      digits = digits * 10.0 + static_cast<double>(text[at] - '0');
      if (point) --exponent;
      any = true;
    } else if (at < text.size() && text[at] == '.' && !point) {
      point = true;
    } else {
      break;
    }
  }
  if (!any) return fail();
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    ++at;
    int sign = 1;
    if (at < text.size() && (text[at] == '-' || text[at] == '+')) {
      sign = text[at++] == '-' ? -1 : 1;
    }
    if (!is_digit(at)) return fail();
    constexpr int kMostDigits = 4;
    int power = 0;
    for (int n = 0; is_digit(at); ++at, ++n) {
      if (n == kMostDigits) return fail();
      power = 10 * power + (text[at] - '0');
    }
    exponent += sign * power;
  }
  if (at != text.size()) return fail();
  const DoubleDouble value = TimesPowerOfTen(digits, exponent);
  return negative ? -value : value;
}

DoubleDouble DecimalOf(double x) {
  if (!std::isfinite(x)) return x;
  // Most data have few decimals. Of decimals with at most 15 digits no two
  // round to the same double, so one that rounds to x is the shortest.
  constexpr double kMost = 1e15;
  for (const double power : {1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6}) {
    const double digits = std::nearbyint(x * power);
    if (std::abs(digits) < kMost && digits / power == x) {
      // What a rounded division leaves is a double.
      return {x, std::fma(-x, power, digits) / power};
    }
  }
  // The longest is of the form -2.2250738585072014e-308.
  std::array<char, 32> buffer{};
  const auto [end, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), x);
  return ParseDoubleDouble({buffer.data(), end});
}

}  // namespace errmap::stats
