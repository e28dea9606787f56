#pragma once

#include "models/study_file/study_config.h"

namespace errmap::study_file {

/// Gives components without a name their file's. Throws data::InputError where
/// two have one name: files are called by it.
void NameComponents(StudyConfig* config);

}  // namespace errmap::study_file
