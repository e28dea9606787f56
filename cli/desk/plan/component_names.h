#pragma once

#include "cli/desk/study_config.h"

namespace errmap::desk {

/// Gives components without a name their file's. Throws data::InputError where
/// two have one name: files are called by it.
void NameComponents(StudyConfig* config);

}  // namespace errmap::desk
