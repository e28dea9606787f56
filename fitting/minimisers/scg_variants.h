#pragma once

#include "fitting/minimisers/scaled_conjugate_gradient.h"

namespace errmap::fitting {

// The two variants of BasicScaledConjugateGradient; each runs from x0.

template <typename Scalar>
Minimum MinimizeByMoller(const ScaledConjugateGradientOptions& options,
                         const BasicObjective<Scalar>& f,
                         const VectorOf<Scalar>& x0,
                         const RunControl& run);

template <typename Scalar>
Minimum MinimizeByNetcg(const ScaledConjugateGradientOptions& options,
                        const BasicObjective<Scalar>& f,
                        const VectorOf<Scalar>& x0,
                        const RunControl& run);

}  // namespace errmap::fitting
