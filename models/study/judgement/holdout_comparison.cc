#include "models/study/judgement/holdout_comparison.h"

#include <algorithm>
#include <utility>

#include "models/study/judgement/choice.h"

namespace errmap::models {
namespace {

stats::FoldLosses GatherFolds(const Holdout& holdout,
                              const HeldOutRows& held,
                              const MatrixXd& residuals) {
  const auto folds = std::ssize(holdout.folds);
  stats::FoldLosses losses;
  losses.mean_squares = MatrixXd::Zero(folds, residuals.cols());
  losses.test_rows = VectorXd::Zero(folds);
  losses.train_rows.resize(folds);
  for (std::size_t i = 0; i < held.fold_of.size(); ++i) {
    const auto fold = static_cast<Index>(held.fold_of[i]);
    losses.mean_squares.row(fold) +=
        residuals.row(static_cast<Index>(i)).cwiseAbs2();
    losses.test_rows[fold] += 1.0;
  }
  for (Index fold = 0; fold < folds; ++fold) {
    losses.mean_squares.row(fold) /= losses.test_rows[fold];
    losses.train_rows[fold] = static_cast<double>(
        holdout.folds[static_cast<std::size_t>(fold)].train.size());
  }
  return losses;
}

// Folds come split by split; the lowest pooled RMSE wins each split. A tie
// counts for the earlier model.
std::vector<WinShare> CountWins(const stats::FoldLosses& folds,
                                Index repeats,
                                const StudyResult& study,
                                const std::vector<std::size_t>& models) {
  const Index folds_of_cut = folds.mean_squares.rows() / repeats;
  std::vector<double> wins(models.size(), 0.0);
  for (Index cut = 0; cut < repeats; ++cut) {
    const Index begin = cut * folds_of_cut;
    const Eigen::RowVectorXd sums =
        folds.test_rows.segment(begin, folds_of_cut).transpose() *
        folds.mean_squares.middleRows(begin, folds_of_cut);
    Index best = 0;
    sums.minCoeff(&best);
    wins[static_cast<std::size_t>(best)] += 1.0;
  }
  std::vector<WinShare> shares;
  for (std::size_t m = 0; m < models.size(); ++m) {
    if (wins[m] > 0.0) {
      shares.push_back({study.models[models[m]].name,
                        wins[m] / static_cast<double>(repeats)});
    }
  }
  std::ranges::stable_sort(shares, std::greater(), &WinShare::share);
  return shares;
}

// What a comparison is about before anything is measured: the first blend, or
// the only model that is not a yardstick.
std::optional<Index> FirstInTurn(const StudyResult& study,
                                 const std::vector<std::size_t>& models) {
  std::vector<Index> others;
  for (std::size_t place = 0; place < models.size(); ++place) {
    const ModelResult& model = study.models[models[place]];
    if (ChoiceOf(model) == Choice::kBlend) return static_cast<Index>(place);
    if (!model.baseline) others.push_back(static_cast<Index>(place));
  }
  return others.size() == 1 ? std::optional(others.front()) : std::nullopt;
}

HoldoutComparison CompareOne(const data::Dataset& dataset,
                             const Holdout& holdout,
                             const StudyResult& study,
                             std::size_t index,
                             stats::ComparisonOptions options) {
  HoldoutComparison comparison;
  comparison.holdout = holdout.name;
  for (std::size_t m = 0; m < study.models.size(); ++m) {
    if (!study.models[m].holdouts[index].ok()) continue;
    if (study.models[m].baseline) {
      options.yardsticks.push_back(std::ssize(comparison.models));
    }
    comparison.models.push_back(m);
  }
  if (comparison.models.empty()) return comparison;
  const HeldOutRows held = GatherHeldOut(dataset, holdout);
  MatrixXd residuals(std::ssize(held.rows), std::ssize(comparison.models));
  for (std::size_t m = 0; m < comparison.models.size(); ++m) {
    residuals.col(static_cast<Index>(m)) =
        ResidualsOf(held, study.models[comparison.models[m]].holdouts[index]);
  }
  const std::vector<Index> codes =
      AssignUnits(holdout, held, &comparison.units);
  stats::UnitLosses losses = stats::GatherByUnit(residuals, codes);
  losses.time_ordered = holdout.forward;
  options.first = FirstInTurn(study, comparison.models);
  options.separate_units = comparison.units.separate_sessions;
  comparison.unit_rmse = losses.mean_squares.cwiseSqrt();
  const stats::FoldLosses folds = GatherFolds(holdout, held, residuals);
  comparison.tests = stats::CompareModels(
      losses, folds.test_rows.size() > 1 ? &folds : nullptr, options);
  const bool separate = comparison.units.separate_sessions;
  comparison.obstacle = FindObstacle(comparison.tests, separate);
  for (const stats::PairComparison& pair : comparison.tests.pairs) {
    comparison.differ.push_back(
        ThatTheyDiffer(comparison.tests, pair, separate));
  }
  if (holdout.repeats > 1) {
    comparison.wins =
        CountWins(folds, holdout.repeats, study, comparison.models);
  }
  return comparison;
}

// Ranks how much a hold-out tells of another day, from 0: whole sessions,
// whole groups, another file, whole blocks, few sessions, rows, a file that
// holds training rows. Within a kind, one that judges all sessions comes
// before one that judges only later ones. Sessions count as such from `fewest`
// on.
std::pair<int, bool> RankOf(const Holdout& holdout,
                            const HoldoutComparison& comparison,
                            Index fewest) {
  const auto kind = [&] {
    if (holdout.rows_of_training > 0) return 6;
    if (comparison.units.are_sessions &&
        std::ssize(comparison.units.labels) >= fewest) {
      return 0;
    }
    if (holdout.whole_groups && holdout.test_data == nullptr) return 1;
    if (holdout.test_data != nullptr) return 2;
    if (holdout.inner == InnerHoldout::kBlocks) return 3;
    if (holdout.whole_sessions) return 4;
    return 5;
  };
  return {kind(), holdout.forward};
}

// The first of the hold-outs that tell most.
std::optional<std::size_t> HoldoutThatTellsMost(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons,
    Index fewest_sessions) {
  std::optional<std::size_t> most;
  for (std::size_t h = 0; h < holdouts.size(); ++h) {
    if (comparisons[h].models.empty()) continue;
    if (!most ||
        RankOf(holdouts[h], comparisons[h], fewest_sessions) <
            RankOf(holdouts[*most], comparisons[*most], fewest_sessions)) {
      most = h;
    }
  }
  return most;
}

}  // namespace

std::optional<Index> HoldoutComparison::PlaceOf(std::size_t model) const {
  const auto found = std::ranges::find(models, model);
  if (found == models.end()) return std::nullopt;
  return static_cast<Index>(found - models.begin());
}

int HoldoutComparison::TierOf(std::size_t model) const {
  const auto place = PlaceOf(model);
  if (!place) return 0;
  for (std::size_t tier = 0; tier < tests.tiers.size(); ++tier) {
    if (std::ranges::find(tests.tiers[tier], *place) !=
        tests.tiers[tier].end()) {
      return static_cast<int>(tier) + 1;
    }
  }
  return 0;
}

Confidence HoldoutComparison::ThatItIsBetter(std::size_t model,
                                             std::size_t than) const {
  const Index place = PlaceOf(model).value();
  const stats::PairComparison& pair = tests.Pair(place, PlaceOf(than).value());
  const bool is_better = (pair.difference < 0.0) == (pair.a == place);
  return is_better
             ? differ[static_cast<std::size_t>(&pair - tests.pairs.data())]
             : Confidence::kNotShown;
}

Confidence HoldoutComparison::ThatItLosesAtMost(double margin,
                                                std::size_t model,
                                                std::size_t than) const {
  return models::ThatItLosesAtMost(margin,
                                   tests,
                                   PlaceOf(model).value(),
                                   PlaceOf(than).value(),
                                   units.separate_sessions);
}

std::vector<HoldoutComparison> CompareHoldouts(
    const data::Dataset& dataset,
    const std::vector<Holdout>& holdouts,
    const StudyResult& study,
    double indifference,
    std::uint64_t seed) {
  stats::ComparisonOptions options;
  options.seed = seed;
  options.margin.indifference = indifference;
  std::vector<HoldoutComparison> comparisons;
  for (std::size_t h = 0; h < holdouts.size(); ++h) {
    comparisons.push_back(CompareOne(dataset, holdouts[h], study, h, options));
  }
  return comparisons;
}

std::optional<std::size_t> StrictestHoldout(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons) {
  constexpr Index kFewestSessions = 2;
  return HoldoutThatTellsMost(holdouts, comparisons, kFewestSessions);
}

std::optional<std::size_t> DecisiveHoldout(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons) {
  return HoldoutThatTellsMost(holdouts, comparisons, kFewestSessionsToDecide);
}

const HoldoutComparison* ForwardOverSessions(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons) {
  for (std::size_t h = 0; h < holdouts.size(); ++h) {
    if (holdouts[h].forward && comparisons[h].units.are_sessions &&
        !comparisons[h].models.empty()) {
      return &comparisons[h];
    }
  }
  return nullptr;
}

}  // namespace errmap::models
