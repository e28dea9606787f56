#pragma once

#include "stats/normality/ordered_sample.h"
#include "stats/test_result.h"

namespace errmap::stats {

/// Moments of a sample about its mean, divisor n throughout (the biased,
/// "population" definitions: g1 and b2 of most programs by default).
struct ShapeMoments {
  double skewness = 0.0;  // m3 / m2^1.5
  double kurtosis = 0.0;  // m4 / m2^2: 3 for a normal distribution
};

/// Returns the moments of a sample with at least 2 different values.
ShapeMoments ComputeShapeMoments(const OrderedSample& sample);

/// Anderson-Darling test: A^2 from the normal with the sample's own mean and
/// sd, by the NIST/SEMATECH e-Handbook (1.3.5.14): A^2 = -n - sum_i (2i -
/// 1)/n [ln F(z_i) + ln(1 - F(z_(n+1-i)))]. p is from A^2 (1 + 0.75/n +
/// 2.25/n^2), after Stephens (in D'Agostino & Stephens, Goodness-of-Fit
/// Techniques, 1986, Table 4.9), mean and sd estimated; never below 3.7e-24.
/// Needs n >= 8.
TestResult AndersonDarling(const OrderedSample& sample);

/// Jarque & Bera (1987): n/6 (skewness^2 + (kurtosis - 3)^2 / 4). p is from
/// chi-squared with 2 degrees of freedom, which holds only for large n. At n =
/// 30, 100 and 397 a nominal 5 % test rejects 2.8 %, 4.3 % and 4.6 % of normal
/// samples (tests/stats/normality/normality_null_test.cc); Monte Carlo corrects
/// this. Needs n >= 4.
TestResult JarqueBera(const OrderedSample& sample);

/// D'Agostino & Pearson's K^2 = Z(skewness)^2 + Z(kurtosis)^2 with the
/// transformations of D'Agostino (1970) and Anscombe & Glynn (1983). p is from
/// chi-squared with 2 degrees of freedom, an approximation. Needs n >= 20.
TestResult DAgostinoPearson(const OrderedSample& sample);

}  // namespace errmap::stats
