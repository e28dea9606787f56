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
  /// Models (columns of the losses) that the others are only held against: what
  /// they add to a comparison takes nothing from the others' power. Holm's
  /// adjustment counts the pairs of the others; the pairs of the others with
  /// each yardstick; the pairs of yardsticks.
  std::vector<Eigen::Index> yardsticks = {};

  /// Throws std::invalid_argument naming field, value and range.
  void Validate() const;
};

/// Model a against model b; d = loss of a - loss of b, one mean per unit, so
/// below 0 where a is better. What these figures establish is decided in one
/// place, models/study/judgement/confidence.h.
struct PairComparison {
  Eigen::Index a = 0;
  Eigen::Index b = 0;
  double difference = 0.0;  // pooled RMSE of a less that of b
  /// No unit's losses differ by more than rounding: one map twice. Then nothing
  /// is tested, every p is NaN, and the pair does not count in Holm's.
  bool tied = false;
  Bounds95 bounds;                // of `difference`, bootstrap over units
  SignFlipTest sign_flip;         // of d
  double p_holm = 1.0;            // sign_flip's p among num_adjusted
  Eigen::Index num_adjusted = 0;  // pairs that Holm's adjustment counts with it
  /// Of `difference`, with the memory from unit to unit that their order cannot
  /// exclude, and its p among num_adjusted.
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
  /// resemble each other, and every p here is too small.
  bool correlated = false;
};

/// All models against each other on the same units.
struct Comparison {
  Eigen::Index num_units = 0;
  Eigen::VectorXd rmse;               // (models) pooled over rows
  std::vector<Bounds95> rmse_bounds;  // (models)
  std::vector<PairComparison> pairs;  // (0,1), (0,2), ..., (1,2), ...
  std::vector<std::vector<Eigen::Index>> tiers;  // see FormTiers

  /// Of the pairs that hold a model that is no yardstick, the most that one
  /// adjustment counts; and if none were tied, which depends on nothing found.
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
