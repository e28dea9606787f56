#pragma once

#include <string>

#include "data/measurements/dataset.h"

namespace errmap::cli {

/// Copies a reading from a file (`errmap read --format json`) to `selection`:
/// columns, sign, units and the pause that separates sessions. Throws
/// data::InputError if the file is not a reading.
void TakeReading(const std::string& path, data::DatasetSelection* selection);

}  // namespace errmap::cli
