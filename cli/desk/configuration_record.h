#pragma once

#include "cli/desk/study_config.h"
#include "models/study/record/study_record.h"

namespace errmap::desk {

/// Returns a study's configuration by the keys of a study file, for provenance:
/// {"seed","goal","indifference","holdouts","models",
/// "component":[{"name","data","where","target",...}]}. Paths are as results
/// show them. Defaults that were not decided are left out, so a study file made
/// from it may be incomplete.
models::ConfigurationRecord EffectiveConfiguration(const StudyConfig& config);

}  // namespace errmap::desk
