#include "models/study/record/making/remarks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "models/history/view.h"
#include "models/study/judgement/extrapolated_rows.h"

namespace errmap::models {
namespace {

// Of the squared residuals, what means by one column must explain to be told.
constexpr double kBiasWorthSaying = 0.25;
constexpr double kSignificance = 0.05;
// Of the held-out rows, what must lie outside of the trained range.
constexpr double kExtrapolationWorthSaying = 0.05;

// What a screen has room for is told in this order; all else on request.
constexpr std::array kToldFirst = {RemarkKind::kInterrupted,
                                   RemarkKind::kRemoves,
                                   RemarkKind::kProvenBetter,
                                   RemarkKind::kSimpleHolds,
                                   RemarkKind::kGoal,
                                   RemarkKind::kBetterWithoutMap,
                                   RemarkKind::kRowsLearnt,
                                   RemarkKind::kOneRunOnly,
                                   RemarkKind::kGroupFitsFailed,
                                   RemarkKind::kNoGroupsHeldOut,
                                   RemarkKind::kNoGroups,
                                   RemarkKind::kFewSessions,
                                   RemarkKind::kPromise,
                                   RemarkKind::kOnlyGrows,
                                   RemarkKind::kTooFewUnits,
                                   RemarkKind::kTooManyMaps,
                                   RemarkKind::kNotNoise,
                                   RemarkKind::kIgnoreNeighbours,
                                   RemarkKind::kNoiseLearning,
                                   RemarkKind::kUnitsCorrelated,
                                   RemarkKind::kHoldoutsDisagree,
                                   RemarkKind::kNotConverged,
                                   RemarkKind::kCost};

// Who has more of them gains little by yet another.
constexpr std::ptrdiff_t kManySensors = 8;

// Columns named as those that more should be measured of.
constexpr std::size_t kMostColumns = 3;

// Where an input was held out beyond all that its fold was trained on.
struct Beyond {
  Eigen::Index rows = 0;
  double below = kNotKnown;
  double above = kNotKnown;
};

Beyond BeyondTraining(const data::Dataset& dataset,
                      const Holdout& holdout,
                      Eigen::Index column) {
  Beyond beyond;
  for (const stats::Fold& fold : holdout.folds) {
    const auto [trained, tested] = ValuesOfFold(dataset, holdout, fold, column);
    const double low = trained.minCoeff();
    const double high = trained.maxCoeff();
    const Eigen::Index under = (tested.array() < low).count();
    const Eigen::Index over = (tested.array() > high).count();
    beyond.rows += under + over;
    if (under > 0) beyond.below = std::fmax(beyond.below, low);
    if (over > 0) beyond.above = std::fmin(beyond.above, high);
  }
  return beyond;
}

// What is said of a recommendation, from the study and its record.
class Remarks {
 public:
  Remarks(const ComponentStudy& study, const ComponentRecord& record)
      : study_(study),
        record_(record),
        advice_(*study.judgement.recommendation),
        tests_(study.judgement.comparisons[advice_.holdout]),
        model_(record.models[advice_.model]),
        only_grow_(ColumnsThatOnlyGrow(study.data.dataset)) {}

  std::vector<RemarkRecord> Grounds();
  std::vector<RemarkRecord> Doubts();

 private:
  const ComponentStudy& study_;
  const ComponentRecord& record_;
  const Recommendation& advice_;
  const HoldoutComparison& tests_;  // under the hold-out that it follows
  const ModelRecord& model_;
  const std::vector<bool> only_grow_;  // (inputs of the data set)
  std::vector<RemarkRecord> remarks_;

  RemarkRecord& Add(RemarkKind kind) {
    RemarkRecord& remark = remarks_.emplace_back();
    remark.kind = kind;
    const auto* const place = std::ranges::find(kToldFirst, kind);
    if (place != kToldFirst.end()) {
      remark.rank = 1 + (place - kToldFirst.begin());
    }
    return remark;
  }
  RemarkRecord& Add(RemarkKind kind, std::size_t of_model) {
    RemarkRecord& remark = Add(kind);
    remark.model = record_.models[of_model].name;
    return remark;
  }

  double RmseOf(std::size_t model) const {
    return tests_.tests.rmse[*tests_.PlaceOf(model)];
  }

