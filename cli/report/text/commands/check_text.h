#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/units.h"
#include "models/session/session_check.h"
#include "models/study/record/study_record.h"
#include "models/uncertainty/held_out_errors.h"

namespace errmap::report {

/// Names the sensor to check before anything else, in one line.
std::string SensorText(const models::SensorFaultFound& found);

/// Returns the result of probes in a session, to follow "2 probes of FILE". It
/// says when they were taken (`elapsed`, (n) seconds since its start), their
/// errors, and whether the map holds. It also says what to do if not, and where
/// further probes help most.
std::string CheckText(const models::SessionCheck& check,
                      const models::HeldOutErrors& errors,
                      const std::vector<models::ProbeSite>& sites,
                      const Eigen::VectorXd& elapsed,
                      const data::Unit& unit);

}  // namespace errmap::report
