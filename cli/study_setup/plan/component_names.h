#pragma once

#include <string>
#include <vector>

#include "cli/study_setup/study_config.h"
#include "data/csv.h"
#include "data/measurements/dataset.h"

namespace errmap::study_setup {

/// If each part of a table comes from one file, such as a direction of motion,
/// names it after that file, without the extension. Returns nothing if the
/// table comes from one file, a part comes from several, or two names would be
/// equal.
std::vector<std::string> NamesByFile(
    const data::CsvTable& table,
    const std::vector<data::DatasetSelection>& parts);

/// Names unnamed components after their file. Throws data::InputError if two
/// have the same name, since output files are named after components.
void NameComponents(StudyConfig* config);

/// Returns at most 100 characters; those that are unsafe in a file's name
/// become '_'.
std::string SafeName(const std::string& name);

/// Returns SafeName of a part of a name, and a hash of the name.
std::string HashedName(const std::string& part, const std::string& name);

/// Returns the name itself if a file can have it, else its HashedName.
std::string PlainOrHashedName(const std::string& name);

}  // namespace errmap::study_setup
