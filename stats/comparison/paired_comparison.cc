#include "stats/comparison/paired_comparison.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "stats/comparison/holm.h"
#include "stats/comparison/mean_square_bounds.h"
#include "stats/comparison/point_optimal.h"
#include "stats/not_a_number.h"
#include "stats/randomness.h"
#include "stats/require.h"

namespace errmap::stats {
namespace {

// The place of pair a < b of `models` in (0,1), (0,2), ..., (1,2), ...
Index PairIndex(Index a, Index b, Index models) {
  return a * (2 * models - a - 1) / 2 + (b - a - 1);
}

std::vector<PairComparison> AllPairs(Index models) {
  std::vector<PairComparison> pairs;
  for (Index a = 0; a < models; ++a) {
    for (Index b = a + 1; b < models; ++b) {
      pairs.emplace_back();
      pairs.back().a = a;
      pairs.back().b = b;
    }
  }
  return pairs;
}

// Contribution of each unit to the difference of each pair (units x pairs).
MatrixXd Differences(const UnitLosses& losses,
                     const std::vector<PairComparison>& pairs) {
  std::vector<Index> first;
  std::vector<Index> second;
  for (const PairComparison& pair : pairs) {
    first.push_back(pair.a);
    second.push_back(pair.b);
  }
  return losses.Differences(first, second);
}

void CheckFolds(const FoldLosses& folds, Index models) {
  const Index num = folds.mean_squares.rows();
  if (folds.mean_squares.cols() != models || folds.test_rows.size() != num ||
      folds.train_rows.size() != num) {
    throw std::invalid_argument(
        "FoldLosses: " + std::to_string(num) + " folds of " +
        std::to_string(folds.mean_squares.cols()) + " models with " +
        std::to_string(folds.test_rows.size()) + " numbers of test rows and " +
        std::to_string(folds.train_rows.size()) + " of training rows for " +
        std::to_string(models) + " models");
  }
  if (!folds.mean_squares.allFinite() ||
      !(folds.mean_squares.array() >= 0.0).all()) {
    throw std::invalid_argument(
        "FoldLosses: every mean square must be finite and at least 0");
  }
  if (!folds.test_rows.allFinite() || !folds.train_rows.allFinite() ||
      !(folds.test_rows.array() > 0.0).all() ||
      !(folds.train_rows.array() > 0.0).all()) {
    throw std::invalid_argument(
        "FoldLosses: every number of rows must be finite and above 0");
  }
}

void TestFolds(const FoldLosses& folds, std::vector<PairComparison>* pairs) {
  const double test_to_train =
      folds.test_rows.size() == 0
          ? 0.0
          : folds.test_rows.sum() / folds.train_rows.sum();
  const MatrixXd differences = Differences(
      {.mean_squares = folds.mean_squares, .rows = folds.test_rows}, *pairs);
  for (std::size_t i = 0; i < pairs->size(); ++i) {
    (*pairs)[i].corrected_t = CorrectedResampledT(
        differences.col(static_cast<Index>(i)), test_to_train);
  }
}

// If noise hides a memory of 0.9 in 35 units, 1/4, as for five folds, would
// give 5.4 and 6.0 % of false differences (normal units, t3; 1000 studies);
// this gives 4.5 and 5.3 %. It finds a difference of one standard deviation in
// 82 and 84 % of the cases, 1/4 in 85 and 87 %
// (tests/benchmarks/confidence_study.cc).
constexpr double kBlocksTestToTrain = 0.3;

// Losses of runs of neighbouring units.
UnitLosses GatherBlocks(const UnitLosses& losses) {
  const Index units = losses.num_units();
  const Index blocks = std::min(units, kBlocksOfUnits);
  UnitLosses gathered{.mean_squares = MatrixXd(blocks, losses.num_models()),
                      .rows = VectorXd::Ones(blocks)};
  Index begin = 0;
  for (Index block = 0; block < blocks; ++block) {
    const Index length = units / blocks + (block < units % blocks ? 1 : 0);
    const VectorXd rows = losses.rows.segment(begin, length);
    gathered.mean_squares.row(block) =
        rows.transpose() * losses.mean_squares.middleRows(begin, length) /
        rows.sum();
    begin += length;
  }
  return gathered;
}

// Losses are sums of squares of what differs by the last digits of a fit.
bool AreTied(const UnitLosses& losses, const PairComparison& pair) {
  constexpr double kRounding = 1e-9;
  if (losses.num_units() == 0) return false;
  const VectorXd one = losses.mean_squares.col(pair.a);
  const VectorXd other = losses.mean_squares.col(pair.b);
  return ((one - other).array().abs() <=
          kRounding * one.array().max(other.array()))
      .all();
}

void TestUnits(const UnitLosses& losses,
               const ComparisonOptions& options,
               std::vector<PairComparison>* pairs) {
  const MatrixXd differences = Differences(losses, *pairs);
  const MatrixXd of_blocks = Differences(GatherBlocks(losses), *pairs);
  const std::vector<SignFlipTest> flipped =
      TestBySignFlips(differences, options.flips, options.seed);
  for (std::size_t i = 0; i < pairs->size(); ++i) {
    const VectorXd d = differences.col(static_cast<Index>(i));
    PairComparison& pair = (*pairs)[i];
    pair.sign_flip = flipped[i];
    pair.tied = AreTied(losses, pair);
    pair.wilcoxon = TestSignedRanks(d);
    pair.block_t = CorrectedResampledT(of_blocks.col(static_cast<Index>(i)),
                                       kBlocksTestToTrain);
    if (losses.time_ordered) {
      pair.diebold_mariano = DieboldMariano(d);
    }
    pair.lag1 = TestSerially({d}).lag1;
    pair.correlated = pair.lag1.p <= kSignificance && pair.lag1.statistic > 0.0;
  }
}

// The largest p of the pairs whose turn is over: none after them is below it.
struct Gates {
  double p = 0.0;
  double p_memory = 0.0;
};

// Of a test whose direction was fixed before: that `first` is better.
double OneSided(double two_sided, const PairComparison& pair, Index first) {
  const bool better = (pair.a == first) == (pair.difference < 0.0);
  return better ? 0.5 * two_sided : 1.0 - 0.5 * two_sided;
}

void AdjustInTurn(Index first,
                  double p_memory,
                  PairComparison* pair,
                  Gates* gates) {
  gates->p = std::max(OneSided(pair->p, *pair, first), gates->p);
  gates->p_memory = std::max(p_memory, gates->p_memory);
  pair->p_holm = gates->p;
  pair->p_memory_holm = gates->p_memory;
  pair->num_adjusted = 1;
  pair->one_sided = true;
}

void AdjustTogether(const std::vector<PairComparison*>& pairs,
                    const Gates& gates) {
  std::vector<double> p;
  std::vector<double> p_memory;
  for (const PairComparison* pair : pairs) {
    p.push_back(pair->p);
    p_memory.push_back(pair->memory.test.p);
  }
  const std::vector<double> adjusted = AdjustByHolm(p);
  const std::vector<double> memory_adjusted = AdjustByHolm(p_memory);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pairs[i]->p_holm = std::max(adjusted[i], gates.p);
    pairs[i]->p_memory_holm = std::max(memory_adjusted[i], gates.p_memory);
    pairs[i]->num_adjusted = std::ssize(pairs);
  }
}

// One-sided p (yardsticks) that `first` is better, with the memory that cannot
// be excluded.
std::vector<double> MemoryPsInTurn(const UnitLosses& losses,
                                   const ComparisonOptions& options,
                                   const std::vector<Index>& yardsticks,
                                   const Comparison& comparison) {
  // Different from the draws of the sign flips.
  constexpr std::uint64_t kOwnSequence = 0xd1b54a32d192ed03U;
  std::vector<double> p;
  if (yardsticks.empty()) return p;
  const Index first = *options.first;
  if (!options.separate_units || losses.num_units() < 2) {
    for (const Index yardstick : yardsticks) {
      const PairComparison& pair = comparison.Pair(first, yardstick);
      p.push_back(OneSided(pair.memory.test.p, pair, first));
    }
    return p;
  }
  const PointOptimalTest test(losses.num_units(),
                              kSessionMemoryInTurn,
                              options.flips,
                              options.seed ^ kOwnSequence);
  const MatrixXd errors = InfluenceOnRmse(losses, comparison.rmse).rowwise() +
                          comparison.rmse.transpose();
  for (const Index yardstick : yardsticks) {
    p.push_back(test.P(errors.col(yardstick) - errors.col(first)));
  }
  return p;
}

// Those that have a turn, the one of lowest error first.
std::vector<Index> YardsticksInTurn(const ComparisonOptions& options,
                                    const Comparison& comparison) {
  if (!options.first) return {};
  std::vector<Index> yardsticks = options.yardsticks;
  std::erase(yardsticks, *options.first);
  std::ranges::stable_sort(yardsticks, {}, [&](Index yardstick) {
    return comparison.rmse[yardstick];
  });
  return yardsticks;
}

void AdjustInOrder(const UnitLosses& losses,
                   const ComparisonOptions& options,
                   Comparison* comparison) {
  std::vector<PairComparison*> rest;
  for (PairComparison& pair : comparison->pairs) rest.push_back(&pair);
  Gates gates;
  const std::vector<Index> yardsticks = YardsticksInTurn(options, *comparison);
  const std::vector<double> p_memory =
      MemoryPsInTurn(losses, options, yardsticks, *comparison);
  for (std::size_t i = 0; i < yardsticks.size(); ++i) {
    const auto [a, b] = std::minmax(*options.first, yardsticks[i]);
    PairComparison& pair = comparison->pairs[static_cast<std::size_t>(
        PairIndex(a, b, comparison->rmse.size()))];
    std::erase(rest, &pair);
    if (!pair.tied) AdjustInTurn(*options.first, p_memory[i], &pair, &gates);
  }
  const auto is_yardstick = [&](Index model) {
    return std::ranges::find(options.yardsticks, model) !=
           options.yardsticks.end();
  };
  // Nobody asks which of the yardsticks is the better one.
  const bool is_asked =
      std::ranges::any_of(rest, [&](const PairComparison* pair) {
        return !(is_yardstick(pair->a) && is_yardstick(pair->b));
      });
  comparison->num_asked = is_asked ? std::ssize(rest) : 0;
  std::erase_if(rest, [](const PairComparison* pair) { return pair->tied; });
  comparison->num_tested = is_asked ? std::ssize(rest) : 0;
  AdjustTogether(rest, gates);
}

void ForgetTests(PairComparison* pair) {
  for (double* p : {&pair->sign_flip.test.p,
                    &pair->p,
                    &pair->p_holm,
                    &pair->memory.test.p,
                    &pair->p_memory_holm,
                    &pair->block_t.test.p,
                    &pair->wilcoxon.test.p}) {
    *p = kNaN;
  }
  for (auto* test : {&pair->corrected_t, &pair->diebold_mariano}) {
    if (*test) (*test)->test.p = kNaN;
  }
}

MatrixXd ExcessBounds(const Comparison& comparison) {
  const Index models = comparison.rmse.size();
  MatrixXd bounds = MatrixXd::Zero(models, models);
  for (const PairComparison& pair : comparison.pairs) {
    bounds(pair.a, pair.b) = pair.bounds.ExcessAtMost(true);
    bounds(pair.b, pair.a) = pair.bounds.ExcessAtMost(false);
  }
  return bounds;
}

// Widens bounds of an RMSE to those of the units to come, if those measured may
// be alike by chance. Units differ in their means; what is within them adds.
Bounds95 WidenForMemory(const Bounds95& bounds,
                        double rmse,
                        const VectorXd& means,
                        const VectorXd& rows,
                        MeanSquareBounds* to_come) {
  const double memory = to_come->LargestMemory(means);
  if (!(memory > 0.0)) return bounds;
  const double between = rows.dot(means.cwiseAbs2()) / rows.sum();
  const double within = std::max(0.0, rmse * rmse - between);
  return Wider(bounds, to_come->OfRoot(means, memory, within));
}

void BoundErrors(const UnitLosses& losses,
                 const ComparisonOptions& options,
                 Comparison* comparison) {
  // Different from the draws of the sign flips.
  constexpr std::uint64_t kOwnSequence = 0x9e3779b97f4a7c15U;
  constexpr std::uint64_t kSequenceToCome = 0xbf58476d1ce4e5b9U;
  const UnitBootstrap bootstrap(
      losses, options.resamples, options.seed ^ kOwnSequence);
  const Ar1TTest with_memory(losses);
  // From so much upwards the units tell nothing of the error.
  constexpr double kMostTimes = 10.0;
  MeanSquareBounds to_come(losses.num_units(), options.seed ^ kSequenceToCome);
  for (Index model = 0; model < losses.num_models(); ++model) {
    const double rmse = comparison->rmse[model];
    Bounds95 bounds = bootstrap.OfRmse(model, with_memory.Worth(model));
    if (bounds.exist() && losses.means.size() > 0) {
      bounds = WidenForMemory(
          bounds, rmse, losses.means.col(model), losses.rows, &to_come);
    }
    if (bounds.upper > kMostTimes * rmse) bounds = {};
    comparison->rmse_bounds.push_back(bounds);
  }
  for (PairComparison& pair : comparison->pairs) {
    pair.difference = comparison->rmse[pair.a] - comparison->rmse[pair.b];
    pair.bounds = bootstrap.OfDifference(pair.a, pair.b);
    pair.memory = with_memory.OfDifference(
        pair.a,
        pair.b,
        options.separate_units
            ? kSessionMemory
            : with_memory.InDifference(pair.a, pair.b, kMostMemory));
    pair.p = pair.sign_flip.test.p;
    const bool may_show = !options.separate_units || pair.correlated;
    if (may_show) {
      pair.memory_shown = with_memory.ShownInDifference(pair.a, pair.b);
    }
    if (pair.memory_shown == 0.0) continue;
    const MemoryTest likely =
        with_memory.OfDifference(pair.a, pair.b, pair.memory_shown);
    pair.p = std::max(pair.p, likely.test.p);
    pair.bounds = Wider(pair.bounds, likely.bounds);
  }
}

}  // namespace

