#include "models/study/record/study_record.h"

#include <fmt/format.h>

#include "data/formats/nesting.h"
#include "data/input_error.h"
#include "models/study/record/record_json.h"

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

std::string_view ToString(RemarkKind kind) {
  switch (kind) {
    case RemarkKind::kAveragesMaps:
      return "averages maps";
    case RemarkKind::kLowestAndSimplest:
      return "lowest and simplest";
    case RemarkKind::kSimplestNearLowest:
      return "simplest near lowest";
    case RemarkKind::kSimplestOfTier:
      return "simplest of tier";
    case RemarkKind::kRemoves:
      return "removes";
    case RemarkKind::kBeatsBaseline:
      return "beats baseline";
    case RemarkKind::kPromise:
      return "promise";
    case RemarkKind::kOneMoreSession:
      return "one more session";
    case RemarkKind::kGap:
      return "gap";
    case RemarkKind::kGoal:
      return "goal";
    case RemarkKind::kCost:
      return "cost";
    case RemarkKind::kNotNoise:
      return "not noise";
    case RemarkKind::kInterrupted:
      return "interrupted";
    case RemarkKind::kOneRunOnly:
      return "one run only";
    case RemarkKind::kGroupFitsFailed:
      return "group fits failed";
    case RemarkKind::kNoGroupsHeldOut:
      return "no groups held out";
    case RemarkKind::kNoGroups:
      return "no groups";
    case RemarkKind::kBlocksForUnits:
      return "blocks for units";
    case RemarkKind::kTooFewUnits:
      return "too few units";
    case RemarkKind::kTooManyMaps:
      return "too many maps";
    case RemarkKind::kIgnoreNeighbours:
      return "ignore neighbours";
    case RemarkKind::kHoldoutsDisagree:
      return "hold-outs disagree";
    case RemarkKind::kUnitsCorrelated:
      return "units correlated";
    case RemarkKind::kExtrapolates:
      return "extrapolates";
    case RemarkKind::kNotConverged:
      return "not converged";
    case RemarkKind::kNoiseLearning:
      return "noise learning";
    case RemarkKind::kOtherCuts:
      return "other cuts";
    case RemarkKind::kBetterWithoutMap:
      return "better without map";
  }
  return "";
}

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
  return ToJson(record).dump(
             kIndent, ' ', false, RecordJson::error_handler_t::replace) +
         "\n";
}

StudyRecord FromJsonText(std::string_view text) {
  data::RequireShallowJson(text);
  const RecordJson json = RecordJson::parse(text, nullptr, false);
  if (json.is_discarded()) {
    throw data::InputError("is no JSON; errmap compare --out writes it");
  }
  StudyRecord record;
  FromJson(json, &record);
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
