#pragma once

#include "cli/json_blocks.h"
#include "cli/study_file/study_config.h"

namespace errmap::cli {

/// A study's configuration with the keys of a study file, from which one could
/// be written: {"seed","goal","indifference","holdouts","models",
/// "component":[{"name","data","where","target",...}]}. What was left to the
/// defaults and could not be decided is left out.
Json EffectiveConfiguration(const StudyConfig& config);

}  // namespace errmap::cli
