#pragma once

#include <vector>

#include <Eigen/Core>

namespace errmap::models {

/// An error on unseen units after learning from `size` of them.
struct LearningPoint {
  double size = 0.0;
  double rmse = 0.0;            // target's unit
  double relative_error = 0.0;  // standard deviation of log rmse
};

/// error(n)^2 = floor^2 + (gain * n^-exponent)^2, as far as a learning curve
/// tells it: not one fit but every law on a grid, weighted by its likelihood.
/// Squares add, since what a map lacks is its bias and the scatter of what it
/// learnt; of smooth maps the scatter falls as n^-1/2 at least (Cortes et al.
/// 1994 for the form).
///
/// The sizes were tested on the same units, so that their errors are wrong
/// together, and small sizes, at which maps interpolate or fail outright, keep
/// to no law: what a size tells counts less the further it is from the last.
class PowerLaw {
 public:
  /// `units`: of so many (2 at least) is the scatter of the points' errors.
  /// Throws std::invalid_argument on fewer, on fewer than two sizes, or on what
  /// is not above 0.
  PowerLaw(const std::vector<LearningPoint>& points, double units);

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
