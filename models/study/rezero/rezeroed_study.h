#pragma once

#include <cstdint>
#include <vector>

#include "models/study/judgement/units_of_analysis.h"
#include "models/study/rezero/rezero_rule.h"
#include "models/study/study.h"
#include "stats/eigen.h"

namespace errmap::models {

/// A study before its maps were re-zeroed, for their errors without
/// re-zeroing.
struct BeforeRezero {
  std::vector<Holdout> holdouts;
  /// (models x hold-outs) Names and predictions of the folds, without metrics.
  std::vector<std::vector<HoldoutResult>> results;
};

/// Throws std::invalid_argument, naming the hold-out, if `rule` leaves no row
/// of a fold to be judged, or as RequireTimes.
void RequireRezero(const data::Dataset& dataset,
                   const std::vector<Holdout>& holdouts,
                   const RezeroRule& rule);

/// The one place that re-zeroes held-out rows, after the fits and before every
/// judgement. Resets the offset of each model's predictions by `rule` under
/// each hold-out, and updates the metrics. Rows that are not scored (ZeroPlan)
/// leave the hold-outs.
BeforeRezero RezeroStudy(const data::Dataset& dataset,
                         const RezeroRule& rule,
                         std::uint64_t seed,
                         std::vector<Holdout>* holdouts,
                         StudyResult* study);

/// Errors with a map and without one, re-zeroed in the same way. RMSE on the
/// held-out rows, target's unit.
struct RezeroWorth {
  struct Model {
    std::size_t model = 0;
    double rmse = 0.0;   // re-zeroed by the rule
    double never = 0.0;  // on the same rows, never re-zeroed
  };
  Index probes = 0;
  Index scored_rows = 0;
  double no_map = 0.0;  // re-zeroed by the rule
  std::vector<Model> models;
};

/// Uses hold-out `h` of the study before re-zeroing.
RezeroWorth WorthOfRezero(const data::Dataset& dataset,
                          const RezeroRule& rule,
                          std::uint64_t seed,
                          const BeforeRezero& before,
                          std::size_t h);

/// The held-out rows that serve as probes, and the probe that sets each row's
/// offset: the last one before it in its fold and session.
struct ZeroPlan {
  /// (rows) Index of the probe; -1: not scored. Not scored are a session's
  /// first row and, with an interval, every row whose last probe is longer ago.
  std::vector<Index> zero_of;
  VectorXd noise;  // (rows) error of a probe there, target's unit
  Index probes = 0;
  std::vector<Index> scored;  // indices of rows, ascending
};

/// Takes probes only from the held-out rows, in time order. A row that is due
/// as a probe is scored with the old offset, then gives the new one. `seed`
/// draws the probes' errors (normal, sd rule.noise): the same for every model.
/// Throws as RequireTimes.
ZeroPlan PlanZeros(const HeldOutRows& held,
                   const RezeroRule& rule,
                   std::uint64_t seed);

/// Returns errors (rows, target's unit) minus those of their probes (scored).
VectorXd Rezeroed(const ZeroPlan& plan, const VectorXd& errors);

}  // namespace errmap::models
