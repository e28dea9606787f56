#pragma once

#include <string_view>

#include "stats/comparison/paired_comparison.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Result of the significance checks on two models: established, or the first
/// check that failed. Decided only here: tables, sentences and JSON show this
/// result.
enum class Confidence {
  kEstablished,
  kOutOfReach,         // see Obstacle
  kNotShown,           // the test or a bound does not show it
  kUnitsCorrelated,    // shown, but only for independent units
  kMemoryNotExcluded,  // shown, but so few units do not exclude memory
  kBlocksDisagree,     // shown, but runs of neighbouring units differ
};

/// "established", "out of reach", "not shown", "units correlated",
/// "memory not excluded", "blocks disagree".
std::string_view ToString(Confidence confidence);

/// Fewer units establish nothing: with 5, the two most extreme of the 2^5 sign
/// patterns already have p = 0.0625.
inline constexpr Index kFewestUnits = 6;
/// The same for units that may not be separate sessions: fewer do not show
/// whether neighbours resemble each other.
inline constexpr Index kFewestUnitsOfOneSession = 12;

/// Reason why not even the clearest difference could be established among the
/// pairs in Holm's adjustment.
struct Obstacle {
  enum class Kind {
    kNone,
    kTooFewUnits,         // needs kFewestUnits
    kPerhapsOneSession,   // needs kFewestUnitsOfOneSession
    kTooManyPairs,        // for so few units, after Holm's adjustment
    kTooFewSignPatterns,  // drawn, for this number of pairs
  };
  Kind kind = Kind::kNone;
  Index units = 0;
  Index needed = 0;  // enough units; 0 for kTooFewSignPatterns
  Index pairs = 0;

  bool exists() const { return kind != Kind::kNone; }
};

/// "none", "too few units", "perhaps one session", "too many pairs",
/// "too few sign patterns".
std::string_view ToString(Obstacle::Kind kind);

/// `separate_sessions`: each unit is known to be a separate session (a day, a
/// shift), so that neighbours resemble each other only by chance.
Obstacle FindObstacle(const stats::Comparison& tests, bool separate_sessions);

/// Checks whether the models of `pair`, one of tests.pairs, differ. Established
/// requires all of these. p is at most 5 % when its turn comes
/// (stats::ComparisonOptions::first), also for the t test with the memory that
/// cannot be excluded (ar1_t_test.h). The interval of the RMSE difference,
/// or its one-sided bound, excludes 0. Neighbours do not resemble each other,
/// and there are enough units. If they may be of one session, the corrected
/// resampled t on runs of neighbouring units must agree.
Confidence ThatTheyDiffer(const stats::Comparison& tests,
                          const stats::PairComparison& pair,
                          bool separate_sessions);

/// Checks whether the RMSE of `model` exceeds that of `than` by at most
/// `margin`. Both one-sided 95 % upper bounds, resampled and with memory, must
/// be within it. The errors of neighbouring units must not be correlated, and
/// there must be enough units.
Confidence ThatItLosesAtMost(double margin,
                             const stats::Comparison& tests,
                             Index model,
                             Index than,
                             bool separate_sessions);

}  // namespace errmap::models
