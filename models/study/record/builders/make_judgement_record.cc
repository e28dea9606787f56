#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "data/text.h"
#include "models/history/history.h"
#include "models/history/view.h"
#include "models/study/judgement/extrapolated_rows.h"
#include "models/study/judgement/units_of_analysis.h"
#include "models/study/record/builders/parts.h"

namespace errmap::models {
namespace {

IntervalRecord IntervalOf(const stats::Bounds95& bounds) {
  if (!bounds.exist()) return {kNotKnown, kNotKnown};
  return {bounds.lower, bounds.upper};
}

// What is said of models by their index is written by their name.
class JudgementRecord {
 public:
  explicit JudgementRecord(const ComponentStudy& study)
      : study_(study), judgement_(study.judgement) {}

  std::vector<PairRecord> Pairs() const;
  ByName<std::vector<std::vector<std::string>>> Tiers() const;
  std::vector<StabilityRecord> Stability() const;
  std::vector<VerdictRecord> Verdicts() const;
  std::optional<RecommendationRecord> Advice() const;

 private:
  const ComponentStudy& study_;
  const Judgement& judgement_;

  const std::string& Name(std::size_t model) const {
    return study_.study.models[model].name;
  }
  std::vector<std::string> Names(const std::vector<std::size_t>& models) const {
    std::vector<std::string> names;
    for (const std::size_t model : models) names.push_back(Name(model));
    return names;
  }
  PairRecord Pair(const HoldoutComparison& tests, std::size_t index) const;
  double TestRmseOf(const std::string& name, std::size_t holdout) const;
  double RemovedShare(std::size_t holdout, const HoldoutResult& of_map) const;
  void AddStates(RecommendationRecord* record) const;
};

// NaN: it was not compared, or failed.
double JudgementRecord::TestRmseOf(const std::string& name,
                                   std::size_t holdout) const {
  const auto model =
      std::ranges::find(study_.study.models, name, &ModelResult::name);
  return model == study_.study.models.end() || !model->holdouts[holdout].ok()
             ? kNotKnown
             : model->holdouts[holdout].test.rmse;
}

// Of what there is without a map, on the same rows. No compensation leaves an
// error as it is; what is not an error, as the position of a focuser, would be
// set to its mean.
double JudgementRecord::RemovedShare(std::size_t holdout,
                                     const HoldoutResult& of_map) const {
  constexpr double kFarFromZero = 10.0;
  const data::Unit& unit = study_.data.dataset.target().unit;
  const bool may_err =
      data::IsLengthOrAngle(unit) || unit.quantity == data::Quantity::kRatio;
  double without = TestRmseOf("zero", holdout);
  const double about_mean = TestRmseOf("mean", holdout);
  if (!may_err && without > kFarFromZero * about_mean) without = about_mean;
  return without > 0.0 ? 1.0 - of_map.test.rmse / without : kNotKnown;
}

MeanTestRecord MeanTestOf(const stats::MeanDifferenceTest& test) {
  return {.statistic = test.test.statistic,
          .df = test.degrees_of_freedom,
          .p = test.test.p};
}

std::optional<MeanTestRecord> MeanTestOf(
    const std::optional<stats::MeanDifferenceTest>& test) {
  return test ? std::optional(MeanTestOf(*test)) : std::nullopt;
}

PairRecord JudgementRecord::Pair(const HoldoutComparison& tests,
                                 std::size_t index) const {
  const stats::PairComparison& pair = tests.tests.pairs[index];
  const auto name = [&](Index place) {
    return Name(tests.models[static_cast<std::size_t>(place)]);
  };
  return {.a = name(pair.a),
          .b = name(pair.b),
          .holdout = tests.holdout,
          .rmse_a = tests.tests.rmse[pair.a],
          .rmse_b = tests.tests.rmse[pair.b],
          .difference = pair.difference,
          .ci95 = IntervalOf(pair.bounds),
          .p = pair.p,
          .p_holm = pair.p_holm,
          .holm_pairs = pair.num_adjusted,
          .test = pair.memory_shown > 0.0
                      ? "sign-flip test, t test with autocorrelation"
                      : "sign-flip test",
          .exact = pair.sign_flip.exact,
          .smallest_p = pair.sign_flip.smallest_p,
          .unit_of_analysis = tests.units.name,
          .units = tests.tests.num_units,
          .lag1 = pair.lag1.statistic,
          .memory = pair.memory_shown,
          .correlated = pair.correlated,
          .established = tests.differ[index] == Confidence::kEstablished,
          .confidence = tests.differ[index],
          .tests = {.wilcoxon = {.statistic = pair.wilcoxon.test.statistic,
                                 .p = pair.wilcoxon.test.p,
                                 .exact = pair.wilcoxon.exact},
                    .memory_t = {.statistic = pair.memory.test.statistic,
                                 .df = pair.memory.degrees_of_freedom,
                                 .p = pair.memory.test.p,
                                 .p_holm = pair.p_memory_holm,
                                 .memory = pair.memory.memory},
                    .block_t = MeanTestOf(pair.block_t),
                    .corrected_t = MeanTestOf(pair.corrected_t),
                    .diebold_mariano = MeanTestOf(pair.diebold_mariano)}};
}

std::vector<PairRecord> JudgementRecord::Pairs() const {
  std::vector<PairRecord> pairs;
  for (const HoldoutComparison& tests : judgement_.comparisons) {
    for (std::size_t i = 0; i < tests.tests.pairs.size(); ++i) {
      pairs.push_back(Pair(tests, i));
    }
  }
  return pairs;
}

ByName<std::vector<std::vector<std::string>>> JudgementRecord::Tiers() const {
  ByName<std::vector<std::vector<std::string>>> tiers;
  for (const HoldoutComparison& tests : judgement_.comparisons) {
    tiers.push_back({tests.holdout, {}});
    auto& of_holdout = tiers.back().second;
    for (const std::vector<Index>& tier : tests.tests.tiers) {
      std::vector<std::string>& names = of_holdout.emplace_back();
      for (const Index place : tier) {
        names.push_back(Name(tests.models[static_cast<std::size_t>(place)]));
      }
    }
  }
  return tiers;
}

std::vector<StabilityRecord> JudgementRecord::Stability() const {
  std::vector<StabilityRecord> stability;
  for (std::size_t h = 0; h < study_.holdouts.size(); ++h) {
    const HoldoutComparison& tests = judgement_.comparisons[h];
    if (tests.wins.empty()) continue;
    stability.push_back({.holdout = tests.holdout,
                         .repeats = study_.holdouts[h].repeats,
                         .wins = tests.wins});
  }
  return stability;
}

std::vector<VerdictRecord> JudgementRecord::Verdicts() const {
  std::vector<VerdictRecord> verdicts;
  for (std::size_t h = 0; h < judgement_.verdicts.size(); ++h) {
    const std::optional<Verdict>& verdict = judgement_.verdicts[h];
    if (!verdict) continue;
    const HoldoutComparison& tests = judgement_.comparisons[h];
    VerdictRecord record{.holdout = verdict->holdout,
                         .choice = verdict->choice,
                         .model = Name(verdict->best),
                         .established = verdict->established(),
                         .confidence = verdict->confidence};
    if (verdict->rival) {
      record.rival = Name(*verdict->rival);
      record.against_rival =
          tests.ThatItIsBetter(verdict->best, *verdict->rival);
    }
    if (verdict->best_baseline) {
      record.best_baseline = Name(*verdict->best_baseline);
    }
    if (tests.obstacle.exists()) record.obstacle = tests.obstacle;
    verdicts.push_back(std::move(record));
  }
  return verdicts;
}

MemoryRecord MemoryOf(const History& history) {
  MemoryRecord record;
  record.time_unit = history.time_unit;
  for (const DerivedInput& input : history.derived) {
    record.longest = std::max(record.longest, input.tau);
    record.zeroed = record.zeroed || input.filter == Filter::kZero;
  }
  return record;
}

// A heating machine's error settles over hours: the first ones are told apart.
std::vector<SinceStartRecord> SinceStart(const ComponentStudy& study,
                                         const HoldoutResult& result,
                                         std::size_t holdout) {
  constexpr double kMinute = 60.0;
  constexpr std::array<double, 6> kMinutes = {0, 15, 30, 60, 120, 240};
  const HeldOutRows held =
      GatherHeldOut(study.data.dataset, study.holdouts[holdout]);
  const data::SessionLog* log = held.source->log().get();
  if (log == nullptr || log->time_unit != "s") return {};
  const std::vector<Index> sessions = held.source->session_codes();
  const VectorXd residuals = ResidualsOf(held, result);
  std::array<std::vector<double>, kMinutes.size()> parts;
  for (std::size_t i = 0; i < held.rows.size(); ++i) {
    const auto row = static_cast<std::size_t>(held.rows[i]);
    const Index first =
        log->first_rows[static_cast<std::size_t>(sessions[row])];
    const double elapsed =
        log->time[held.source->log_rows()[row]] - log->time[first];
    const auto after = std::ranges::upper_bound(kMinutes, elapsed / kMinute) -
                       kMinutes.begin();
    parts[static_cast<std::size_t>(std::max<std::ptrdiff_t>(after, 1) - 1)]
        .push_back(residuals[static_cast<Index>(i)]);
  }
  std::vector<SinceStartRecord> records;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    if (parts[part].empty()) continue;
    const Eigen::Map<const VectorXd> values(parts[part].data(),
                                            std::ssize(parts[part]));
    records.push_back({.from = kMinutes[part] * kMinute,
                       .until = part + 1 < kMinutes.size()
                                    ? kMinutes[part + 1] * kMinute
                                    : kNotKnown,
                       .n = values.size(),
                       .mean = values.mean(),
                       .rmse = std::sqrt(values.squaredNorm() /
                                         static_cast<double>(values.size()))});
  }
  // One part alone tells nothing beside the whole.
  return records.size() > 1 ? records : std::vector<SinceStartRecord>();
}

// The columns that leave what their folds were trained on, those of most rows
// first; not what only grows, to which nobody can go back, nor what each state
// was met of in one fold only: no state of it is wanted more than another.
std::vector<BeyondRecord> BeyondTraining(
    const data::Dataset& dataset,
    const Holdout& holdout,
    const std::vector<std::string>& columns) {
  constexpr std::size_t kMostColumns = 3;
  std::vector<std::pair<Index, BeyondRecord>> found;
  for (const std::string& name : columns) {
    const Index column = dataset.FindInput(name);
    if (column < 0) continue;
    Index rows = 0;
    BeyondRecord beyond{.column = name};
    for (const stats::Fold& fold : holdout.folds) {
      const FoldValues values = ValuesOfFold(dataset, holdout, fold, column);
      const Index under = values.Below().count();
      const Index over = values.Above().count();
      rows += under + over;
      if (under > 0) beyond.below = std::fmax(beyond.below, values.low);
      if (over > 0) beyond.above = std::fmin(beyond.above, values.high);
    }
    if (rows == 0 || beyond.below >= beyond.above) continue;
    // The map has learnt what every fold has, and nothing counts below one.
    const auto values = dataset.input_values().col(column);
    const bool counts =
        dataset.inputs()[static_cast<std::size_t>(column)].role ==
        data::Role::kCounter;
    beyond.below =
        std::isnan(beyond.below) || counts ? kNotKnown : values.minCoeff();
    if (!std::isnan(beyond.above)) beyond.above = values.maxCoeff();
    found.emplace_back(rows, std::move(beyond));
  }
  std::ranges::stable_sort(
      found, std::greater<>(), [](const auto& one) { return one.first; });
  if (found.size() > kMostColumns) found.resize(kMostColumns);
  std::vector<BeyondRecord> records;
  for (auto& [rows, beyond] : found) records.push_back(std::move(beyond));
  return records;
}

void JudgementRecord::AddStates(RecommendationRecord* record) const {
  constexpr double kWorthSaying = 0.05;  // of the held-out rows
  const data::Dataset& dataset = study_.data.dataset;
  const Recommendation& advice = *judgement_.recommendation;
  const std::vector<bool> only_grow = ColumnsThatOnlyGrow(dataset);
  std::vector<std::string> grow;
  std::vector<std::string> others;
  for (const TrainedInput& input :
       study_.study.models[advice.model].final_fit->inputs) {
    const Index at = dataset.FindInput(input.column.name);
    const bool grows = at >= 0 && only_grow[static_cast<std::size_t>(at)];
    (grows ? grow : others).push_back(input.column.name);
  }
  if (!grow.empty()) record->only_grow = std::move(grow);
  if (advice.extrapolated_share >= kWorthSaying) {
    record->beyond =
        BeyondTraining(dataset, study_.holdouts[advice.holdout], others);
  }
}

std::optional<RecommendationRecord> JudgementRecord::Advice() const {
  const auto& advice = judgement_.recommendation;
  if (!advice) return std::nullopt;
  const ModelResult& model = study_.study.models[advice->model];
  const HoldoutResult& result = model.holdouts[advice->holdout];
  RecommendationRecord record;
  record.choice = advice->choice;
  record.model = model.name;
  record.holdout = study_.holdouts[advice->holdout].name;
  record.decided_by = study_.holdouts[advice->decided_by].name;
  record.rmse = result.test.rmse;
  record.ci95 =
      RmseInterval(judgement_.comparisons[advice->holdout], advice->model);
  record.first_tier = Names(advice->first_tier);
  if (advice->has_baseline) {
    record.best_baseline = Name(advice->best_baseline);
    record.against_baseline = advice->against_baseline;
  }
  record.sensors = SensorsOf(*model.final_fit);
  record.parameters = model.final_fit->model->num_parameters();
  record.predict_ns = model.predict_ns;
  record.goal_standing =
      judgement_.goals[advice->model][advice->holdout].standing;
  record.meets_goal = MeetsGoal(record.goal_standing);
  record.extrapolated_share = advice->extrapolated_share;
  record.removed_share = RemovedShare(advice->holdout, result);
  if (model.final_fit->history != nullptr) {
    record.memory = MemoryOf(*model.final_fit->history);
  }
  if (model.final_fit->interval) {
    record.promise = MakeRecord(*model.final_fit->interval);
  }
  record.since_start = SinceStart(study_, result, advice->holdout);
  if (study_.session_worth) record.session_worth = *study_.session_worth;
  if (study_.importance) record.importance = *study_.importance;
  if (advice->proven_better_than) {
    record.proven_better_than = Name(*advice->proven_better_than);
  } else if (!advice->fails_in.empty()) {
    record.fails_in = advice->fails_in;
  } else if (advice->single) {
    record.single = Name(*advice->single);
  }
  if (advice->better_but_no_map) {
    record.better_without_map = Name(*advice->better_but_no_map);
  }
  AddStates(&record);
  return record;
}

std::string_view WordOf(RezeroKind kind) {
  constexpr auto kNames =
      std::to_array<std::string_view>({"interval", "session", "probe"});
  return data::NameOf(kNames, kind);
}

}  // namespace