  void AddSimplest();
  void AddBestNet();
  void AddSmaller();
  void AddNotNoise();
  void AddUnseen();
  void AddGrowing();
  void AddUnits();
  void AddRowsLearnt();
  void AddFlattered();
  void AddDisagreement();
  void AddCorrelation();
  void AddExtrapolation();
};

void Remarks::AddSimplest() {
  const std::size_t lowest = advice_.first_tier.front();
  if (advice_.proven_better_than) {
    Add(RemarkKind::kProvenBetter, *advice_.proven_better_than);
  } else if (!advice_.fails_in.empty()) {
    RemarkRecord& remark = Add(RemarkKind::kSimpleHolds);
    remark.holdouts = std::vector<std::string>{advice_.fails_in};
  } else if (advice_.single) {
    Add(RemarkKind::kAveragesMaps, *advice_.single);
  } else if (advice_.first_tier.size() < 2) {
    return;
  } else if (advice_.model == lowest) {
    Add(RemarkKind::kLowestAndSimplest);
  } else if (tests_.tests.num_units < 2) {
    Add(RemarkKind::kSimplestNearLowest, lowest);
  } else {
    RemarkRecord& remark = Add(RemarkKind::kSimplestOfTier, lowest);
    remark.excess =
        std::max(0.0,
                 tests_.tests.ExcessAtMost(*tests_.PlaceOf(advice_.model),
                                           *tests_.PlaceOf(lowest)));
    remark.confidence = advice_.within_tier;
  }
}

// Who does not get a net asks why.
void Remarks::AddBestNet() {
  const auto& models = study_.study.models;
  const auto is_net = [&](std::size_t model) {
    return ChoiceOf(models[model]) == Choice::kNeural;
  };
  if (is_net(advice_.model)) return;
  std::optional<std::size_t> best;
  for (const std::size_t model : tests_.models) {
    if (is_net(model) && (!best || RmseOf(model) < RmseOf(*best))) best = model;
  }
  if (best) Add(RemarkKind::kBestNet, *best);
}

// For a control with little time: the smallest map that meets the goal as the
// recommended one does, else the best one of half its operations or fewer that
// errs at most twice as much.
void Remarks::AddSmaller() {
  constexpr std::int64_t kSmallAlready = 100;  // for any control
  constexpr double kMostLoss = 2.0;
  if (!model_.step_cost || model_.step_cost->operations() < kSmallAlready) {
    return;
  }
  const auto operations = [&](std::size_t model) {
    const auto& cost = record_.models[model].step_cost;
    return cost ? cost->operations() : 0;
  };
  const auto goal = [&](std::size_t model) {
    return study_.judgement.goals[model][advice_.holdout].standing;
  };
  const bool by_goal = goal(advice_.model) == GoalStanding::kMet;
  std::optional<std::size_t> smaller;
  for (const std::size_t model : tests_.models) {
    const std::int64_t own = operations(model);
    if (own == 0 || 2 * own > operations(advice_.model)) continue;
    if (by_goal ? goal(model) != GoalStanding::kMet
                : RmseOf(model) > kMostLoss * RmseOf(advice_.model)) {
      continue;
    }
    if (!smaller || (by_goal ? own < operations(*smaller)
                             : RmseOf(model) < RmseOf(*smaller))) {
      smaller = model;
    }
  }
  if (smaller) Add(RemarkKind::kSmaller, *smaller);
}

void Remarks::AddNotNoise() {
  const ResultRecord* result =
      FindNamed(model_.results, record_.recommendation->holdout);
  std::vector<std::string> columns;
  std::vector<double> shares;
  for (const auto& bias :
       {result->randomness.by_group, result->randomness.by_position}) {
    if (!bias || !(bias->explained >= kBiasWorthSaying) ||
        !(bias->test.value.p < kSignificance)) {
      continue;
    }
    columns.push_back(bias->column);
    shares.push_back(bias->explained);
  }
  if (columns.empty()) return;
  RemarkRecord& remark = Add(RemarkKind::kNotNoise);
  const bool has_offset =
      result->randomness.by_group &&
      columns.front() == result->randomness.by_group->column;
  if (has_offset &&
      record_.recommendation->goal_standing != GoalStanding::kMet) {
    remark.add_sensor =
        std::ranges::count_if(study_.data.dataset.inputs(),
                              data::IsReadBySensor) <= kManySensors;
  }
  remark.columns = std::move(columns);
  remark.shares = std::move(shares);
}

std::vector<RemarkRecord> Remarks::Grounds() {
  if (record_.recommendation->removed_share > 0.0) Add(RemarkKind::kRemoves);
  AddSimplest();
  // Where that is not sure, the recommendation itself says so.
  if (advice_.has_baseline && advice_.choice != Choice::kBaseline &&
      advice_.against_baseline == Confidence::kEstablished) {
    Add(RemarkKind::kBeatsBaseline, advice_.best_baseline);
  }
  AddBestNet();
  AddSmaller();
  const auto& gap = study_.judgement.gap;
  if (gap && std::ranges::any_of(gap->rows, [&](const auto& row) {
        return row.model == advice_.model;
      })) {
    Add(RemarkKind::kGap);
  }
  if (const auto& promise = record_.recommendation->promise) {
    RemarkRecord& remark = Add(RemarkKind::kPromise);
    if (!promise->good_for) remark.rank.reset();
  }
  if (record_.recommendation->session_worth) Add(RemarkKind::kOneMoreSession);
  if (record_.recommendation->goal_standing != GoalStanding::kNone) {
    Add(RemarkKind::kGoal);
  }
  Add(RemarkKind::kCost);
  AddNotNoise();
  return std::move(remarks_);
}

void Remarks::AddUnseen() {
  const Holdout& holdout = study_.holdouts[advice_.holdout];
  if (holdout.test_data != nullptr) return;
  if (record_.data.sessions == 1) {
    Add(RemarkKind::kOneRunOnly);
    return;
  }
  if (holdout.whole_sessions) {
    if (record_.data.sessions >= kFewestSessionsToDecide) return;
    Add(RemarkKind::kFewSessions).holdouts =
        std::vector<std::string>{study_.holdouts[advice_.decided_by].name};
    return;
  }
  if (holdout.whole_groups) return;
  if (std::ranges::any_of(study_.holdouts, &Holdout::whole_groups)) {
    Add(RemarkKind::kGroupFitsFailed);
  } else {
    Add(record_.data.group ? RemarkKind::kNoGroupsHeldOut
                           : RemarkKind::kNoGroups);
  }
}

// What is held out lies between other sessions, what is to come does not.
void Remarks::AddGrowing() {
  const data::Dataset& dataset = study_.data.dataset;
  std::vector<std::string> columns;
  for (const TrainedInput& input :
       study_.study.models[advice_.model].final_fit->inputs) {
    const Eigen::Index at = dataset.FindInput(input.column.name);
    if (at >= 0 && only_grow_[static_cast<std::size_t>(at)]) {
      columns.push_back(input.column.name);
    }
  }
  if (columns.empty()) return;
  RemarkRecord& remark = Add(RemarkKind::kOnlyGrows);
  remark.columns = std::move(columns);
  for (std::size_t h = 0; h < study_.holdouts.size(); ++h) {
    if (study_.holdouts[h].forward &&
        study_.judgement.comparisons[h].PlaceOf(advice_.model)) {
      remark.holdouts = std::vector<std::string>{study_.holdouts[h].name};
      return;
    }
  }
}

void Remarks::AddUnits() {
  if (!tests_.units.are_groups) {
    Add(RemarkKind::kBlocksForUnits);
  } else if (tests_.obstacle.kind == Obstacle::Kind::kTooFewUnits ||
             tests_.obstacle.kind == Obstacle::Kind::kPerhapsOneSession) {
    Add(RemarkKind::kTooFewUnits);
  } else if (tests_.obstacle.exists()) {
    Add(RemarkKind::kTooManyMaps);
  }
}

void Remarks::AddRowsLearnt() {
  std::vector<std::string> names;
  for (const Holdout& holdout : study_.holdouts) {
    if (holdout.rows_of_training > 0) names.push_back(holdout.name);
  }
  if (!names.empty()) Add(RemarkKind::kRowsLearnt).holdouts = std::move(names);
}

// Who reads the wrong column is tempted by the lowest error there.
void Remarks::AddFlattered() {
  const auto& gap = study_.judgement.gap;
  if (!gap) return;
  const InterpolationGap::Row* tempting = nullptr;
  for (const InterpolationGap::Row& row : gap->rows) {
    if (!row.flatters() || study_.study.models[row.model].baseline) continue;
    if (tempting == nullptr ||
        row.neighbours_rmse < tempting->neighbours_rmse) {
      tempting = &row;
    }
  }
  if (tempting != nullptr) Add(RemarkKind::kIgnoreNeighbours, tempting->model);
}

// Other hold-outs of unseen rows in whose first tier the map is not.
void Remarks::AddDisagreement() {
  std::vector<std::string> others;
  for (std::size_t h = 0; h < study_.holdouts.size(); ++h) {
    if (h == advice_.holdout || study_.holdouts[h].among_neighbours ||
        !study_.judgement.verdicts[h] ||
        study_.judgement.comparisons[h].TierOf(advice_.model) < 2) {
      continue;
    }
    others.push_back(study_.holdouts[h].name);
  }
  if (others.empty()) return;
  Add(RemarkKind::kHoldoutsDisagree).holdouts = std::move(others);
}

void Remarks::AddCorrelation() {
  const auto& verdict = study_.judgement.verdicts[advice_.holdout];
  if (!verdict || !verdict->rival) return;
  const stats::PairComparison& pair = tests_.tests.Pair(
      *tests_.PlaceOf(verdict->best), *tests_.PlaceOf(*verdict->rival));
  if (!pair.correlated) return;
  RemarkRecord& remark = Add(RemarkKind::kUnitsCorrelated);
  remark.lag1 = pair.lag1.statistic;
  remark.pairs = static_cast<std::int64_t>(tests_.differ.size());
  remark.established = static_cast<std::int64_t>(
      std::ranges::count(tests_.differ, Confidence::kEstablished));
}

// The columns that leave what their folds were trained on in most rows.
void Remarks::AddExtrapolation() {
  const data::Dataset& dataset = study_.data.dataset;
  std::vector<std::pair<std::string, Beyond>> found;
  for (const TrainedInput& input :
       study_.study.models[advice_.model].final_fit->inputs) {
    const Eigen::Index column = dataset.FindInput(input.column.name);
    const Beyond beyond =
        BeyondTraining(dataset, study_.holdouts[advice_.holdout], column);
    // Nobody can go back to what only grows. Where each state was met in one
    // fold only, "below" would lie above "above": none is more wanted.
    if ((column >= 0 && only_grow_[static_cast<std::size_t>(column)]) ||
        beyond.below >= beyond.above) {
      continue;
    }
    if (beyond.rows > 0) found.emplace_back(input.column.name, beyond);
  }
  std::ranges::stable_sort(
      found, std::greater<>(), [](const auto& one) { return one.second.rows; });
  if (found.size() > kMostColumns) found.resize(kMostColumns);
  RemarkRecord& remark = Add(RemarkKind::kExtrapolates);
  remark.columns.emplace();
  remark.below.emplace();
  remark.above.emplace();
  for (auto& [name, beyond] : found) {
    remark.columns->push_back(std::move(name));
    remark.below->push_back(beyond.below);
    remark.above->push_back(beyond.above);
  }
}

std::vector<RemarkRecord> Remarks::Doubts() {
  if (record_.interrupted) Add(RemarkKind::kInterrupted);
  AddUnseen();
  AddGrowing();
  AddUnits();
  AddRowsLearnt();
  AddFlattered();
  AddDisagreement();
  AddCorrelation();
  if (advice_.extrapolated_share >= kExtrapolationWorthSaying) {
    AddExtrapolation();
  }
  if (!model_.final->summary.value.converged) {
    Add(RemarkKind::kNotConverged);
  }
  if (model_.memorisation) {
    RemarkRecord& remark = Add(RemarkKind::kNoiseLearning);
    if (model_.memorisation->learning != NoiseLearning::kMuch) {
      remark.rank.reset();
    }
  }
  if (!record_.stability.empty()) Add(RemarkKind::kOtherCuts);
  if (advice_.better_but_no_map) {
    Add(RemarkKind::kBetterWithoutMap, *advice_.better_but_no_map);
  }
  return std::move(remarks_);
}

}  // namespace

std::vector<RemarkRecord> FindGrounds(const ComponentStudy& study,
                                      const ComponentRecord& record) {
  return Remarks(study, record).Grounds();
}

std::vector<RemarkRecord> FindDoubts(const ComponentStudy& study,
                                     const ComponentRecord& record) {
  return Remarks(study, record).Doubts();
}

}  // namespace errmap::models
