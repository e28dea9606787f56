#pragma once

#include "stats/eigen.h"
#include "stats/normality/ordered_sample.h"
#include "stats/test_result.h"

namespace errmap::stats {

/// Lilliefors' test of normality: the K-S distance of a sample from the normal
/// distribution with the sample's own mean and sd (divisor n - 1). Needs n >=
/// 4. p is from LillieforsProbability.
TestResult Lilliefors(const OrderedSample& sample);

/// Returns the probability of a Lilliefors distance of at least `d` in n >= 4
/// normal values whose mean and sd were ESTIMATED from them. It is from
/// simulated quantiles (simulated_quantiles.h), accurate to 0.004 for every p.
/// Below 0.001 it is the smaller of 0.001 and DallalWilkinsonProbability.
/// Throws std::invalid_argument if n < 4.
double LillieforsProbability(double d, Index n);

/// Returns this probability by the formula of G. E. Dallal & L. Wilkinson, The
/// American Statistician 40 (1986), as R's nortest does. For p <= 0.1, accurate
/// to 0.005. Needs n >= 5.
double DallalWilkinsonProbability(double d, Index n);

}  // namespace errmap::stats
