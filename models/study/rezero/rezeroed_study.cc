#include "models/study/rezero/rezeroed_study.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "data/argument_name.h"
#include "models/study/fold_pool.h"
#include "models/study/rezero/zero_plan.h"
#include "stats/indices.h"

namespace errmap::models {
namespace {

// What is kept of a result to promise by.
HoldoutResult PredictionsAlone(const HoldoutResult& result) {
  HoldoutResult kept;
  kept.holdout = result.holdout;
  kept.why_failed = result.why_failed;
  for (const FoldResult& fold : result.folds) {
    kept.folds.emplace_back().test_predictions = fold.test_predictions;
  }
  return kept;
}

// The scored rows alone stay.
Holdout WithRowsOf(const ZeroPlan& plan,
                   const HeldOutRows& held,
                   const Holdout& holdout) {
  Holdout scored = holdout;
  for (stats::Fold& fold : scored.folds) fold.test.clear();
  for (const Index place : plan.scored) {
    const auto at = static_cast<std::size_t>(place);
    scored.folds[held.fold_of[at]].test.push_back(held.rows[at]);
  }
  if (holdout.test_data != nullptr) {
    std::vector<Index>& rows = scored.folds.front().test;
    scored.test_data = std::make_shared<const data::Dataset>(
        holdout.test_data->SelectRows(rows));
    rows = stats::AllIndices(std::ssize(rows));
  }
  return scored;
}

// Figures are pooled anew by what pools them everywhere.
void RezeroResult(const data::Dataset& dataset,
                  const Holdout& scored,
                  const HeldOutRows& held,
                  const ZeroPlan& plan,
                  HoldoutResult* result) {
  if (!result->ok()) return;
  const VectorXd residuals = Rezeroed(plan, ResidualsOf(held, *result));
  const HeldOutRows rows = GatherHeldOut(dataset, scored);
  const VectorXd targets = rows.source->target_values()(rows.rows);
  Index begin = 0;
  for (std::size_t k = 0; k < result->folds.size(); ++k) {
    const Index size = std::ranges::count(rows.fold_of, k);
    FoldResult& fold = result->folds[k];
    fold.test_predictions =
        targets.segment(begin, size) - residuals.segment(begin, size);
    begin += size;
  }
  PoolTest(dataset, scored, result);
}

Index RowsLeftInWorstFold(const ZeroPlan& plan,
                          const HeldOutRows& held,
                          std::size_t folds) {
  std::vector<Index> left(folds, 0);
  for (const Index place : plan.scored) {
    ++left[held.fold_of[static_cast<std::size_t>(place)]];
  }
  return std::ranges::min(left);
}

double RmseBy(const ZeroPlan& plan, const VectorXd& errors) {
  return stats::RootMeanSquare(Rezeroed(plan, errors));
}

VectorXd ScoredOf(const ZeroPlan& plan, const VectorXd& errors) {
  return errors(plan.scored);
}

}  // namespace

void RequireRezero(const data::Dataset& dataset,
                   const std::vector<Holdout>& holdouts,
                   const RezeroRule& rule) {
  for (const Holdout& holdout : holdouts) {
    const HeldOutRows held = GatherHeldOut(dataset, holdout);
    const ZeroPlan plan = PlanZeros(held, rule, 0);
    if (RowsLeftInWorstFold(plan, held, holdout.folds.size()) > 0) continue;
    throw std::invalid_argument(fmt::format(
        "{} {} leaves no row of a fold of {} to be judged: every one of them "
        "is a probe or longer ago than that; a longer interval, or another {}",
        data::ArgumentName("rezero"),
        rule.text,
        holdout.name,
        data::ArgumentName("holdout")));
  }
}

BeforeRezero RezeroStudy(const data::Dataset& dataset,
                         const RezeroRule& rule,
                         std::uint64_t seed,
                         std::vector<Holdout>* holdouts,
                         StudyResult* study) {
  BeforeRezero before{.holdouts = *holdouts, .results = {}};
  for (const ModelResult& model : study->models) {
    std::vector<HoldoutResult>& kept = before.results.emplace_back();
    std::ranges::transform(
        model.holdouts, std::back_inserter(kept), PredictionsAlone);
  }
  for (std::size_t h = 0; h < holdouts->size(); ++h) {
    const HeldOutRows held = GatherHeldOut(dataset, before.holdouts[h]);
    const ZeroPlan plan = PlanZeros(held, rule, seed);
    (*holdouts)[h] = WithRowsOf(plan, held, before.holdouts[h]);
    for (ModelResult& model : study->models) {
      RezeroResult(dataset, (*holdouts)[h], held, plan, &model.holdouts[h]);
    }
  }
  return before;
}

RezeroWorth WorthOfRezero(const data::Dataset& dataset,
                          const RezeroRule& rule,
                          std::uint64_t seed,
                          const BeforeRezero& before,
                          std::size_t h) {
  const HeldOutRows held = GatherHeldOut(dataset, before.holdouts[h]);
  const VectorXd no_map = held.source->target_values()(held.rows);
  const ZeroPlan plan = PlanZeros(held, rule, seed);
  RezeroWorth worth;
  worth.probes = plan.probes;
  worth.scored_rows = std::ssize(plan.scored);
  worth.no_map = RmseBy(plan, no_map);
  for (std::size_t m = 0; m < before.results.size(); ++m) {
    const HoldoutResult& result = before.results[m][h];
    if (!result.ok()) continue;
    const VectorXd errors = ResidualsOf(held, result);
    worth.models.push_back({m,
                            RmseBy(plan, errors),
                            stats::RootMeanSquare(ScoredOf(plan, errors))});
  }
  return worth;
}

}  // namespace errmap::models
