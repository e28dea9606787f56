#pragma once

#include <cmath>

#include "fitting/minimisers/objective.h"

namespace errmap::fitting {

/// Returns x'y, summed term by term like SDOT in NISTIR 5367, Appendix A. In
/// single precision, rounding decides which path that program takes.
template <typename Scalar>
Scalar OrderedDot(const VectorOf<Scalar>& x, const VectorOf<Scalar>& y) {
  Scalar sum = 0;
  for (Index i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}

/// Returns |x| like its SNRM2: scaled as long as squares would underflow, then
/// summed term by term.
template <typename Scalar>
Scalar OrderedNorm(const VectorOf<Scalar>& x) {
  constexpr Scalar kSmall = Scalar(4.441e-16);
  Scalar sum = 0;
  Scalar largest = 0;
  Index i = 0;
  for (; i < x.size() && !(std::abs(x[i]) > kSmall); ++i) {
    const Scalar size = std::abs(x[i]);
    if (size == Scalar(0)) continue;
    const bool grows = size > largest;
    const Scalar ratio = grows ? largest / size : size / largest;
    sum = grows ? Scalar(1) + sum * (ratio * ratio) : sum + ratio * ratio;
    if (grows) largest = size;
  }
  if (i == x.size()) return largest * std::sqrt(sum);
  sum = (sum * largest) * largest;
  for (; i < x.size(); ++i) sum += x[i] * x[i];
  return std::sqrt(sum);
}

}  // namespace errmap::fitting
