#pragma once

#include <array>
#include <cstdint>

#include "stats/eigen.h"

namespace errmap::netcg {

/// Random generator of the report (function UNI of Appendix A, of J. Blue, D.
/// Kahaner and G. Marsaglia): uniform on [0, 1) in single precision, from
/// integers of 32 bits.
class Uni {
 public:
  /// Seeds by z = uni(seed). That call is itself a draw, the first of Next().
  explicit Uni(std::int64_t seed);
  float Next();

 private:
  std::array<std::int64_t, 17> m_ = {};
  std::size_t i_ = 4;
  std::size_t j_ = 16;
};

/// Initial weights (N) of a net in NetcgObjective's order, drawn as in
/// subroutine SETWTS. One draw is discarded. The others lie within +-0.5, row
/// by row (to outer, from inner).
Eigen::VectorXf RandomWeights(Index inputs,
                              Index hidden,
                              Index outputs,
                              std::int64_t seed);

}  // namespace errmap::netcg
