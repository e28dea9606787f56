#pragma once

#include <optional>
#include <string>
#include <vector>

#include "models/study/study.h"

namespace errmap::models {

/// What a map is without some of its sensors, on rows that it was not fitted
/// to.
struct SensorImportance {
  /// Sensors whose readings correlate at least so are taken to be alike.
  static constexpr double kAlike = 0.9;

  struct Without {
    std::vector<std::string> sensors;  // taken away
    double rmse = 0.0;                 // target's unit
  };
  Eigen::Index rows = 0;            // held out and judged
  double rmse = 0.0;                // with every sensor, on these rows
  std::vector<Without> one_by_one;  // the largest error first
  /// Those that are alike, two or more, then all of them: sensors that stand in
  /// for one another look needless one by one.
  std::vector<Without> together;
};

/// Takes the sensors of `fitted` (the map of all rows) away from the maps of
/// the folds in `result`: in a sensor's place they read what the others that
/// they read say of it, by linear regression over the fold's training rows.
/// Nothing is fitted anew, so one that is fitted without the sensor may do
/// better. Every so-manieth held-out row serves where all would take more than
/// some seconds. None for a map without sensors, for results without maps, for
/// readings whose squares overflow, where a memory would run through too long a
/// log, and where `stop` is set.
std::optional<SensorImportance> ImportanceOfSensors(
    const data::Dataset& dataset,
    const Holdout& holdout,
    const HoldoutResult& result,
    const FittedModel& fitted,
    const std::atomic<bool>* stop);

}  // namespace errmap::models
