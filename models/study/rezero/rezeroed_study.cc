#include "models/study/rezero/rezeroed_study.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "data/argument_name.h"
#include "models/study/fold_pool.h"
#include "models/zero_walk.h"
#include "stats/indices.h"
#include "stats/random.h"

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

class ZeroPlanner {
 public:
  ZeroPlanner(const HeldOutRows& held,
              const RezeroRule& rule,
              std::uint64_t seed)
      : held_(held), source_(*held.source), rule_(rule), random_(seed) {}

  ZeroPlan Plan() {
    plan_.zero_of.assign(held_.rows.size(), -1);
    plan_.noise.setZero(std::ssize(held_.rows));
    const std::vector<Index> sessions = source_.session_codes();
    std::map<std::pair<std::size_t, Index>, std::vector<Index>> runs;
    for (std::size_t i = 0; i < held_.rows.size(); ++i) {
      const auto row = static_cast<std::size_t>(held_.rows[i]);
      runs[{held_.fold_of[i], sessions[row]}].push_back(static_cast<Index>(i));
    }
    for (auto& [fold_and_session, places] : runs) {
      std::ranges::stable_sort(
          places, {}, [&](Index place) { return TimeOf(place); });
      PlanRun(places);
    }
    for (std::size_t i = 0; i < plan_.zero_of.size(); ++i) {
      if (plan_.zero_of[i] >= 0) plan_.scored.push_back(static_cast<Index>(i));
    }
    return std::move(plan_);
  }

 private:
  std::size_t RowOf(Index place) const {
    return static_cast<std::size_t>(
        held_.rows[static_cast<std::size_t>(place)]);
  }
  double TimeOf(Index place) const {
    return source_.log()->time[source_.log_rows()[RowOf(place)]];
  }
  double Age(Index zero, Index place) const {
    return TimeOf(place) - TimeOf(zero);
  }

  bool IsDue(Index zero, Index place) const {
    switch (rule_.kind) {
      case RezeroKind::kEvery:
        return Age(zero, place) >= rule_.interval * (1.0 - kTimeRounding);
      case RezeroKind::kSession:
        return false;
      case RezeroKind::kProbe:
        return !source_.has_groups() ||
               source_.groups().codes[RowOf(zero)] !=
                   source_.groups().codes[RowOf(place)];
    }
    return false;
  }

  void PlanRun(const std::vector<Index>& places) {
    const auto place_of = [&](Index row) {
      return places[static_cast<std::size_t>(row)];
    };
    // The interval is infinite where none was given.
    const double longest = rule_.interval * (1.0 + kTimeRounding);
    const std::vector<Index> zeros = ForZeros(
        std::ssize(places),
        [&](Index row, Index zero) {
          return IsDue(place_of(zero), place_of(row));
        },
        [&](Index row, Index zero) {
          if (Age(place_of(zero), place_of(row)) > longest) return;
          plan_.zero_of[static_cast<std::size_t>(place_of(row))] =
              place_of(zero);
        });
    for (const Index zero : zeros) {
      plan_.noise[place_of(zero)] = rule_.noise * random_.Normal();
    }
    plan_.probes += std::ssize(zeros);
  }

  const HeldOutRows& held_;
  const data::Dataset& source_;
  const RezeroRule& rule_;
  stats::Random random_;
  ZeroPlan plan_;
};

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

ZeroPlan PlanZeros(const HeldOutRows& held,
                   const RezeroRule& rule,
                   std::uint64_t seed) {
  RequireTimes(rule, *held.source);
  return ZeroPlanner(held, rule, seed).Plan();
}

VectorXd Rezeroed(const ZeroPlan& plan, const VectorXd& errors) {
  VectorXd left(std::ssize(plan.scored));
  for (Index i = 0; i < left.size(); ++i) {
    const Index place = plan.scored[static_cast<std::size_t>(i)];
    const Index zero = plan.zero_of[static_cast<std::size_t>(place)];
    left[i] = errors[place] - errors[zero] - plan.noise[zero];
  }
  return left;
}

}  // namespace errmap::models
