#include "models/study/record/model_record.h"

namespace errmap::models {

std::string_view ToString(ModelStatus status) {
  switch (status) {
    case ModelStatus::kFailed:
      return "failed";
    case ModelStatus::kOk:
      return "ok";
  }
  return "";
}

}  // namespace errmap::models
