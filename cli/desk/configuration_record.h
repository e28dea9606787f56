#pragma once

#include "cli/desk/study_config.h"
#include "models/study/record/study_record.h"

namespace errmap::desk {

/// A study's configuration by the keys of a study file, for provenance:
/// {"seed","goal","indifference","holdouts","models",
/// "component":[{"name","data","where","target",...}]}. Paths are as they are
/// shown, and what was left to the defaults and could not be decided is left
/// out, so that no study file need follow from it.
models::ConfigurationRecord EffectiveConfiguration(const StudyConfig& config);

}  // namespace errmap::desk