void ComparisonOptions::Validate() const {
  Require(flips >= 1, "ComparisonOptions: flips must be at least 1", flips);
  Require(resamples >= 99,
          "ComparisonOptions: resamples must be at least 99",
          resamples);
  margin.Validate();
}

const PairComparison& Comparison::Pair(Index one, Index other) const {
  const Index models = rmse.size();
  const auto [a, b] = std::minmax(one, other);
  if (a < 0 || b >= models || a == b) {
    throw std::out_of_range(
        "Comparison: no pair of models " + std::to_string(one) + " and " +
        std::to_string(other) + " of " + std::to_string(models));
  }
  return pairs[static_cast<std::size_t>(PairIndex(a, b, models))];
}

Comparison CompareModels(const UnitLosses& losses,
                         const FoldLosses* folds,
                         const ComparisonOptions& options) {
  options.Validate();
  losses.Validate();
  if (folds != nullptr) CheckFolds(*folds, losses.num_models());
  Comparison comparison;
  comparison.num_units = losses.num_units();
  comparison.pairs = AllPairs(losses.num_models());
  if (losses.num_units() == 0) {
    comparison.rmse = VectorXd::Constant(losses.num_models(), kNaN);
  } else {
    comparison.rmse = PooledRmse(losses);
  }
  TestUnits(losses, options, &comparison.pairs);
  BoundErrors(losses, options, &comparison);
  AdjustInOrder(losses, options, &comparison);
  if (folds != nullptr) TestFolds(*folds, &comparison.pairs);
  for (PairComparison& pair : comparison.pairs) {
    if (pair.tied) ForgetTests(&pair);
  }
  if (losses.num_units() > 0) {
    comparison.tiers =
        FormTiers(comparison.rmse, ExcessBounds(comparison), options.margin);
  }
  return comparison;
}

}  // namespace errmap::stats
