#include "models/study/record/remark_record.h"

namespace errmap::models {

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
    case RemarkKind::kBestNet:
      return "best net";
    case RemarkKind::kSmaller:
      return "smaller";
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
    case RemarkKind::kFewSessions:
      return "few sessions";
    case RemarkKind::kSimpleHolds:
      return "simple holds";
    case RemarkKind::kOnlyGrows:
      return "only grows";
    case RemarkKind::kRowsLearnt:
      return "rows learnt";
    case RemarkKind::kProvenBetter:
      return "proven better";
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

}  // namespace errmap::models
