#include "models/study/rezero/rezeroed_study.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "data/argument_name.h"
#include "models/study/fold_pool.h"
#include "models/study/rezero/zero_plan.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

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
  std::vector<Index> of_file;
  for (const Index place : plan.scored) {
    const auto at = static_cast<std::size_t>(place);
    if (holdout.test_data != nullptr) {
      of_file.push_back(held.rows[at]);
    } else {
      scored.folds[held.fold_of[at]].test.push_back(held.rows[at]);
    }
  }
  if (holdout.test_data != nullptr) {
    scored.test_data = std::make_shared<const data::Dataset>(
        holdout.test_data->SelectRows(of_file));
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

// About the rule's interval, the rule's own among them, then once a session.
std::vector<RezeroRule> RulesAbout(const RezeroRule& rule) {
  constexpr std::array<double, 11> kTimes = {
      0.25, 0.5, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 6.0, 8.0};
  std::vector<RezeroRule> rules;
  if (rule.kind == RezeroKind::kEvery) {
    for (const double times : kTimes) {
      rules.push_back(rule);
      rules.back().interval *= times;
    }
  }
  rules.push_back(rule);
  rules.back().kind = RezeroKind::kSession;
  rules.back().interval = std::numeric_limits<double>::infinity();
  return rules;
}

// The longest time between a session's first held-out row and its last.
double LongestRun(const HeldOutRows& held) {
  const data::Dataset& source = *held.source;
  const std::vector<Index> sessions = source.session_codes();
  std::vector<double> first(source.log()->sessions.labels.size(),
                            std::numeric_limits<double>::infinity());
  double longest = 0.0;
  std::vector<Index> rows = held.rows;
  std::ranges::sort(rows);
  for (const Index row : rows) {
    const auto at = static_cast<std::size_t>(row);
    const double time = source.log()->time[source.log_rows()[at]];
    double& begin = first[static_cast<std::size_t>(sessions[at])];
    begin = std::min(begin, time);
    longest = std::max(longest, time - begin);
  }
  return longest;
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
                          std::size_t h,
                          std::size_t recommended) {
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
    if (m != recommended) continue;
    const double longest = LongestRun(held);
    bool as_well = true;
    for (const RezeroRule& other : RulesAbout(rule)) {
      const bool by_session = other.kind == RezeroKind::kSession;
      if (!by_session && other.interval >= longest) continue;
      const ZeroPlan of_other = PlanZeros(held, other, seed);
      if (of_other.scored.empty()) continue;
      const RezeroWorth::At at{
          other.interval, RmseBy(of_other, errors), RmseBy(of_other, no_map)};
      worth.curve.push_back(at);
      if (at.interval < rule.interval) continue;
      as_well = as_well && at.map <= worth.no_map;
      if (as_well) worth.does_as_well_at = at.interval;
    }
    worth.does_as_well_never =
        as_well && worth.models.back().never <= worth.no_map;
  }
  return worth;
}

}  // namespace errmap::models
