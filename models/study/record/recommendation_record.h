#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "models/prediction_interval.h"
#include "models/record.h"
#include "models/study/judgement/choice.h"
#include "models/study/judgement/confidence.h"
#include "models/study/judgement/goal.h"

// The recommended map: its error, its cost, its predicted error, and the value
// of its sensors and sessions.

namespace errmap::models {

/// The memory of a map.
struct MemoryRecord {
  double longest = 0.0;  // time constant; 0: no memory
  std::string time_unit;
  bool zeroed = false;  // at the start of a session
};

/// A share of the errors on an unseen unit lies within half_width;
/// PredictionInterval.
struct PromiseLevelRecord {
  double coverage = kNotKnown;
  double half_width = kNotKnown;
  bool at_least = false;
};

struct PromiseRecord {
  std::string holdout;
  std::string unit;
  std::int64_t units = 0;
  std::vector<PromiseLevelRecord> levels = {};
  // Set if mean errors of neighbouring units correlate: PredictionInterval.
  LeftOut<double> lag1 = {};
  LeftOut<std::int64_t> good_for = {};
};
PromiseRecord MakeRecord(const PredictionInterval& interval);

/// Held-out residuals from `from` to before `until` seconds after the first row
/// of their session (NaN: to the session's end).
struct SinceStartRecord {
  double from = 0.0;
  double until = kNotKnown;
  std::int64_t n = 0;
  double mean = kNotKnown;
  double rmse = kNotKnown;
};

/// The value of further sessions of measurements to a map.
struct SessionWorth {
  std::int64_t sessions = 0;  // in the map's training data
  std::int64_t folds = 0;     // compared
  /// Held-out error with one training session fewer, divided by that with all;
  /// geometric mean over folds.
  double ratio_of_one_fewer = kNotKnown;
  /// Predicted error with one more session, divided by today's, by a power law
  /// through both; at most 1.
  double ratio_of_one_more = kNotKnown;
};

/// The error of a map without some of its sensors, on held-out rows.
struct SensorImportance {
  struct Without {
    std::vector<std::string> sensors;  // removed
    double rmse = 0.0;                 // target's unit
  };
  std::int64_t rows = 0;  // held out and judged
  double rmse = 0.0;      // with every sensor, on these rows
  /// Least correlation at which sensors count as similar.
  double alike = kNotKnown;
  std::vector<Without> one_by_one;  // the largest error first
  /// Groups of at least two similar sensors, then all sensors. Sensors that can
  /// replace each other look unnecessary one by one.
  std::vector<Without> together;
};

/// Ends of an input's range in all data, in its unit, if held-out rows leave
/// the range of their fold on this side; else NaN.
struct BeyondRecord {
  std::string column;
  double below = kNotKnown;
  double above = kNotKnown;
};

struct RecommendationRecord {
  Choice choice = Choice::kBaseline;
  std::string model;
  std::string holdout;     // the strictest; all errors refer to it
  std::string decided_by;  // the hold-out that chose the map
  double rmse = kNotKnown;
  IntervalRecord ci95 = {kNotKnown, kNotKnown};
  std::vector<std::string> first_tier;
  std::optional<std::string> best_baseline;
  std::vector<std::string> sensors;
  std::int64_t parameters = 0;
  double predict_ns = kNotKnown;
  std::optional<Confidence> against_baseline;
  std::optional<bool> meets_goal;
  GoalStanding goal_standing = GoalStanding::kNotJudged;
  double extrapolated_share = kNotKnown;
  /// Share of the uncompensated error that the map removes: 1 - its RMSE / RMSE
  /// without a map. For a target that is not an error: share of the deviation
  /// from the mean. Below 0: the map adds error.
  double removed_share = kNotKnown;
  PredictionCost cost;
  std::optional<MemoryRecord> memory;
  LeftOut<PromiseRecord> promise;
  /// Residuals under `holdout`; empty without times in seconds.
  std::vector<SinceStartRecord> since_start;
  LeftOut<SessionWorth> session_worth;
  LeftOut<SensorImportance> importance;  // of its sensors
  /// For a blend: the single map of lowest error.
  LeftOut<std::string> single;
  /// For a single map: the blend that it beats, established by separate days.
  LeftOut<std::string> proven_better_than;
  /// For a simple map: the hold-out in which the blend has more than twice its
  /// error.
  LeftOut<std::string> fails_in;
  /// Predictions without a map that are better.
  LeftOut<std::string> better_without_map;
  /// Inputs that hardly ever return to earlier values.
  LeftOut<std::vector<std::string>> only_grow;
  /// Inputs whose trained range many held-out rows leave, most rows first.
  LeftOut<std::vector<BeyondRecord>> beyond;
  std::string sentence;
  std::string why;  // the sentence and the reasons
  std::vector<std::string> reasons;
  std::vector<std::string> caveats;
};

}  // namespace errmap::models
