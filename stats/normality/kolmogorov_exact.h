#pragma once

#include "stats/eigen.h"

namespace errmap::stats {

/// Largest n for which KsProbabilityExact uses the finite distribution in the
/// body. Above it, it uses Pelz and Good's expansion.
inline constexpr Index kMostForExactKs = 20000;

/// Returns the probability of a one-sample K-S distance of at least `d` in n >=
/// 1 values, exact for finite n, under the null hypothesis with the
/// distribution GIVEN (mean and sd not estimated from the same values).
///
/// - Tail, n d^2 >= 5 or d >= 1/2: twice the one-sided probability, a sum of
///   positive terms (Smirnov 1944; the overlap of both sides is below 1e-17).
/// - Body, n <= kMostForExactKs: the Durbin matrix of Marsaglia, Tsang and
///   Wang (J. Stat. Software 8(18), 2003), applied n times to one vector, as
///   Carvalho (J. Stat. Software 65(CS3), 2015) proposes, and cut to the band
///   that doubles can see. O(n sqrt(n)); absolute error below 1e-12.
/// - Body, larger n: Pelz and Good's expansion in 1/sqrt(n) (J. R. Stat. Soc.
///   B 38, 1976); absolute error below 2e-10.
///
/// Returns NaN if d is NaN. Throws std::invalid_argument if n < 1.
double KsProbabilityExact(double d, Index n);

}  // namespace errmap::stats
