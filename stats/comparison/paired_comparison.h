#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "stats/comparison/mean_difference.h"
#include "stats/comparison/memory_bounds.h"
#include "stats/comparison/sign_flip.h"
#include "stats/comparison/signed_rank.h"
#include "stats/comparison/tiers.h"
#include "stats/comparison/unit_bootstrap.h"
#include "stats/comparison/unit_losses.h"

namespace errmap::stats {

/// Level of every test, after Holm's adjustment where one is made.
inline constexpr double kSignificance = 0.05;

/// Runs of neighbouring units, as equal as can be, longer ones first.
inline constexpr Eigen::Index kBlocksOfUnits = 5;

/// Fewer effective units bound no RMSE.
inline constexpr double kFewestForBounds = 4.0;

/// Mean held-out losses by fold, for the corrected resampled t.
struct FoldLosses {
  Eigen::MatrixXd mean_squares;  // (folds, of all repeats, x models)
  Eigen::VectorXd test_rows;     // (folds), above 0
  Eigen::VectorXd train_rows;    // (folds), above 0
};

struct ComparisonOptions {
  std::uint64_t seed = 1;
  Eigen::Index flips = 9999;      // sign patterns drawn where too many; >= 1
  Eigen::Index resamples = 4999;  // of the bootstrap; >= 99
  Eigen::Index horizon = 1;       // of Diebold-Mariano; >= 1
  Margin margin = {};             // between tiers
  /// Units are known to be separate sessions. Memory from one to the next is
  /// then allowed for in `p` only where it is larger than chance, and else
  /// tested with kSessionMemory instead of all that cannot be excluded.
  bool separate_units = false;
  /// What the comparison is about and, in this order, the models that it must
  /// beat (columns of the losses). Chosen before the losses are seen, these
  /// pairs are tested one by one, each at the full level, until one is not
  /// shown; all other pairs only then, by Holm's adjustment. So the chance of
  /// any false one among all pairs is at most the level (a fixed sequence, then
  /// a gate: Maurer, Hothorn & Lehmacher 1995). Nothing: one adjustment of all.
  std::optional<Eigen::Index> first = {};
  std::vector<Eigen::Index> yardsticks = {};

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

/// Model a against model b; d = loss of a - loss of b, one mean per unit
/// weighted by its rows, so that the mean of d is the difference of the pooled
/// mean squares: below 0 where a is better, as `difference` is. What these
/// figures establish is decided in one place,
/// models/study/judgement/confidence.h.
struct PairComparison {
  Eigen::Index a = 0;
  Eigen::Index b = 0;
  double difference = 0.0;  // pooled RMSE of a less that of b
  /// No unit's losses differ by more than rounding: one map twice. Then nothing
  /// is tested, every p is NaN, and the pair does not count in Holm's.
  bool tied = false;
  /// Of `difference`: bootstrap over units, and where memory_shown is above 0
  /// the wider of that and the bounds of a t with so much memory.
  Bounds95 bounds;
  SignFlipTest sign_flip;  // of d
  /// sign_flip's, or where memory_shown is above 0 the larger of that and the p
  /// of a t with so much memory.
  double p = 1.0;
  double memory_shown = 0.0;  // ShownMemory of d; see separate_units
  double p_holm = 1.0;        // p in its turn: see ComparisonOptions::first
  /// Pairs that Holm's adjustment counts with it; 1: none, it has a turn.
  Eigen::Index num_adjusted = 0;
  /// Of `difference`, with the memory from unit to unit that cannot be
  /// excluded, and its p in its turn.
  MemoryTest memory;
  double p_memory_holm = 1.0;
  /// Corrected resampled t of d on kBlocksOfUnits runs of neighbouring units,
  /// as if each were held out in turn, whatever the hold-out was: it sees
  /// memory that noise hides from the correlation of neighbours.
  MeanDifferenceTest block_t;
  SignedRankTest wilcoxon;                            // of d
  std::optional<MeanDifferenceTest> corrected_t;      // where folds are given
  std::optional<MeanDifferenceTest> diebold_mariano;  // where time-ordered
  /// Lag-1 correlation of d in the order of units, p two-sided.
  TestResult lag1;
  /// It is larger than chance (p <= 5 %) and positive: neighbouring units
  /// resemble each other. All tests but those of `p` and `memory` then find too
  /// much.
  bool correlated = false;
};

/// All models against each other on the same units.
struct Comparison {
  Eigen::Index num_units = 0;
  Eigen::VectorXd rmse;  // (models) pooled over rows
  /// (models) None where neighbouring units resemble each other so much that
  /// they are worth fewer than kFewestForBounds: what was measured is then too
  /// little of what there is.
  std::vector<Bounds95> rmse_bounds;
  std::vector<PairComparison> pairs;  // (0,1), (0,2), ..., (1,2), ...
  std::vector<std::vector<Eigen::Index>> tiers;  // see FormTiers

  /// Pairs that Holm's adjustment counts; and if none were tied, which depends
  /// on nothing found. 0 where it counts pairs of yardsticks alone.
  Eigen::Index num_tested = 0;
  Eigen::Index num_asked = 0;

  /// The pair of two different models, whichever is a. Throws
  /// std::out_of_range where there is none.
  const PairComparison& Pair(Eigen::Index one, Eigen::Index other) const;
  /// One-sided 95 % upper bound of RMSE of `model` less that of `than`.
  double ExcessAtMost(Eigen::Index model, Eigen::Index than) const;
};

/// Compares all models of `losses` by every test that applies; `folds` (the
/// same models) may be null. The same losses, options and seed give the same
/// result. Throws std::invalid_argument for invalid losses, folds or options.
Comparison CompareModels(const UnitLosses& losses,
                         const FoldLosses* folds,
                         const ComparisonOptions& options);

}  // namespace errmap::stats
