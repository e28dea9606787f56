#pragma once

#include "stats/eigen.h"

namespace errmap::stats {

/// Statistics whose null distribution is known only from simulation.
enum class SimulatedStatistic {
  kLilliefors,    // D of normal samples, mean and sd estimated
  kNormalPpcc,    // 1 - r of the normal probability plot, normal samples
  kTukeyMaxPpcc,  // 1 - the largest r over Tukey's family, normal samples
  kDip            // Hartigan's dip of uniform samples
};

/// Smallest n that was simulated.
inline constexpr Index kFewestSimulated = 4;
/// The largest and the smallest probability simulated.
inline constexpr double kLargestSimulated = 0.999;
inline constexpr double kSmallestSimulated = 0.001;

/// Returns the probability that the statistic is at least `value` in n >=
/// kFewestSimulated values. It is from quantiles simulated for 25 sizes from 4
/// to 5000 (60 000 to 500 000 samples each; kTukeyMaxPpcc 10 000 to 200 000),
/// interpolated linearly in the normal score of the probability and in log n.
/// It is clamped to kSmallestSimulated ("at most") and kLargestSimulated ("at
/// least"). The error of simulation and interpolation is up to 0.004.
///
/// Above n = 5000, D and the dip keep their sqrt(n) scale, and the correlations
/// follow the trend of the last sizes. Measured at n = 20000, a nominal 5 % is
/// 5.3, 5.1, 5.1 and 6.0 % (in the order of SimulatedStatistic), and a nominal
/// 10 % of kTukeyMaxPpcc is 14 %. The tables are made by
/// tests/stats/normality/simulate_null_tables.cc.
double SimulatedProbability(SimulatedStatistic statistic,
                            double value,
                            Index n);

/// Returns the value that the statistic reaches with this `probability`,
/// clamped as above. Throws std::invalid_argument if n or the probability is
/// outside the tables.
double SimulatedCriticalValue(SimulatedStatistic statistic,
                              double probability,
                              Index n);

}  // namespace errmap::stats
