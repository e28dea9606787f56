#pragma once

#include "cli/json_blocks.h"
#include "models/certification/certification.h"

namespace errmap::cli {

/// The document of schema errmap-certify-1.
Json CertificationJson(const models::Certification& certification,
                       const models::CertificationFloors& floors);

}  // namespace errmap::cli
