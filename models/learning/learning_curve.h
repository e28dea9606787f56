#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/learning/power_law.h"
#include "models/study/study.h"
#include "stats/eigen.h"

namespace errmap::models {

/// The models whose curves are drawn by default. They are simple maps, a linear
/// one, and the quickest of those often recommended. The blend, which is
/// recommended most often, is added if the data have at most kMostForBlend
/// input values.
inline constexpr const char* kLearningModels =
    "mean,poly:temperature,poly:full:degree=1,poly:ridge:view=auto,blend";
inline constexpr Index kMostForBlend = 20000;

/// Units that are added to the training rows one after another.
enum class LearnBy { kSessions, kGroups };

/// Hold-outs of a learning curve. For each number of units there are folds that
/// train on that many, drawn from the units that the fold does not test.
struct LearningPlan {
  std::string unit;  // "day", "cycle"; "session" if cut by time
  Index num_units = 0;
  std::vector<Index> sizes;       // ascending, at least 2
  std::vector<Holdout> holdouts;  // one per size
};

/// Splits the units into at most five runs. For each training size, tests each
/// run after training on up to `repeats` random draws of other units. Throws
/// std::invalid_argument if there are fewer than four units.
LearningPlan PlanLearning(const data::Dataset& dataset,
                          LearnBy by,
                          Index repeats,
                          std::uint64_t seed);

/// One model's error on unseen units as a function of the training units.
struct LearningCurve {
  struct Point {
    Index size = 0;
    double rmse = 0.0;  // geometric mean over draws, target's unit
    double low = 0.0;   // 90 % interval over units; NaN below 3 of them
    double high = 0.0;
    double relative_error = 0.0;  // of rmse, from the units' scatter
  };
  std::string model;
  std::string why_failed;       // "" = every size was fitted
  std::vector<Point> points;    // sizes that could be fitted
  std::optional<PowerLaw> law;  // needs at least two sizes
};

/// Returns one curve for each model of a study run with plan.holdouts.
std::vector<LearningCurve> CurvesOf(const data::Dataset& dataset,
                                    const LearningPlan& plan,
                                    const StudyResult& study);

}  // namespace errmap::models
