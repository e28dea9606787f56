#pragma once

#include <Eigen/Core>

#include "stats/normality/ordered_sample.h"
#include "stats/test_result.h"

namespace errmap::stats {

/// Lilliefors' test of normality: the K-S distance of a sample from the normal
/// with the sample's own mean and sd (divisor n - 1), so mean and sd need not
/// be known. n >= 4. p by LillieforsProbability.
TestResult Lilliefors(const OrderedSample& sample);

/// Probability of a Lilliefors distance of at least `d` in n >= 4 normal
/// values whose mean and sd were ESTIMATED from them: from simulated quantiles
/// (simulated_quantiles.h), good to 0.004 for every p; below 0.001 the smaller
/// of 0.001 and DallalWilkinsonProbability. Throws std::invalid_argument for
/// n < 4.
double LillieforsProbability(double d, Eigen::Index n);

/// The same by published formulas, for comparison with R: G. E. Dallal & L.
/// Wilkinson, The American Statistician 40 (1986), for p <= 0.1, where they
/// are good to 0.005; above it the polynomials in Stephens' (1974) modified
/// distance that R's nortest uses, off by up to 0.012. n >= 5.
double DallalWilkinsonProbability(double d, Eigen::Index n);

}  // namespace errmap::stats
