#pragma once

#include <cstddef>
#include <string>

namespace errmap::stats {

/// Standard normal distribution function. Relative error: a few units in the
/// last place in both tails.
double NormalCdf(double z);

/// log of NormalCdf, finite for every finite z. Uses an asymptotic series if
/// the probability itself underflows.
double LogNormalCdf(double z);

/// z with NormalCdf(z) = p, 0 < p < 1.
double NormalQuantile(double p);

/// P(|Z| >= |z|), Z standard normal.
double NormalTwoSided(double z);

/// P(X >= x) for chi-squared with `degrees_of_freedom` > 0; 1 for x <= 0.
double ChiSquaredUpperTail(double x, double degrees_of_freedom);

/// x with P(X <= x) = p, 0 < p < 1, for chi-squared with `degrees_of_freedom`
/// > 0.
double ChiSquaredQuantile(double p, double degrees_of_freedom);

/// P(X >= x) for Fisher's F with these degrees of freedom > 0; 1 for x <= 0.
double FUpperTail(double x, double numerator, double denominator);

/// P(|T| >= |t|) for Student's t with `degrees_of_freedom` > 0.
double StudentTwoSided(double t, double degrees_of_freedom);

/// t with P(T <= t) = p, 0 < p < 1, for Student's t with `degrees_of_freedom`
/// > 0.
double StudentQuantile(double p, double degrees_of_freedom);

/// log n! for n >= 0.
long double LogFactorial(std::ptrdiff_t n);

/// Version of Boost, which computes these functions: "1.74.0".
std::string BoostVersion();

}  // namespace errmap::stats
