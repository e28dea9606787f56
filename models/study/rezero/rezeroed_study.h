#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "models/study/rezero/rezero_rule.h"
#include "models/study/study.h"

namespace errmap::models {

/// A study as it was before its maps were re-zeroed: what they promise when
/// nobody re-zeroes them.
struct BeforeRezero {
  std::vector<Holdout> holdouts;
  /// (models x hold-outs) Names and predictions of the folds, no figures.
  std::vector<std::vector<HoldoutResult>> results;
};

/// Throws std::invalid_argument, naming the hold-out, where `rule` leaves no
/// row of a fold to be judged, or as RequireTimes.
void RequireRezero(const data::Dataset& dataset,
                   const std::vector<Holdout>& holdouts,
                   const RezeroRule& rule);

/// The one place where held-out rows are re-zeroed: between the fits and every
/// judgement. The predictions of each model under each hold-out become those
/// with the offset set anew by `rule`, and its figures with them; the rows that
/// are not scored (ZeroPlan) leave the hold-outs.
BeforeRezero RezeroStudy(const data::Dataset& dataset,
                         const RezeroRule& rule,
                         std::uint64_t seed,
                         std::vector<Holdout>* holdouts,
                         StudyResult* study);

/// What a map saves in probes beside no map at all that is re-zeroed alike.
/// RMSE on the held-out rows, target's unit.
struct RezeroWorth {
  struct Model {
    std::size_t model = 0;
    double rmse = 0.0;   // re-zeroed by the rule
    double never = 0.0;  // on the same rows, never re-zeroed
  };
  struct At {
    double interval = 0.0;  // s; infinite: once a session
    double map = 0.0;
    double no_map = 0.0;
  };
  Eigen::Index probes = 0;
  Eigen::Index scored_rows = 0;
  double no_map = 0.0;  // re-zeroed by the rule
  std::vector<Model> models;
  /// Of the recommended map, the interval rising; of kEvery also intervals
  /// about that of the rule.
  std::vector<At> curve;
  /// The longest of them up to which the map errs no more than no map does by
  /// the rule; NaN: not even by the rule itself.
  double does_as_well_at = std::numeric_limits<double>::quiet_NaN();
  bool does_as_well_never = false;  // ... and where it is never re-zeroed
};

/// Under hold-out `h` of the study before it was re-zeroed; `recommended`: the
/// model of the curve.
RezeroWorth WorthOfRezero(const data::Dataset& dataset,
                          const RezeroRule& rule,
                          std::uint64_t seed,
                          const BeforeRezero& before,
                          std::size_t h,
                          std::size_t recommended);

}  // namespace errmap::models
