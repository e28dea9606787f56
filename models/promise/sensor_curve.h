#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"

namespace errmap::models {

/// Error on unseen units against the number of sensors (inputs that are no
/// positions), by a map that every shop could run: linear in each sensor, its
/// slope linear in the position, quadratic in the position, ridge penalty by
/// inner hold-outs; sensors as they are or less their session's first value,
/// whichever does better there.
struct SensorCurve {
  struct Point {
    Eigen::Index sensors = 0;
    double rmse = 0.0;  // held out, target's unit
  };
  struct Chosen {
    std::string sensor;
    double stability = 0.0;  // share of the outer folds that choose it too
    /// Sensors that could stand in its place at no more than kTolerance of the
    /// error, the most alike first.
    std::vector<std::string> substitutes;
  };
  /// Errors within so many times another are as good.
  static constexpr double kTolerance = 1.05;

  bool zeroed = false;
  std::string unit;           // what was held out whole: "day"
  std::vector<Point> points;  // 0, 1, 2, ... chosen sensors
  double all_rmse = 0.0;      // with every sensor
  Eigen::Index all_sensors = 0;
  /// Fewest sensors with at most kTolerance times the error of all; -1 where
  /// none of `points` gets there.
  Eigen::Index enough = -1;
  /// That many, else as many as `points` has, chosen from all rows.
  std::vector<Chosen> chosen;
};

/// Chooses sensors by sequential replacement, inside folds of whole units for
/// `points`, and from all rows for `chosen`. Throws std::invalid_argument where
/// there are fewer than two sensors or units.
SensorCurve LearnSensors(const data::Dataset& dataset,
                         Eigen::Index most_sensors);

}  // namespace errmap::models
