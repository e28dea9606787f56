#pragma once

#include "cli/desk/study_config.h"
#include "models/study/record/study_record.h"

namespace errmap::desk {

/// A study's configuration with the keys of a study file, from which one could
/// be written: {"seed","goal","indifference","holdouts","models",
/// "component":[{"name","data","where","target",...}]}. What was left to the
/// defaults and could not be decided is left out.
models::ConfigurationRecord EffectiveConfiguration(const StudyConfig& config);

}  // namespace errmap::desk
