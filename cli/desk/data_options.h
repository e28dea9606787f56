#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/study/record/record.h"

namespace errmap::desk {

/// The options with which compare, fit and learn read measurements like this:
/// what differs from the defaults, by the names of a study file, a flag with
/// an empty value. `where` has none.
models::ByName<std::string> DataOptions(const data::DatasetSelection& selection,
                                        std::uint64_t seed);

/// Names as --inputs takes them.
std::string NameList(const std::vector<std::string>& names);

}  // namespace errmap::desk
