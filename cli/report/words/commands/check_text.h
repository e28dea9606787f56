#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/units.h"
#include "models/session/session_check.h"
#include "models/study/record/study_record.h"
#include "models/uncertainty/held_out_errors.h"

namespace errmap::report {

/// The sensor to check before anything else, in a line.
std::string SensorText(const models::SensorFaultFound& found);

/// What probes tell of a session, to go on behind "2 probes of FILE": when they
/// were taken (`elapsed`, (n) seconds since it began), what they found, whether
/// the map holds, the remedy where it does not, and where probes tell most.
std::string CheckText(const models::SessionCheck& check,
                      const models::HeldOutErrors& errors,
                      const std::vector<models::ProbeSite>& sites,
                      const Eigen::VectorXd& elapsed,
                      const data::Unit& unit);

}  // namespace errmap::report
