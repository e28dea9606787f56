#include "models/study/judgement/confidence.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "data/text.h"

namespace errmap::models {
namespace {

using Kind = Obstacle::Kind;
using stats::PairComparison;

Kind UnitsObstacle(Index units, bool separate_sessions) {
  if (units < kFewestUnits) return Kind::kTooFewUnits;
  if (units < kFewestUnitsOfOneSession && !separate_sessions) {
    return Kind::kPerhapsOneSession;
  }
  return Kind::kNone;
}

bool IsSignificant(double p) { return p <= stats::kSignificance; }

// The least that all sign patterns of so many units can reach: 2 / 2^n.
double SmallestP(Index units) {
  return std::ldexp(2.0, -static_cast<int>(units));
}

// The fewest units that can establish a difference between two of so many.
Index UnitsNeeded(Index pairs, bool separate_sessions) {
  Index units = separate_sessions ? kFewestUnits : kFewestUnitsOfOneSession;
  while (!IsSignificant(SmallestP(units) * static_cast<double>(pairs))) ++units;
  return units;
}

// Whether the clearest difference of so many units would have a p small enough
// after the pair's adjustment.
bool IsInReach(Index units, const PairComparison& pair) {
  const double smallest = units > stats::kMostForExactFlips
                              ? pair.sign_flip.smallest_p
                              : SmallestP(units);
  return IsSignificant(smallest * static_cast<double>(pair.num_adjusted));
}

}  // namespace

std::string_view ToString(Confidence confidence) {
  constexpr auto kNames =
      std::to_array<std::string_view>({"established",
                                       "out of reach",
                                       "not shown",
                                       "units correlated",
                                       "memory not excluded",
                                       "blocks disagree"});
  return data::NameOf(kNames, confidence);
}

std::string_view ToString(Obstacle::Kind kind) {
  constexpr auto kNames =
      std::to_array<std::string_view>({"none",
                                       "too few units",
                                       "perhaps one session",
                                       "too many pairs",
                                       "too few sign patterns"});
  return data::NameOf(kNames, kind);
}

Obstacle FindObstacle(const stats::Comparison& tests, bool separate_sessions) {
  Obstacle obstacle{.kind = UnitsObstacle(tests.num_units, separate_sessions),
                    .units = tests.num_units,
                    .pairs = tests.num_tested};
  if (tests.num_units > stats::kMostForExactFlips && obstacle.pairs > 0) {
    const double smallest =
        std::ranges::min(tests.pairs, {}, [](const PairComparison& pair) {
          return pair.sign_flip.smallest_p;
        }).sign_flip.smallest_p;
    if (!IsSignificant(smallest * static_cast<double>(obstacle.pairs))) {
      obstacle.kind = Kind::kTooFewSignPatterns;
    }
    return obstacle;
  }
  // However few there are, and whatever is tied among so few, the number that
  // suffices is the same.
  const Index needed = UnitsNeeded(tests.num_asked, separate_sessions);
  if (!obstacle.exists() &&
      tests.num_units < UnitsNeeded(obstacle.pairs, separate_sessions)) {
    obstacle.kind = Kind::kTooManyPairs;
  }
  if (obstacle.exists()) obstacle.needed = needed;
  return obstacle;
}

Confidence ThatTheyDiffer(const stats::Comparison& tests,
                          const PairComparison& pair,
                          bool separate_sessions) {
  if (UnitsObstacle(tests.num_units, separate_sessions) != Kind::kNone ||
      !IsInReach(tests.num_units, pair)) {
    return Confidence::kOutOfReach;
  }
  const bool bounded =
      pair.one_sided ? pair.bounds.at_most < 0.0 || pair.bounds.at_least > 0.0
                     : pair.bounds.ExcludeZero();
  if (!IsSignificant(pair.p_holm) || !bounded) {
    return pair.correlated && IsSignificant(pair.sign_flip.test.p)
               ? Confidence::kUnitsCorrelated
               : Confidence::kNotShown;
  }
  if (pair.correlated) return Confidence::kUnitsCorrelated;
  if (!IsSignificant(pair.p_memory_holm)) return Confidence::kMemoryNotExcluded;
  // Where it does not apply, the runs do not differ at all.
  const stats::TestResult& blocks = pair.block_t.test;
  return !separate_sessions && blocks.ok() && !IsSignificant(blocks.p)
             ? Confidence::kBlocksDisagree
             : Confidence::kEstablished;
}

Confidence ThatItLosesAtMost(double margin,
                             const stats::Comparison& tests,
                             Index model,
                             Index than,
                             bool separate_sessions) {
  if (UnitsObstacle(tests.num_units, separate_sessions) != Kind::kNone) {
    return Confidence::kOutOfReach;
  }
  const PairComparison& pair = tests.Pair(model, than);
  const bool is_first = pair.a == model;
  if (!(pair.bounds.ExcessAtMost(is_first) <= margin)) {
    return Confidence::kNotShown;
  }
  if (pair.correlated) return Confidence::kUnitsCorrelated;
  return pair.memory.bounds.ExcessAtMost(is_first) <= margin
             ? Confidence::kEstablished
             : Confidence::kMemoryNotExcluded;
}

}  // namespace errmap::models
