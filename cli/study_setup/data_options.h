#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/record.h"

namespace errmap::study_setup {

/// Returns the options with which compare, fit and learn read measurements like
/// `selection`: those that differ from the defaults, by the keys of a study
/// file. A flag has an empty value. There is no option for `where`.
models::ByName<std::string> DataOptions(const data::DatasetSelection& selection,
                                        std::uint64_t seed);

/// Joins names as --inputs takes them.
std::string NameList(const std::vector<std::string>& names);

}  // namespace errmap::study_setup
