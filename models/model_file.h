#pragma once

#include <string>
#include <utility>
#include <vector>

#include "models/error_model.h"

namespace errmap::models {

/// Origin of a model: keys and values, written unchanged.
using Provenance = std::vector<std::pair<std::string, std::string>>;

/// Returns the model as a JSON document of schema errmap-model-1. Numbers read
/// back to the same bits. The last key is a checksum.
std::string ModelToJson(const FittedModel& fitted,
                        const Provenance& provenance);

/// Writes ModelToJson to `path`, completely or not at all. Throws
/// std::system_error naming the path.
void SaveModel(const FittedModel& fitted,
               const Provenance& provenance,
               const std::string& path);

/// Reads a model; its predictions equal those of the saved one bit for bit. Its
/// summary says that the model was not fitted here. Throws data::InputError
/// naming the file, the key and the fault: not JSON, another schema, a missing
/// key, a wrong type or shape, a number that is not finite, or a wrong checksum
/// (the file was changed). A file without a checksum is read, with a remark.
FittedModel LoadModel(const std::string& path);

/// Reads a model from text; `source` is the file's name in messages.
FittedModel ModelFromJson(const std::string& text, const std::string& source);

}  // namespace errmap::models
