#pragma once

#include <string>

#include "models/certification/certification.h"

namespace errmap::report {

/// Tables of the parts that were run, the floors beside them. `details`: every
/// run of every solver and every gradient too.
std::string CertificationText(const models::Certification& certification,
                              const models::CertificationFloors& floors,
                              bool details);

}  // namespace errmap::report
