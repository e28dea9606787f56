#pragma once

#include "stats/eigen.h"

namespace errmap::stats {

/// Returns the degrees of freedom of the mean of `mean_squares` (n >= 2, one
/// per unit). A mean square with f degrees of freedom has variance 2 mean^2 / f
/// (Satterthwaite 1946; JCGM 100:2008, G.4). That variance is itself estimated,
/// so f uses its upper bound at 80 % confidence. f is at least `least` per
/// unit. Infinite if all mean squares are equal.
double SatterthwaiteDof(const VectorXd& mean_squares, double least = 1.0);

}  // namespace errmap::stats
