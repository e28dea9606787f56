#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "models/prediction_interval.h"
#include "models/study/judgement/confidence.h"
#include "models/study/judgement/goal.h"
#include "models/study/judgement/verdict.h"
#include "models/study/record/record.h"
#include "models/study/record/record_values.h"
#include "models/study/record/remark_record.h"

// The recommended map: its error, what it costs and promises, and what its
// sensors and sessions are worth.

namespace errmap::models {

/// Of one prediction.
struct CostRecord {
  std::int64_t multiplications = 0;
  std::int64_t exponentials = 0;
};
ERRMAP_RECORD(CostRecord, multiplications, exponentials)

/// What a map remembers.
struct MemoryRecord {
  double longest = 0.0;  // time constant; 0: of none
  std::string time_unit;
  bool zeroed = false;  // at the start of a session
};
ERRMAP_RECORD(MemoryRecord, longest, time_unit, zeroed)

/// A share of the errors on a unit never seen lies within half_width;
/// PredictionInterval.
struct PromiseLevelRecord {
  double coverage = kNotKnown;
  double half_width = kNotKnown;
  bool at_least = false;
};
ERRMAP_RECORD(PromiseLevelRecord, coverage, half_width, at_least)

struct PromiseRecord {
  std::string holdout;
  std::string unit;
  std::int64_t units = 0;
  std::vector<PromiseLevelRecord> levels;
  // Where neighbouring units' mean errors go together: PredictionInterval.
  LeftOut<double> lag1;
  LeftOut<std::int64_t> good_for;
};
ERRMAP_RECORD(PromiseRecord, holdout, unit, units, levels, lag1, good_for)
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
ERRMAP_RECORD(SinceStartRecord, from, until, n, mean, rmse)

/// See SessionWorth.
struct SessionWorthRecord {
  std::int64_t sessions = 0;
  std::int64_t folds = 0;
  double ratio_of_one_fewer = kNotKnown;
  double ratio_of_one_more = kNotKnown;
};
ERRMAP_RECORD(
    SessionWorthRecord, sessions, folds, ratio_of_one_fewer, ratio_of_one_more)

/// See SensorImportance.
struct WithoutSensorsRecord {
  std::vector<std::string> sensors;
  double rmse = kNotKnown;
};
ERRMAP_RECORD(WithoutSensorsRecord, sensors, rmse)

struct ImportanceRecord {
  std::int64_t rows = 0;
  double rmse = kNotKnown;
  double alike = kNotKnown;
  std::vector<WithoutSensorsRecord> one_by_one;
  std::vector<WithoutSensorsRecord> together;
};
ERRMAP_RECORD(ImportanceRecord, rows, rmse, alike, one_by_one, together)

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
  CostRecord cost;
  std::optional<MemoryRecord> memory;
  LeftOut<PromiseRecord> promise;
  /// Under `holdout`; empty without times in seconds.
  std::vector<SinceStartRecord> since_start;
  LeftOut<SessionWorthRecord> session_worth;
  LeftOut<ImportanceRecord> importance;  // of its sensors
  std::vector<RemarkRecord> grounds;
  std::vector<RemarkRecord> doubts;
  std::string sentence;
  std::string why;
  // The texts of the grounds and of the doubts, for who reads results.json;
  // the program itself reads those with the remarks.
  std::vector<std::string> reasons;
  std::vector<std::string> caveats;
};
ERRMAP_RECORD(RecommendationRecord,
              choice,
              model,
              holdout,
              decided_by,
              rmse,
              ci95,
              first_tier,
              best_baseline,
              sensors,
              parameters,
              predict_ns,
              against_baseline,
              meets_goal,
              goal_standing,
              extrapolated_share,
              removed_share,
              cost,
              memory,
              promise,
              since_start,
              session_worth,
              importance,
              grounds,
              doubts,
              sentence,
              why,
              reasons,
              caveats)

}  // namespace errmap::models
