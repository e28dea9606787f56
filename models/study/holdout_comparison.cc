#include "models/study/holdout_comparison.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "stats/error_metrics.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

// Every held-out row of every fold, in the order of the folds.
struct HeldOut {
  const data::Dataset* source = nullptr;
  std::vector<Index> rows;           // index into source
  std::vector<std::size_t> fold_of;  // fold of each
};

HeldOut GatherHeldOut(const data::Dataset& dataset, const Holdout& holdout) {
  HeldOut held;
  held.source =
      holdout.test_data != nullptr ? holdout.test_data.get() : &dataset;
  for (std::size_t fold = 0; fold < holdout.folds.size(); ++fold) {
    const Index size =
        holdout.test_data != nullptr
            ? held.source->num_rows()
            : static_cast<Index>(holdout.folds[fold].test.size());
    for (Index i = 0; i < size; ++i) {
      held.rows.push_back(
          holdout.test_data != nullptr
              ? i
              : holdout.folds[fold].test[static_cast<std::size_t>(i)]);
      held.fold_of.push_back(fold);
    }
  }
  return held;
}

// (held-out rows x models)
MatrixXd GatherResiduals(const HeldOut& held,
                         const StudyResult& study,
                         const std::vector<std::size_t>& models,
                         std::size_t holdout) {
  MatrixXd residuals(static_cast<Index>(held.rows.size()),
                     static_cast<Index>(models.size()));
  for (std::size_t m = 0; m < models.size(); ++m) {
    Index at = 0;
    const HoldoutResult& result = study.models[models[m]].holdouts[holdout];
    for (const FoldResult& fold : result.folds) {
      for (const double predicted : fold.test_predictions) {
        const Index row = held.rows[static_cast<std::size_t>(at)];
        residuals(at++, static_cast<Index>(m)) =
            held.source->target_values()[row] - predicted;
      }
    }
  }
  return residuals;
}

// Takes the units that `codes`, one per row of the source, number. One unit
// alone is none: its rows are all that there is to resample.
bool TakeUnits(const HeldOut& held,
               const std::vector<Index>& codes,
               const data::Grouping& grouping,
               std::vector<Index>* of_held,
               UnitsOfAnalysis* units) {
  std::vector<Index> found;
  for (const Index row : held.rows) {
    found.push_back(codes[static_cast<std::size_t>(row)]);
  }
  const std::set<Index> present(found.begin(), found.end());
  if (present.size() < 2) return false;
  units->name = grouping.column.empty() ? "session" : grouping.column;
  units->are_groups = true;
  for (const Index code : present) {
    units->labels.push_back(grouping.labels[static_cast<std::size_t>(code)]);
  }
  *of_held = std::move(found);
  return true;
}

std::size_t NumUnits(const HeldOut& held, const std::vector<Index>& codes) {
  std::set<Index> present;
  for (const Index row : held.rows) {
    present.insert(codes[static_cast<std::size_t>(row)]);
  }
  return present.size();
}

// Codes of the units of the held-out rows; `units` gets name and labels. Where
// sessions and groups are both held out whole, the coarser are the units: what
// shares one may be alike.
std::vector<Index> AssignUnits(const Holdout& holdout,
                               const HeldOut& held,
                               UnitsOfAnalysis* units) {
  std::vector<Index> codes;
  const data::Dataset& source = *held.source;
  const bool groups_are_coarser = holdout.whole_sessions &&
                                  holdout.whole_groups && source.has_groups() &&
                                  NumUnits(held, source.groups().codes) <
                                      NumUnits(held, source.session_codes());
  if (holdout.whole_sessions && !groups_are_coarser &&
      TakeUnits(held,
                source.session_codes(),
                source.log()->sessions,
                &codes,
                units)) {
    units->are_sessions = true;
    return codes;
  }
  if (source.has_groups() &&
      TakeUnits(held, source.groups().codes, source.groups(), &codes, units)) {
    return codes;
  }
  units->name = kBlockOfRows;
  const std::set<Index> ordered(held.rows.begin(), held.rows.end());
  const std::vector<Index> blocks =
      stats::BlocksInOrder(static_cast<Index>(ordered.size()));
  std::map<Index, Index> block_of;
  std::vector<std::pair<Index, Index>> ends;  // data rows of each block
  std::size_t at = 0;
  for (const Index row : ordered) {
    const Index block = blocks[at++];
    block_of[row] = block;
    const Index data_row = held.source->rows()[static_cast<std::size_t>(row)];
    if (block == static_cast<Index>(ends.size())) {
      ends.emplace_back(data_row, data_row);
    }
    ends.back().second = data_row;
  }
  for (const auto& [first, last] : ends) {
    units->labels.push_back(fmt::format("rows {}-{}", first, last));
  }
  for (const Index row : held.rows) codes.push_back(block_of[row]);
  return codes;
}

// Whether no two units of the held-out rows share a session, and none spans
// two. Sessions that were cut by time alone are a guess: a clock may start anew
// with each cycle.
bool AreSeparateSessions(const HeldOut& held, const std::vector<Index>& units) {
  const data::SessionLog* log = held.source->log().get();
  if (log == nullptr || log->sessions.column.empty()) return false;
  const std::vector<Index> sessions = held.source->session_codes();
  std::map<Index, Index> session_of;
  std::map<Index, Index> unit_of;
  for (std::size_t i = 0; i < units.size(); ++i) {
    const Index session = sessions[static_cast<std::size_t>(held.rows[i])];
    if (session_of.try_emplace(units[i], session).first->second != session ||
        unit_of.try_emplace(session, units[i]).first->second != units[i]) {
      return false;
    }
  }
  return true;
}

stats::FoldLosses GatherFolds(const Holdout& holdout,
                              const HeldOut& held,
                              const MatrixXd& residuals) {
  const auto folds = static_cast<Index>(holdout.folds.size());
  stats::FoldLosses losses;
  losses.mean_squares = MatrixXd::Zero(folds, residuals.cols());
  losses.test_rows = Eigen::VectorXd::Zero(folds);
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

// Folds come cut by cut; each cut has a winner by its pooled RMSE. A tie counts
// for the model that stands first.
std::vector<WinShare> CountWins(const stats::FoldLosses& folds,
                                Index repeats,
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
      shares.push_back({models[m], wins[m] / static_cast<double>(repeats)});
    }
  }
  std::ranges::stable_sort(shares, std::greater(), &WinShare::share);
  return shares;
}

HoldoutComparison CompareOne(const data::Dataset& dataset,
                             const Holdout& holdout,
                             const StudyResult& study,
                             std::size_t index,
                             const stats::ComparisonOptions& options) {
  HoldoutComparison comparison;
  comparison.holdout = holdout.name;
  for (std::size_t m = 0; m < study.models.size(); ++m) {
    if (study.models[m].holdouts[index].ok()) comparison.models.push_back(m);
  }
  if (comparison.models.empty()) return comparison;
  const HeldOut held = GatherHeldOut(dataset, holdout);
  const MatrixXd residuals =
      GatherResiduals(held, study, comparison.models, index);
  const std::vector<Index> codes =
      AssignUnits(holdout, held, &comparison.units);
  comparison.units.separate_sessions = AreSeparateSessions(held, codes);
  stats::UnitLosses losses = stats::GatherByUnit(residuals, codes);
  losses.time_ordered = holdout.forward;
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
    comparison.wins = CountWins(folds, holdout.repeats, comparison.models);
  }
  return comparison;
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

}  // namespace errmap::models
