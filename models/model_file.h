#pragma once

#include <string>
#include <utility>
#include <vector>

#include "models/error_model.h"

namespace errmap::models {

/// Where a model came from: keys and values, written as they stand.
using Provenance = std::vector<std::pair<std::string, std::string>>;

/// The model as a JSON document of schema errmap-model-1; numbers are written
/// so that they read back to the same bits. Its last key is a checksum.
std::string ModelToJson(const FittedModel& fitted,
                        const Provenance& provenance);

/// Writes ModelToJson to `path`, whole or not at all. Throws
/// std::system_error naming the path.
void SaveModel(const FittedModel& fitted,
               const Provenance& provenance,
               const std::string& path);

/// Reads a model whose predictions equal those of the saved one bit for bit.
/// Its summary is that of a model that was not fitted here.
/// Throws data::InputError naming the file, the key and what is wrong: no
/// JSON, another schema, a missing key, a wrong type or shape, a number that
/// is not finite, a checksum that says that it was changed. A file without one
/// is read, with a remark.
FittedModel LoadModel(const std::string& path);

/// The same from text; `source` stands for the file in messages.
FittedModel ModelFromJson(const std::string& text, const std::string& source);

}  // namespace errmap::models
