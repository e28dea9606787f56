#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "models/study/judgement/confidence.h"
#include "models/study/record/record.h"

// What is to be said of a recommendation: its kind, its numbers and, once
// report::AddSentences was there, its words.

namespace errmap::models {

/// What speaks for a recommendation, then what bounds its worth. The figures
/// that a remark does not hold stand elsewhere in the record.
enum class RemarkKind {
  kAveragesMaps,        // model: the single map beside it, of its tier if any
  kLowestAndSimplest,   // of the first tier
  kSimplestNearLowest,  // of one unit only; model: of the lowest error
  kSimplestOfTier,      // model: of the lowest error; excess, confidence
  kRemoves,             // removed_share of what is there without a map
  kBeatsBaseline,       // model: the best one
  kGap,
  kPromise,
  kOneMoreSession,
  kGoal,
  kCost,
  kNotNoise,  // columns, shares; add_sensor
  kInterrupted,
  kOneRunOnly,
  kGroupFitsFailed,
  kNoGroupsHeldOut,
  kNoGroups,
  kBlocksForUnits,
  kTooFewUnits,
  kTooManyMaps,       // for so few units
  kIgnoreNeighbours,  // model: what they flatter most temptingly
  kHoldoutsDisagree,  // holdouts: in whose first tier the map is not
  kUnitsCorrelated,   // lag1, pairs, established
  kExtrapolates,
  kNotConverged,
  kNoiseLearning,
  kOtherCuts,
  kBetterWithoutMap,  // model: the predictions
  kBestNet,           // model: beside a map that is none
  kSmaller,           // model: for a control with little time
  kFewSessions,       // holdouts: what the map was chosen by
  kProvenBetter,      // model: the blend, by separate sessions
  kSimpleHolds,       // holdouts: where the blend errs twice as much
  kOnlyGrows,         // columns; holdouts: that which looks forward, if any
  kRowsLearnt,        // holdouts: whose file holds rows of training
};
/// "averages maps", ...: the enumerator's words.
std::string_view ToString(RemarkKind kind);

struct RemarkRecord {
  RemarkKind kind = RemarkKind::kCost;
  /// Its place among what is told first, from 1; nothing: told on request.
  LeftOut<std::int64_t> rank = {};
  LeftOut<std::string> model = {};
  LeftOut<std::vector<std::string>> holdouts = {};
  LeftOut<double> excess = {};  // of its RMSE over the model's, at most; 95 %
  LeftOut<Confidence> confidence = {};
  LeftOut<std::vector<std::string>> columns = {};
  /// Of the squared residuals, what the means by each column explain (0 to 1).
  LeftOut<std::vector<double>> shares = {};
  /// Against an offset that the sensors do not see: whether one more of them
  /// may help, or re-zeroing alone; left out where nothing is needed.
  LeftOut<bool> add_sensor = {};
  LeftOut<double> lag1 = {};
  LeftOut<std::int64_t> pairs = {};
  LeftOut<std::int64_t> established = {};
  /// Of each of `columns`: below and above what more is to be measured.
  LeftOut<std::vector<double>> below = {};
  LeftOut<std::vector<double>> above = {};
  std::string text = {};
};

}  // namespace errmap::models
