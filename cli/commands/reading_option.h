#pragma once

#include <string>

#include "data/measurements/dataset.h"

namespace errmap::cli {

/// Makes `selection` name what the reading in a file names (`errmap read
/// --format json`): columns, sign, units and the pause that parts sessions.
/// Throws data::InputError where the file is no reading.
void TakeReading(const std::string& path, data::DatasetSelection* selection);

}  // namespace errmap::cli
