#pragma once

#include "fitting/minimisers/objective.h"

namespace errmap::fitting {

// Sums of scaled conjugate gradients, two per pass. A sum alone waits for each
// of its additions; with a quick objective these waits are a tenth of an
// iteration. Sums use the same number of lanes on every machine, so their bits
// are the same on all. Sizes must agree.

template <typename Scalar>
struct VectorSums {
  Scalar squares = 0;  // x'x
  Scalar product = 0;  // x'y
};

VectorSums<double> SquaresAndProduct(const VectorOf<double>& x,
                                     const VectorOf<double>& y);
VectorSums<float> SquaresAndProduct(const VectorOf<float>& x,
                                    const VectorOf<float>& y);

}  // namespace errmap::fitting
