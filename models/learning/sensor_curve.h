#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "data/measurements/dataset.h"
#include "stats/eigen.h"
#include "stats/not_a_number.h"

namespace errmap::models {

/// Error on unseen units as a function of the number of sensors (inputs that
/// are not positions). The map is simple: linear in the view of each sensor,
/// with a slope linear in the position, and quadratic in the position. Its
/// ridge penalty is from inner hold-outs. The view is whichever does best with
/// all sensors: raw, filtered, minus the session's first value, or both.
struct SensorCurve {
  struct Point {
    Index sensors = 0;
    double rmse = stats::kNaN;  // held out, target's unit
  };
  struct Chosen {
    std::string sensor;
    double stability = stats::kNaN;  // share of outer folds that also choose it
    /// Increase of the held-out error if the best other sensor replaces it.
    /// Sensors with similar readings can replace each other at no cost. NaN if
    /// there is no other.
    double replaced_cost = stats::kNaN;
    /// Sensors that could replace it for at most kTolerance times the error,
    /// the most similar first.
    std::vector<std::string> substitutes;
  };
  /// Errors within this factor of each other count as equal.
  static constexpr double kTolerance = 1.05;

  std::string held_out;       // "sessions:5 of day"
  std::string view;           // raw, history, zero, history+zero
  std::vector<Point> points;  // 0, 1, 2, ... chosen sensors
  Point all;
  /// Fewest sensors with at most kTolerance times the error of all; empty if no
  /// point reaches it.
  std::optional<Index> enough;
  /// Sensors chosen from all rows: as many as `enough`, or else as many as
  /// `points` has.
  std::vector<Chosen> chosen;
};

struct SensorSearch {
  Index most_sensors = 8;
  int jobs = 1;  // does not change results
  const std::atomic<bool>* stop = nullptr;
  /// Called from any thread after each of `all` searches.
  std::function<void(int done, int all)> progress = {};
};

/// Chooses sensors by sequential replacement from several starting sets: inside
/// folds of whole units for `points`, and from all rows for `chosen`. Throws
/// std::invalid_argument if there are fewer than two sensors or units, and
/// fitting::Interrupted if stopped.
SensorCurve LearnSensors(const data::Dataset& dataset,
                         const SensorSearch& search);

}  // namespace errmap::models
