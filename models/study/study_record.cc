#include "models/study/study_record.h"

#include <fmt/format.h>

#include "data/input_error.h"
#include "models/study/record_json.h"

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

std::string ToJsonText(const StudyRecord& record) {
  constexpr int kIndent = 1;
  return ToJson(record).dump(
             kIndent, ' ', false, RecordJson::error_handler_t::replace) +
         "\n";
}

StudyRecord FromJsonText(std::string_view text) {
  const RecordJson json = RecordJson::parse(text, nullptr, false);
  if (json.is_discarded()) {
    throw data::InputError("is no JSON; errmap compare --out writes it");
  }
  StudyRecord record;
  FromJson(json, &record);
  constexpr const char* kSchema = "errmap-results-1";
  if (record.schema != kSchema) {
    throw data::InputError(fmt::format(
        "schema is {}, this version reads {}; run errmap compare again",
        record.schema.empty() ? "not there" : data::QuotedText(record.schema),
        kSchema));
  }
  return record;
}

}  // namespace errmap::models
