#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "stats/comparison/ar1_t_test.h"
#include "stats/comparison/mean_difference.h"
#include "stats/comparison/sign_flip.h"
#include "stats/comparison/signed_rank.h"
#include "stats/comparison/tiers.h"
#include "stats/comparison/unit_bootstrap.h"
#include "stats/comparison/unit_losses.h"
#include "stats/eigen.h"

namespace errmap::stats {

/// Level of every test, after Holm's correction if there is one.
inline constexpr double kSignificance = 0.05;

/// Number of runs of neighbouring units, of nearly equal length, longer ones
/// first.
inline constexpr Index kBlocksOfUnits = 5;

/// Mean held-out losses by fold, for the corrected resampled t.
struct FoldLosses {
  MatrixXd mean_squares;  // (folds, of all repeats, x models)
  VectorXd test_rows;     // (folds), above 0
  VectorXd train_rows;    // (folds), above 0
};

struct ComparisonOptions {
  std::uint64_t seed = 1;
  Index flips = 9999;      // drawn if not all are counted; >= 1
  Index resamples = 4999;  // of the bootstrap; >= 99
  Margin margin = {};      // between tiers
  /// True if the units are known to be separate sessions. `p` then allows for
  /// memory between them only if it exceeds chance. The `memory` test uses
  /// kSessionMemory instead of the upper bound of the memory. Pairs tested in
  /// turn use the PointOptimalTest with kSessionMemoryInTurn.
  bool separate_units = false;
  /// `first` is the model of interest, `yardsticks` the models that it must
  /// beat (columns of the losses), chosen before the losses are seen. These
  /// pairs are tested in turn until one fails: the yardstick of lowest measured
  /// error first, each one-sided at the full level. All other pairs follow,
  /// with Holm's correction.
  ///
  /// The chance of any false rejection among all pairs is at most the level.
  /// Among the yardsticks that are truly no worse, the first one tested shows
  /// the smallest gain. If that gain is significant, so is the gain over the
  /// one with the least scatter: one fixed test. (A sequence, then a gate:
  /// Maurer, Hothorn & Lehmacher 1995.) If unset, all pairs are adjusted
  /// together.
  std::optional<Index> first = {};
  std::vector<Index> yardsticks = {};

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

/// Model a against model b. The differences d = loss of a - loss of b are
/// one mean per unit, weighted by its rows. Their mean is the difference of
/// the pooled mean squares. d and `difference` are below 0 if a is better.
/// Only models/study/judgement/confidence.h decides what these figures
/// establish.
struct PairComparison {
  Index a = 0;
  Index b = 0;
  double difference = 0.0;  // pooled RMSE of a minus that of b
  /// True if no unit's losses differ by more than rounding: the two are the
  /// same map. Such a pair is not tested, every p is NaN, and Holm's correction
  /// omits it.
  bool tied = false;
  /// Bounds of `difference` by the bootstrap over units. If memory_shown is
  /// above 0: the wider of these and the bounds of a t test with that memory.
  Bounds95 bounds;
  SignFlipTest sign_flip;  // of d
  /// p of sign_flip. If memory_shown is above 0: the larger of that and the p
  /// of a t test with that memory.
  double p = 1.0;
  double memory_shown = 0.0;  // ShownMemory of d; see separate_units
  double p_holm = 1.0;        // p adjusted, see ComparisonOptions::first
  /// True if p_holm and p_memory_holm are one-sided: that `first` is better.
  bool one_sided = false;
  /// Number of pairs in its Holm correction; 1 if it was tested in turn.
  Index num_adjusted = 0;
  /// t test of `difference` with the upper bound of the memory between units
  /// (or kSessionMemory).
  MemoryTest memory;
  /// p of that test, or of the PointOptimalTest (see separate_units), adjusted
  /// like `p_holm`.
  double p_memory_holm = 1.0;
  /// Corrected resampled t test of d on kBlocksOfUnits runs of neighbouring
  /// units, as if each run were held out in turn, whatever the hold-out was. It
  /// detects memory that noise hides in the correlation of neighbours.
  MeanDifferenceTest block_t;
  SignedRankTest wilcoxon;                            // of d
  std::optional<MeanDifferenceTest> corrected_t;      // if there are folds
  std::optional<MeanDifferenceTest> diebold_mariano;  // if time-ordered
  /// Lag-1 autocorrelation of d in the order of units; p is two-sided.
  TestResult lag1;
  /// True if lag1 is significant (p <= 5 %) and positive: neighbouring units
  /// resemble each other. All tests but `p` and `memory` then reject too
  /// often.
  bool correlated = false;
};

/// All models against each other on the same units.
struct Comparison {
  Index num_units = 0;
  VectorXd rmse;  // (models) pooled over rows
  /// (models) By the UnitBootstrap, and at least those of MeanSquareBounds for
  /// the units' mean errors, since what is measured may vary less than what is
  /// to come. NaN if the upper one is above ten times the RMSE.
  std::vector<Bounds95> rmse_bounds;
  std::vector<PairComparison> pairs;      // (0,1), (0,2), ..., (1,2), ...
  std::vector<std::vector<Index>> tiers;  // see FormTiers

  /// Number of pairs in Holm's correction, and that number without ties, which
  /// does not depend on the results. 0 if only yardstick pairs remain.
  Index num_tested = 0;
  Index num_asked = 0;

  /// Returns the pair of two different models, in either order. Throws
  /// std::out_of_range if there is no such pair.
  const PairComparison& Pair(Index one, Index other) const;
};

/// Compares all models of `losses` by every test that applies; `folds` (the
/// same models) may be null. The same arguments give the same result. Throws
/// std::invalid_argument if losses, folds or options are invalid.
Comparison CompareModels(const UnitLosses& losses,
                         const FoldLosses* folds,
                         const ComparisonOptions& options);

}  // namespace errmap::stats
