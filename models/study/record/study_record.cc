#include "models/study/record/study_record.h"

#include <algorithm>

#include <fmt/format.h>

#include "data/argument_name.h"
#include "data/formats/nesting.h"
#include "data/input_error.h"
#include "models/study/record/record_json.h"

namespace errmap::models {

const PairRecord* FindPair(const ComponentRecord& component,
                           std::string_view holdout,
                           std::string_view one,
                           std::string_view other) {
  const auto found =
      std::ranges::find_if(component.comparisons, [&](const PairRecord& pair) {
        return pair.holdout == holdout && ((pair.a == one && pair.b == other) ||
                                           (pair.a == other && pair.b == one));
      });
  return found == component.comparisons.end() ? nullptr : &*found;
}

std::string ToJsonText(const StudyRecord& record) {
  constexpr int kIndent = 1;
  return JsonText(record, kIndent) + "\n";
}

StudyRecord FromJsonText(std::string_view text) {
  data::RequireShallowJson(text);
  record_json::Tree json;
  if (!json.Parse(text)) {
    throw data::InputError("is no JSON; errmap compare " +
                           data::ArgumentName("out") + " writes it");
  }
  StudyRecord record;
  FromJson(*json.root(), &record);
  constexpr std::string_view kSchema = kResultsSchema;
  if (record.schema != kSchema) {
    throw data::InputError(fmt::format(
        "schema is {}, this version reads {}; run errmap compare again",
        record.schema.empty() ? "not there" : data::QuotedText(record.schema),
        kSchema));
  }
  return record;
}

}  // namespace errmap::models
