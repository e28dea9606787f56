#include "cli/turning_centre/portable_math.h"

#include <cassert>
#include <cmath>

namespace errmap::turning_centre {
namespace {

constexpr double kTwoPi = 6.283185307179586476925;
constexpr double kLog2 = 0.693147180559945309417;
constexpr double kSqrtHalf = 0.707106781186547524401;

}  // namespace

double SinOfTurns(double turns) {
  // To the nearest half turn, where the sine changes its sign: |r| <= 1/4.
  const double half_turns = std::floor(2.0 * turns + 0.5);
  const double r = turns - 0.5 * half_turns;
  const bool odd = half_turns != 2.0 * std::floor(0.5 * half_turns);
  // Taylor's series to the power 21; the next term is below 1.3e-18.
  const double x = kTwoPi * r;
  const double x2 = x * x;
  double sum = 0.0;
  for (int k = 20; k >= 2; k -= 2) {
    sum = -x2 / (k * (k + 1.0)) * (1.0 + sum);
  }
  const double sine = x + x * sum;
  return odd ? -sine : sine;
}

double CosOfTurns(double turns) { return SinOfTurns(turns + 0.25); }

double PortableLog(double x) {
  assert(std::isnormal(x) && x > 0.0);
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);
  if (mantissa < kSqrtHalf) {
    mantissa *= 2.0;
    --exponent;
  }
  // log m = 2 artanh s, s = (m - 1) / (m + 1), |s| < 0.172; the series to the
  // power 23 leaves less than 1e-20.
  const double s = (mantissa - 1.0) / (mantissa + 1.0);
  const double s2 = s * s;
  double sum = 0.0;
  for (int k = 23; k >= 3; k -= 2) sum = s2 * (1.0 / k + sum);
  return exponent * kLog2 + 2.0 * (s + s * sum);
}

}  // namespace errmap::turning_centre
