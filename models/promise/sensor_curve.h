#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"
#include "models/history/view.h"

namespace errmap::models {

/// Error on unseen units against the number of sensors (inputs that are no
/// positions), by a map that every shop could run: linear in what a view makes
/// of each sensor, its slope linear in the position, quadratic in the position,
/// ridge penalty by inner hold-outs. Sensors as they are, through filters, less
/// their session's first value, or both: whichever does best with all of them.
struct SensorCurve {
  struct Point {
    Eigen::Index sensors = 0;
    double rmse = 0.0;  // held out, target's unit
  };
  struct Chosen {
    std::string sensor;
    double stability = 0.0;  // share of the outer folds that choose it too
    /// By how much the held-out error rises where the best of all others takes
    /// its place: sensors that read alike are chosen by turns, and missed by
    /// nobody. NaN where there is no other.
    double replaced_cost = std::numeric_limits<double>::quiet_NaN();
    /// Sensors that could stand in its place at no more than kTolerance of the
    /// error, the most alike first.
    std::vector<std::string> substitutes;
  };
  /// Errors within so many times another are as good.
  static constexpr double kTolerance = 1.05;

  View view = View::kRaw;
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

struct SensorSearch {
  Eigen::Index most_sensors = 8;
  int jobs = 1;  // changes no figure
  const std::atomic<bool>* stop = nullptr;
  /// Called by any thread after each of `all` searches.
  std::function<void(int done, int all)> progress = {};
};

/// Chooses sensors by sequential replacement from several beginnings, inside
/// folds of whole units for `points`, and from all rows for `chosen`. Throws
/// std::invalid_argument where there are fewer than two sensors or units,
/// fitting::Interrupted on a stop.
SensorCurve LearnSensors(const data::Dataset& dataset,
                         const SensorSearch& search);

}  // namespace errmap::models
