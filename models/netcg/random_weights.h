#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

namespace errmap::models {

/// The report's random generator (function UNI of Appendix A, of J. Blue, D.
/// Kahaner and G. Marsaglia): uniform on [0, 1) in single precision.
class Uni {
 public:
  /// Bits of an integer on the program's machine. Its comments document the
  /// draws of 16, its listing sets 32.
  enum class Digits { k16 = 16, k32 = 32 };

  /// z = uni(seed), which is itself a draw: the first of Next().
  explicit Uni(std::int64_t seed, Digits digits = Digits::k32);
  float Next();

 private:
  std::int64_t largest_;
  std::array<std::int64_t, 17> m_ = {};
  std::size_t i_ = 4;
  std::size_t j_ = 16;
};

/// Initial weights (N) of a net in NetcgObjective's order, as subroutine SETWTS
/// draws them: after one draw that is not used, within +-0.5, row by row (to
/// outer, from inner).
Eigen::VectorXf RandomWeights(Eigen::Index inputs,
                              Eigen::Index hidden,
                              Eigen::Index outputs,
                              std::int64_t seed);

}  // namespace errmap::models
