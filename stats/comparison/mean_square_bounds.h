#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "stats/comparison/unit_bootstrap.h"
#include "stats/eigen.h"

namespace errmap::stats {

/// Bounds of the mean square of all values to come of a stationary process, its
/// squared mean plus its variance, from a short series whose neighbours may be
/// alike: a first-order autoregression with a memory of up to 0.9.
///
/// A short series of strong memory varies less than what is to come, and often
/// looks independent by chance. So the memory is not estimated. It is the
/// largest of 0.9, 0.8, ..., 0.1 that the series does not exclude at 10 %, and
/// the bounds are the widest of all up to it (Berger & Boos 1994): the upper
/// one is that of this memory, the lower one that of none. Fewer than 5 values
/// exclude nothing. Both steps use random draws of such a series:
/// - The test compares the generalised sum of squares for that memory with the
///   one for none, a ratio that depends on neither mean nor scale (King 1987).
/// - Mean and variance have the generalised fiducial distribution: what that
///   sum and the weighted mean would be for each draw (Weerahandi 1993).
///
/// tests/stats/comparison/mean_square_bounds_test.cc measures the coverage.
class MeanSquareBounds {
 public:
  /// For series of `size` values, at least 2.
  MeanSquareBounds(Index size, std::uint64_t seed) : size_(size), seed_(seed) {}

  /// Returns the largest memory that `series` does not exclude, or 0.
  double LargestMemory(const VectorXd& series);
  /// Returns the bounds of the square root of that mean square plus `added`,
  /// for every memory from 0 to that one.
  Bounds95 OfRoot(const VectorXd& series, double memory, double added = 0.0);

 private:
  // Of a series of mean 0 and variance 1, estimated for its memory.
  struct Draws {
    std::vector<double> means;
    std::vector<double> squares;  // sums
    double most_ratio = 0.0;      // of sums of squares, not excluded
  };
  const Draws& DrawsOf(double memory);
  Bounds95 With(double memory, const VectorXd& series, double added);

  Index size_;
  std::uint64_t seed_;
  std::map<double, Draws> drawn_;
};

}  // namespace errmap::stats
