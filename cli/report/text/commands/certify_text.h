#pragma once

#include <string>

#include "models/certification/certification.h"

namespace errmap::report {

/// Returns tables of the parts that were run, with the required accuracy beside
/// the results. `details`: also every run of every solver and every gradient.
std::string CertificationText(const models::Certification& certification,
                              const models::CertificationFloors& floors,
                              bool details);

}  // namespace errmap::report
