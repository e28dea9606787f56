#include "models/model_file.h"

#include "data/files/atomic_file.h"

namespace errmap::models {

void SaveModel(const FittedModel& fitted,
               const Provenance& provenance,
               const std::string& path) {
  data::WriteFileAtomically(path, ModelToJson(fitted, provenance));
}

FittedModel LoadModel(const std::string& path) {
  return ModelFromJson(data::ReadFile(path, data::kMostTextOfPrograms), path);
}

}  // namespace errmap::models
