#pragma once

#include <vector>

#include "stats/eigen.h"

namespace errmap::models {

/// An error on unseen units after training on `size` of them.
struct LearningPoint {
  double size = 0.0;
  double rmse = 0.0;            // target's unit
  double relative_error = 0.0;  // standard deviation of log rmse
};

/// error(n)^2 = floor^2 + (gain * n^-exponent)^2. Every law on a grid is
/// weighted by its likelihood, instead of one fit. Squares add, since the error
/// is a map's bias plus the scatter of its fit. For smooth maps the scatter
/// falls at least as n^-1/2 (Cortes et al. 1994 for the form).
///
/// The sizes are tested on the same units, so their errors are correlated.
/// Small sizes, at which maps interpolate or fail outright, follow no law. So
/// smaller sizes get less weight.
class PowerLaw {
 public:
  /// `units` (at least 2) is the number of units from which the points' scatter
  /// comes. Throws std::invalid_argument for fewer units, fewer than two sizes,
  /// or values that are not above 0.
  PowerLaw(const std::vector<LearningPoint>& points, double units);

  struct Quantiles {
    double low = 0.0;  // 5 %
    double median = 0.0;
    double high = 0.0;  // 95 %
  };
  /// Returns the expected error after `size` units, target's unit.
  Quantiles ErrorAt(double size) const;
  /// Returns the error that remains after any number of units.
  Quantiles Floor() const;
  Quantiles Exponent() const;
  /// Returns the smallest whole number of units with an error of at most
  /// `goal`; infinite for laws that never reach it.
  Quantiles UnitsFor(double goal) const;
  /// Returns the weight of the laws whose floor is above `goal`.
  double NeverReaches(double goal) const;

 private:
  struct Law {
    double floor = 0.0;
    double gain = 0.0;
    double exponent = 0.0;
    double weight = 0.0;

    double At(double size) const;
  };
  template <typename Value>
  Quantiles QuantilesOf(Value&& value) const;

  std::vector<Law> laws_;
};

}  // namespace errmap::models