IntervalRecord RmseInterval(const HoldoutComparison& tests, std::size_t model) {
  // Two bound nothing: a factor of ten thousand either way is not a statement.
  constexpr Index kFewestUnits = 3;
  if (tests.tests.num_units < kFewestUnits) return {kNotKnown, kNotKnown};
  stats::Bounds95 bounds =
      tests.tests.rmse_bounds[static_cast<std::size_t>(*tests.PlaceOf(model))];
  bounds.lower = std::max(bounds.lower, 0.0);
  return IntervalOf(bounds);
}

std::optional<bool> MeetsGoal(GoalStanding standing) {
  switch (standing) {
    case GoalStanding::kNone:
    case GoalStanding::kNotJudged:
      return std::nullopt;
    default:
      return standing == GoalStanding::kMet;
  }
}

PromiseRecord MakeRecord(const PredictionInterval& interval) {
  PromiseRecord record{.holdout = interval.holdout,
                       .unit = interval.unit,
                       .units = interval.units};
  if (interval.good_for > 0) {
    record.lag1 = interval.lag1;
    record.good_for = interval.good_for;
  }
  for (const PredictionInterval::Level& level : interval.levels) {
    record.levels.push_back({level.coverage, level.half_width, level.at_least});
  }
  return record;
}

void AddJudgement(const ComponentStudy& study, ComponentRecord* record) {
  const JudgementRecord judgement(study);
  record->gap = study.judgement.gap;
  record->comparisons = judgement.Pairs();
  record->tiers = judgement.Tiers();
  record->stability = judgement.Stability();
  record->verdict = judgement.Verdicts();
  record->recommendation = judgement.Advice();
}

RezeroRecord MakeRezeroRecord(const ComponentStudy& study) {
  const RezeroRule& rule = *study.rezero;
  const RezeroWorth& worth = *study.rezero_worth;
  RezeroRecord record{
      .rule = rule.text,
      .when = std::string(WordOf(rule.kind)),
      .interval = std::isfinite(rule.interval) ? rule.interval : kNotKnown,
      .noise = rule.noise,
      .holdout = study.holdouts[study.judgement.recommendation->holdout].name,
      .probes = worth.probes,
      .scored_rows = worth.scored_rows,
      .no_map = worth.no_map};
  for (const RezeroWorth::Model& model : worth.models) {
    record.models.push_back(
        {study.study.models[model.model].name, model.rmse, model.never});
  }
  return record;
}

}  // namespace errmap::models
