#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "models/study/judgement/units_of_analysis.h"
#include "models/study/rezero/rezero_rule.h"

namespace errmap::models {

/// Which of the held-out rows are probes, and which probe each row's offset is
/// from: the last one of its fold and session before it.
struct ZeroPlan {
  /// (rows) Place of the probe, -1: left out of the score. That is a session's
  /// first row, and with an interval every one whose last probe is longer ago.
  std::vector<Eigen::Index> zero_of;
  Eigen::VectorXd noise;  // (rows) that a probe there is off by, target's unit
  Eigen::Index probes = 0;
  std::vector<Eigen::Index> scored;  // places, ascending
};

/// Probes are taken from the held-out rows alone, in order of time; a row at
/// which the offset is due is judged by the old one, then gives the new one.
/// `seed` draws the probes' errors (normal, sd rule.noise): the same for every
/// model. Throws as RequireTimes.
ZeroPlan PlanZeros(const HeldOutRows& held,
                   const RezeroRule& rule,
                   std::uint64_t seed);

/// (scored) Errors (rows, target's unit) less what the probe of each found.
Eigen::VectorXd Rezeroed(const ZeroPlan& plan, const Eigen::VectorXd& errors);

}  // namespace errmap::models
