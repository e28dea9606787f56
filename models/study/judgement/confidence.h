#pragma once

#include <string_view>

#include <Eigen/Core>

#include "stats/comparison/paired_comparison.h"

namespace errmap::models {

/// Whether a statement about two models is more than chance, "established",
/// and else the first thing that it lacks. This is the only place that decides
/// so: tables, sentences and JSON show what is found here.
enum class Confidence {
  kEstablished,
  kOutOfReach,         // see Obstacle
  kNotShown,           // the test or a bound does not show it
  kUnitsCorrelated,    // shown as if units were independent, which they are not
  kMemoryNotExcluded,  // ... which few units cannot tell from memory
  kBlocksDisagree,     // ... and runs of neighbouring units differ too much
};

/// "established", "out of reach", "not shown", "units correlated",
/// "memory not excluded", "blocks disagree".
std::string_view ToString(Confidence confidence);

/// Fewer units establish nothing: with 5, the two of 2^5 sign patterns that
/// are most extreme already have p = 0.0625.
inline constexpr Eigen::Index kFewestUnits = 6;
/// Fewer units establish nothing unless each is a session of its own: too few
/// to see whether they resemble their neighbours.
inline constexpr Eigen::Index kFewestUnitsOfOneSession = 12;

/// Why of the pairs that Holm's adjustment counts not even the clearest
/// difference could be established.
struct Obstacle {
  enum class Kind {
    kNone,
    kTooFewUnits,         // kFewestUnits are needed
    kPerhapsOneSession,   // kFewestUnitsOfOneSession are needed
    kTooManyPairs,        // for so few units, after Holm's adjustment
    kTooFewSignPatterns,  // drawn, for so many pairs
  };
  Kind kind = Kind::kNone;
  Eigen::Index units = 0;
  Eigen::Index needed = 0;  // units that would do; 0 for kTooFewSignPatterns
  Eigen::Index pairs = 0;

  bool exists() const { return kind != Kind::kNone; }
};

/// "none", "too few units", "perhaps one session", "too many pairs",
/// "too few sign patterns".
std::string_view ToString(Obstacle::Kind kind);

/// `separate_sessions`: every unit is known to be a session of its own (a day,
/// a shift), so that nothing but chance makes neighbours alike.
Obstacle FindObstacle(const stats::Comparison& tests, bool separate_sessions);

/// That the models of `pair`, one of tests.pairs, differ: in its turn
/// (stats::ComparisonOptions::first) p is at most 5 %, and so is that of the t
/// with the memory that cannot be excluded (memory_bounds.h); the interval of
/// the RMSE difference lies wholly on one side of 0; no sign that neighbours
/// resemble each other; units enough. Where they may be of one session, the
/// corrected resampled t on runs of neighbouring units has to agree.
Confidence ThatTheyDiffer(const stats::Comparison& tests,
                          const stats::PairComparison& pair,
                          bool separate_sessions);

/// That the RMSE of `model` is above that of `than` by at most `margin`: the
/// one-sided 95 % upper bounds, resampled and with memory, are within it, there
/// is no sign that neighbours resemble each other, and there are enough units.
Confidence ThatItLosesAtMost(double margin,
                             const stats::Comparison& tests,
                             Eigen::Index model,
                             Eigen::Index than,
                             bool separate_sessions);

}  // namespace errmap::models
