#pragma once

#include <cmath>
#include <limits>
#include <string_view>

#include "stats/eigen.h"

namespace errmap::stats {

/// A number as the unevaluated sum hi + lo of two doubles, |lo| at most half a
/// unit in the last place of hi: 106 bits, the range of double.
///
/// Addition by Knuth, multiplication by Dekker, results renormalised (Hida, Li
/// & Bailey, ARITH-15, 2001). Relative error: a few 2^-104. Relies on exact
/// rounding of every operation: no -ffast-math, no contraction. Usable as an
/// Eigen scalar.
struct DoubleDouble {
  double hi = 0.0;
  double lo = 0.0;

  constexpr DoubleDouble() = default;
  // Implicit, as from int to double: formulas mix both types.
  constexpr DoubleDouble(double value) : hi(value) {}
  constexpr DoubleDouble(double high, double low) : hi(high), lo(low) {}

  explicit constexpr operator double() const { return hi; }

  DoubleDouble& operator+=(const DoubleDouble& other);
  DoubleDouble& operator-=(const DoubleDouble& other);
  DoubleDouble& operator*=(const DoubleDouble& other);
  DoubleDouble& operator/=(const DoubleDouble& other);
};

/// Bits of the significands of double and DoubleDouble.
inline constexpr int kDoubleBits = std::numeric_limits<double>::digits;
inline constexpr int kDoubleDoubleBits = 2 * kDoubleBits;

namespace internal {

// a + b exactly.
inline DoubleDouble TwoSum(double a, double b) {
  const double sum = a + b;
  const double part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

// a + b exactly if |a| >= |b|.
inline DoubleDouble QuickTwoSum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

// a b exactly, unless it overflows or underflows.
inline DoubleDouble TwoProduct(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

}  // namespace internal

inline DoubleDouble operator-(const DoubleDouble& a) { return {-a.hi, -a.lo}; }

inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  DoubleDouble high = internal::TwoSum(a.hi, b.hi);
  // Without this, inf - inf in the error term would turn an infinity into NaN.
  if (!std::isfinite(high.hi)) return high.hi;
  const DoubleDouble low = internal::TwoSum(a.lo, b.lo);
  high = internal::QuickTwoSum(high.hi, high.lo + low.hi);
  return internal::QuickTwoSum(high.hi, high.lo + low.lo);
}

inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
  return a + -b;
}

inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble high = internal::TwoProduct(a.hi, b.hi);
  if (!std::isfinite(high.hi)) return high.hi;
  return internal::QuickTwoSum(high.hi, high.lo + (a.hi * b.lo + a.lo * b.hi));
}

inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const double first = a.hi / b.hi;
  if (!std::isfinite(first) || !std::isfinite(b.hi)) return first;
  DoubleDouble rest = a - b * first;
  const double second = rest.hi / b.hi;
  rest -= b * second;
  return DoubleDouble(internal::QuickTwoSum(first, second)) + rest.hi / b.hi;
}

inline DoubleDouble& DoubleDouble::operator+=(const DoubleDouble& other) {
  return *this = *this + other;
}
inline DoubleDouble& DoubleDouble::operator-=(const DoubleDouble& other) {
  return *this = *this - other;
}
inline DoubleDouble& DoubleDouble::operator*=(const DoubleDouble& other) {
  return *this = *this * other;
}
inline DoubleDouble& DoubleDouble::operator/=(const DoubleDouble& other) {
  return *this = *this / other;
}

inline bool operator==(const DoubleDouble& a, const DoubleDouble& b) {
  return a.hi == b.hi && a.lo == b.lo;
}
inline bool operator<(const DoubleDouble& a, const DoubleDouble& b) {
  return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
}
inline bool operator>(const DoubleDouble& a, const DoubleDouble& b) {
  return b < a;
}
inline bool operator<=(const DoubleDouble& a, const DoubleDouble& b) {
  return a < b || a == b;
}
inline bool operator>=(const DoubleDouble& a, const DoubleDouble& b) {
  return b <= a;
}

// Found by argument-dependent lookup after "using std::exp" and by Eigen, hence
// not in CamelCase. Outside a function's domain the result is that of <cmath>
// for hi.
DoubleDouble sqrt(const DoubleDouble& x);
DoubleDouble exp(const DoubleDouble& x);
DoubleDouble log(const DoubleDouble& x);
DoubleDouble sin(const DoubleDouble& x);
DoubleDouble cos(const DoubleDouble& x);
DoubleDouble atan(const DoubleDouble& x);
DoubleDouble pow(const DoubleDouble& x, const DoubleDouble& y);
inline DoubleDouble abs(const DoubleDouble& x) { return x.hi < 0.0 ? -x : x; }
inline DoubleDouble abs2(const DoubleDouble& x) { return x * x; }
inline bool isfinite(const DoubleDouble& x) { return std::isfinite(x.hi); }

/// Returns the number written in a decimal text such as "-1.25E-03", to 106
/// bits instead of the nearest double. Throws std::invalid_argument if `text`
/// is not a decimal number.
DoubleDouble ParseDoubleDouble(std::string_view text);

/// Returns, to 106 bits, the shortest decimal that reads back as `x`: the
/// number in the file from which `x` was read. It is at most half a unit in the
/// last place from `x`. Returns `x` itself if it is not finite.
DoubleDouble DecimalOf(double x);

}  // namespace errmap::stats

namespace Eigen {

template <>
struct NumTraits<errmap::stats::DoubleDouble>
    : GenericNumTraits<errmap::stats::DoubleDouble> {
  using Real = errmap::stats::DoubleDouble;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = double;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 2,
    AddCost = 20,
    MulCost = 10
  };
  static Real epsilon() { return 0x1p-104; }
  static Real dummy_precision() { return 0x1p-90; }
  static Real highest() { return std::numeric_limits<double>::max(); }
  static Real lowest() { return std::numeric_limits<double>::lowest(); }
  static int digits10() { return 31; }
};

}  // namespace Eigen
