#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "models/prediction_interval.h"
#include "models/study/judgement/choice.h"
#include "models/study/judgement/confidence.h"
#include "models/study/judgement/goal.h"
#include "models/study/record/record.h"
#include "models/study/record/record_values.h"
#include "models/study/record/remark_record.h"

// The recommended map: its error, what it costs and promises, and what its
// sensors and sessions are worth.

namespace errmap::models {

/// What a map remembers.
struct MemoryRecord {
  double longest = 0.0;  // time constant; 0: of none
  std::string time_unit;
  bool zeroed = false;  // at the start of a session
};

/// A share of the errors on a unit never seen lies within half_width;
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
  std::vector<PromiseLevelRecord> levels;
  // Where neighbouring units' mean errors go together: PredictionInterval.
  LeftOut<double> lag1;
  LeftOut<std::int64_t> good_for;
};
PromiseRecord MakeRecord(const PredictionInterval& interval);

/// Held-out residuals from `from` to before `until` seconds after the first row
/// of their session (NaN: to its end).
struct SinceStartRecord {
  double from = 0.0;
  double until = kNotKnown;
  std::int64_t n = 0;
  double mean = kNotKnown;
  double rmse = kNotKnown;
};

/// What sessions of measurements are worth to a map.
struct SessionWorth {
  std::int64_t sessions = 0;  // that the map was fitted to
  std::int64_t folds = 0;     // that could be compared
  /// Held-out error with one session fewer in training over that without,
  /// geometric mean over folds.
  double ratio_of_one_fewer = kNotKnown;
  /// What a power law through both makes of one session more: its error over
  /// today's, at most 1.
  double ratio_of_one_more = kNotKnown;
};

/// What a map is without some of its sensors, on rows that it was not fitted
/// to.
struct SensorImportance {
  struct Without {
    std::vector<std::string> sensors;  // taken away
    double rmse = 0.0;                 // target's unit
  };
  std::int64_t rows = 0;  // held out and judged
  double rmse = 0.0;      // with every sensor, on these rows
  /// Sensors whose readings correlate at least so are taken to be alike.
  double alike = kNotKnown;
  std::vector<Without> one_by_one;  // the largest error first
  /// Those that are alike, two or more, then all of them: sensors that stand in
  /// for one another look needless one by one.
  std::vector<Without> together;
};

struct RecommendationRecord {
  Choice choice = Choice::kBaseline;
  std::string model;
  std::string holdout;     // the strictest, of which all figures are
  std::string decided_by;  // the one that the map was chosen by
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
  /// Of the error without compensation, 1 - RMSE / RMSE; below 0: it adds.
  double removed_share = kNotKnown;
  PredictionCost cost;
  std::optional<MemoryRecord> memory;
  LeftOut<PromiseRecord> promise;
  /// Under `holdout`; empty without times in seconds.
  std::vector<SinceStartRecord> since_start;
  LeftOut<SessionWorth> session_worth;
  LeftOut<SensorImportance> importance;  // of its sensors
  std::vector<RemarkRecord> grounds;
  std::vector<RemarkRecord> doubts;
  std::string sentence;
  std::string why;
  // The texts of the grounds and of the doubts, for who reads results.json;
  // the program itself reads those with the remarks.
  std::vector<std::string> reasons;
  std::vector<std::string> caveats;
};

}  // namespace errmap::models
