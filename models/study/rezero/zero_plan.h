#pragma once

#include <cstdint>
#include <vector>

#include "models/study/judgement/units_of_analysis.h"
#include "models/study/rezero/rezero_rule.h"
#include "stats/eigen.h"

namespace errmap::models {

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
