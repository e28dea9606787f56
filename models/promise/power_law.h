#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

namespace errmap::models {

/// An error on unseen units after learning from `size` of them.
struct LearningPoint {
  double size = 0.0;
  double rmse = 0.0;            // target's unit
  double relative_error = 0.0;  // standard deviation of log rmse
};

/// error(n) = floor + gain * n^-exponent, as far as a learning curve tells it:
/// not one fit but every law on a grid, weighted by its likelihood with normal
/// errors of the logarithm (a flat prior; Cortes et al. 1994 for the form).
class PowerLaw {
 public:
  /// Throws std::invalid_argument on fewer than two sizes, or on what is not
  /// above 0.
  explicit PowerLaw(const std::vector<LearningPoint>& points);

  struct Quantiles {
    double low = 0.0;  // 5 %
    double median = 0.0;
    double high = 0.0;  // 95 %
  };
  /// Error to be expected from `size` units, target's unit.
  Quantiles ErrorAt(double size) const;
  /// What more units than there will ever be would leave.
  Quantiles Floor() const;
  Quantiles Exponent() const;
  /// Smallest whole number of units at which the error is `goal` or less,
  /// infinite for laws that never get there.
  Quantiles UnitsFor(double goal) const;
  /// Weight of the laws whose floor is above `goal`.
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
