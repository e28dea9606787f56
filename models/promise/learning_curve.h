#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"
#include "models/promise/power_law.h"
#include "models/study/study.h"

namespace errmap::models {

/// The models whose curves are drawn where none are named: one family each of
/// what is simple and linear, the quickest of those that are recommended, and
/// the blend, which mostly is, where the data have no more than
/// kMostForBlend cells of inputs.
inline constexpr const char* kLearningModels =
    "mean,poly:temperature,poly:full:degree=1,poly:ridge:view=auto,blend";
inline constexpr Eigen::Index kMostForBlend = 20000;

/// What is learnt from, one after another.
enum class LearnBy { kSessions, kGroups };

/// Hold-outs of a learning curve: for each number of units, folds that train on
/// so many of them, drawn from those that the fold does not test.
struct LearningPlan {
  std::string unit;  // "day", "cycle"; "session" where cut by time
  Eigen::Index num_units = 0;
  std::vector<Eigen::Index> sizes;  // ascending, 2 at least
  std::vector<Holdout> holdouts;    // one per size
};

/// Every fold of at most five runs of whole units is tested after training on
/// each size, `repeats` draws of it (one of all that there are). Throws
/// std::invalid_argument where there are fewer than four units.
LearningPlan PlanLearning(const data::Dataset& dataset,
                          LearnBy by,
                          Eigen::Index repeats,
                          std::uint64_t seed);

/// One model's error on unseen units against the number it learnt from.
struct LearningCurve {
  struct Point {
    Eigen::Index size = 0;
    double rmse = 0.0;  // geometric mean of the draws', target's unit
    double low = 0.0;   // 90 % interval over units; NaN below 3 of them
    double high = 0.0;
    double relative_error = 0.0;  // of rmse, by the units' scatter
  };
  std::string model;
  std::string why_failed;       // "" = every size was fitted
  std::vector<Point> points;    // sizes that could be fitted
  std::optional<PowerLaw> law;  // of two sizes at least
};

/// The curves of a study that was run under plan.holdouts, as its models.
std::vector<LearningCurve> CurvesOf(const data::Dataset& dataset,
                                    const LearningPlan& plan,
                                    const StudyResult& study);

}  // namespace errmap::models
