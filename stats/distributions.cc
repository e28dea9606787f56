#include "stats/distributions.h"

#include <cmath>
#include <limits>
#include <math.h>  // lgammal_r
#include <numbers>

#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <boost/version.hpp>

#include "stats/not_a_number.h"

namespace errmap::stats {
namespace {

namespace policies = boost::math::policies;

// Double is enough inside too, and several times as fast as long double.
// Overflow and underflow are limits here, not errors.
using Policy =
    policies::policy<policies::promote_double<false>,
                     policies::overflow_error<policies::ignore_error>,
                     policies::underflow_error<policies::ignore_error>>;

}  // namespace

double NormalCdf(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

double LogNormalCdf(double z) {
  // Below this the tail is close to where doubles end (at z = -38.5).
  constexpr double kSeriesBelow = -30.0;
  if (!(z < kSeriesBelow)) return std::log(NormalCdf(z));
  // Abramowitz & Stegun 26.2.12: phi(z)/|z| (1 - 1/z^2 + 3/z^4 - 15/z^6 ...).
  const double inverse = 1.0 / (z * z);
  const double series =
      -inverse * (1.0 - inverse * (3.0 - inverse * (15.0 - inverse * 105.0)));
  return -0.5 * z * z - std::log(-z * std::sqrt(2.0 * std::numbers::pi)) +
         std::log1p(series);
}

double NormalQuantile(double p) {
  if (!(p > 0.0)) {
    return p == 0.0 ? -std::numeric_limits<double>::infinity() : kNaN;
  }
  return -std::numbers::sqrt2 * boost::math::erfc_inv(2.0 * p, Policy());
}

double NormalTwoSided(double z) {
  return std::erfc(std::abs(z) / std::numbers::sqrt2);
}

double ChiSquaredUpperTail(double x, double degrees_of_freedom) {
  if (std::isnan(x)) return x;
  if (x <= 0.0) return 1.0;
  if (std::isinf(x)) return 0.0;
  return boost::math::gamma_q(0.5 * degrees_of_freedom, 0.5 * x, Policy());
}

double ChiSquaredQuantile(double p, double degrees_of_freedom) {
  return 2.0 * boost::math::gamma_p_inv(0.5 * degrees_of_freedom, p, Policy());
}

double FUpperTail(double x, double numerator, double denominator) {
  if (std::isnan(x)) return x;
  if (x <= 0.0) return 1.0;
  if (std::isinf(x)) return 0.0;
  return boost::math::ibeta(0.5 * denominator,
                            0.5 * numerator,
                            denominator / (denominator + numerator * x),
                            Policy());
}

double StudentTwoSided(double t, double degrees_of_freedom) {
  return FUpperTail(t * t, 1.0, degrees_of_freedom);
}

double StudentQuantile(double p, double degrees_of_freedom) {
  return boost::math::quantile(
      boost::math::students_t_distribution<double, Policy>(degrees_of_freedom),
      p);
}

long double LogFactorial(std::ptrdiff_t n) {
  // std::lgamma leaves the sign in a variable of all threads: a race.
  int sign = 0;
  return ::lgammal_r(static_cast<long double>(n) + 1.0L, &sign);
}

std::string BoostVersion() {
  constexpr int kMajor = BOOST_VERSION / 100000;
  constexpr int kMinor = BOOST_VERSION / 100 % 1000;
  constexpr int kPatch = BOOST_VERSION % 100;
  return std::to_string(kMajor) + "." + std::to_string(kMinor) + "." +
         std::to_string(kPatch);
}

}  // namespace errmap::stats
