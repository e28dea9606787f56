#pragma once

#include <nlohmann/json.hpp>

#include "models/certification/certification.h"

namespace errmap::models {

/// The document of schema errmap-certify-1.
nlohmann::ordered_json CertificationJson(const Certification& certification,
                                         const CertificationFloors& floors);

}  // namespace errmap::models
