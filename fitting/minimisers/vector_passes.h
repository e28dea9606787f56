#pragma once

#include "fitting/minimisers/objective.h"

namespace errmap::fitting {

// Vector operations of scaled conjugate gradients, several per pass. A sum
// alone waits for each of its additions; with a quick objective these waits are
// a tenth of an iteration. Sums use the same number of lanes on every machine,
// so their bits are the same on all. Sizes must agree.

template <typename Scalar>
struct VectorSums {
  Scalar squares = 0;  // x'x
  Scalar product = 0;  // x'y
};

VectorSums<double> SquaresAndProduct(const VectorOf<double>& x,
                                     const VectorOf<double>& y);
VectorSums<float> SquaresAndProduct(const VectorOf<float>& x,
                                    const VectorOf<float>& y);

/// Computes w += a p; returns w'w.
double MoveAndSquare(double a, const VectorOf<double>& p, VectorOf<double>* w);
float MoveAndSquare(float a, const VectorOf<float>& p, VectorOf<float>* w);

/// Computes r = -gradient, then p = r + a p; returns p'p and p'r.
VectorSums<double> TurnDirection(const VectorOf<double>& gradient,
                                 double a,
                                 VectorOf<double>* r,
                                 VectorOf<double>* p);
VectorSums<float> TurnDirection(const VectorOf<float>& gradient,
                                float a,
                                VectorOf<float>* r,
                                VectorOf<float>* p);

}  // namespace errmap::fitting
