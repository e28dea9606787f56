#include "cli/report/text/answers/remarks.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "cli/report/number_text.h"
#include "cli/report/report_view.h"
#include "cli/report/text/answers/further_remarks.h"
#include "cli/report/text/answers/rezero_text.h"
#include "data/measurements/dataset.h"
#include "data/text.h"
#include "models/study/judgement/goal.h"
#include "models/study/judgement/recommendation.h"
#include "models/study/judgement/units_of_analysis.h"
#include "stats/error_metrics.h"

namespace errmap::report {
namespace {

using models::Choice;
using models::GoalStanding;
using models::HoldoutRecord;
using models::PairRecord;
using models::RecommendationRecord;
using Numbers = ComponentNumbers;
using Place = Remark::Place;
using Remarks = std::vector<Remark>;
using Tone = Remark::Tone;

// What the share removed is of: no compensation, or the mean of a target that
// is not an error and far from 0.
std::string WithoutName(const Numbers& of) {
  const RecommendationRecord& advice = of.Advice();
  const double without = advice.rmse / (1.0 - advice.removed_share);
  return models::FindNamed(of.record.models, "mean") != nullptr &&
                 2.0 * without < of.Rmse("zero", advice.holdout)
             ? "mean"
             : "zero";
}

Remarks WithoutAMap(const Numbers& of) {
  const RecommendationRecord& advice = of.Advice();
  if (advice.model == "zero" || !std::isfinite(advice.removed_share)) return {};
  const std::string without = WithoutName(of);
  if (advice.model == without) return {};
  // Below this a map is hardly worth its trouble unless it is sure.
  constexpr double kMuch = 0.5;
  const double share = advice.removed_share;
  const std::string error =
      of.RmseWithUnit(without) + (without == "mean" ? " about the mean" : "");
  if (!(share > 0.0)) return {{"without a map", error}};
  return {{"without a map",
           fmt::format("{}; {:.0f} % removed{}",
                       error,
                       // Never all of what is still there.
                       std::min(std::round(kPercent * share), kPercent - 1.0),
                       share < kMuch ? "; " + of.Certainty(without) : "")}};
}

// The best of the simple maps; for a simple map the best of the others.
std::optional<std::string> RivalOf(const Numbers& of) {
  const RecommendationRecord& advice = of.Advice();
  if (advice.choice != Choice::kBaseline) return advice.best_baseline;
  std::optional<std::string> best;
  for (const ModelRecord& model : of.record.models) {
    const double rmse = TestRmse(model, advice.holdout);
    if (model.name == advice.model || model.baseline || !std::isfinite(rmse)) {
      continue;
    }
    if (!best || rmse < of.Rmse(*best, advice.holdout)) best = model.name;
  }
  return best;
}

Remarks Rival(const Numbers& of) {
  const RecommendationRecord& advice = of.Advice();
  const std::optional<std::string> rival = RivalOf(of);
  if (!rival || *rival == advice.model) return {};
  const bool errs_less =
      of.Rmse(*rival, advice.holdout) < of.Rmse(advice.model, advice.holdout);
  if (*rival == "zero" && !errs_less) return {};  // WithoutAMap
  const std::string rmse = of.RmseWithUnit(*rival);
  return {{advice.choice == Choice::kBaseline ? "best other map"
                                              : "best simple map",
           rmse == of.RmseWithUnit(advice.model)
               ? fmt::format("{}, {}: as good", rmse, *rival)
               : fmt::format("{}, {}{}; {}",
                             rmse,
                             *rival,
                             errs_less ? ", which has a lower error" : "",
                             of.Certainty(*rival))}};
}

Remarks AnotherDay(const Numbers& of) {
  const HoldoutRecord& holdout = of.HoldoutOfAdvice();
  if (holdout.another_file) return {};
  const auto said = [](std::string text, std::string measure = {}) {
    return Remarks{
        {"another day", std::move(text), Tone::kBad, std::move(measure)}};
  };
  if (of.record.data.sessions == 1) {
    return said("not measured: this is one run. Measure again on other days",
                "other days");
  }
  if (holdout.whole_sessions || holdout.whole_groups) return {};
  if (std::ranges::any_of(of.record.holdouts, &HoldoutRecord::whole_groups)) {
    return said("not known: no fit with whole groups held out succeeded");
  }
  return said(of.record.data.group
                  ? "not known: hold out whole groups, as by --holdout groups:5"
                  : "not known: name the column of cycles with --group");
}

// The map will be used on later days: its error there if it is fitted only to
// the days before them.
Remarks LaterOn(const Numbers& of) {
  constexpr double kWorthSaying = 1.25;  // of the error on another day
  const RecommendationRecord& advice = of.Advice();
  const HoldoutRecord* const later = LaterHoldoutOf(of.record, advice.holdout);
  if (later == nullptr) return {};
  const double rmse = TestRmse(of.Model(advice.model), later->name);
  if (!(rmse > kWorthSaying * of.Rmse(advice.model, advice.holdout))) return {};
  // The first fold learns from those before all that are held out.
  const std::int64_t fewest = of.UnitsOfData(*later) - later->units;
  return {{"later " + PluralOfUnit(*later),
           fmt::format("{}, fitted to as few as {}",
                       of.error.WithUnit(rmse),
                       CountOfUnits(fewest, *later)),
           Tone::kBad}};
}

Remarks GoodFor(const Numbers& of) {
  const auto& promise = of.Advice().promise;
  if (!promise || !promise->good_for) return {};
  return {{"good for",
           fmt::format("the next {}; further {} may err more",
                       *promise->good_for == 1
                           ? promise->unit
                           : Count(*promise->good_for, promise->unit),
                       PluralOf(promise->unit))}};
}

Remarks Interrupted(const Numbers& of) {
  if (!of.record.interrupted) return {};
  return {{"interrupted", "the fits are incomplete", Tone::kBad}};
}

// What is left is not noise where it shifts whole cycles, or repeats along the
// position.
Remarks WhatIsLeft(const Numbers& of) {
  constexpr double kWorthSaying = 0.25;  // of the squared residuals
  constexpr double kSignificance = 0.05;
  // Who has more of them gains little by yet another.
  constexpr std::ptrdiff_t kManySensors = 8;
  const RecommendationRecord& advice = of.Advice();
  const auto& found = of.Result(advice.model, advice.holdout).randomness;
  const auto matters = [](const auto& bias) {
    return bias && bias->explained >= kWorthSaying &&
           bias->test.value.p < kSignificance;
  };
  Remarks remarks;
  if (matters(found.by_group)) {
    const std::string unit = data::WordFor(
        {.column = found.by_group->column, .labels = {}, .codes = {}});
    std::string text = fmt::format("{:.0f} % of it shifts whole {} up or down",
                                   kPercent * found.by_group->explained,
                                   PluralOf(unit));
    if (advice.goal_standing != GoalStanding::kMet && !of.record.rezero) {
      text += fmt::format(": re-zero each {}{}",
                          unit,
                          of.record.data.sensors <= kManySensors
                              ? ", or add a thermometer"
                              : "");
    }
    remarks.push_back({"what is left", std::move(text)});
  }
  if (matters(found.by_position)) {
    remarks.push_back(
        {"what is left",
         fmt::format(
             "{:.0f} % of it repeats along {}: a finer curve would remove it",
             kPercent * found.by_position->explained,
             found.by_position->column)});
  }
  return remarks;
}

Remarks Rezeroed(const Numbers& of) {
  const auto& rezero = of.record.rezero;
  if (!rezero) return {};
  const auto map = std::ranges::find(
      rezero->models, of.Advice().model, &models::RezeroedModelRecord::model);
  if (map == rezero->models.end()) return {};
  const bool adds = map->never < map->rmse;
  return {{"re-zeroed",
           fmt::format("{}{}; without re-zeroing {}",
                       RezeroRuleWords(of.record),
                       adds ? ", which adds to the error" : "",
                       of.error.WithUnit(map->never)),
           adds ? Tone::kBad : Tone::kPlain}};
}

// Readings that never return: what is ahead lies outside the data.
Remarks OnlyGrows(const Numbers& of) {
  const auto& columns = of.Advice().only_grow;
  if (!columns || columns->empty()) return {};
  return {{"only grows",
           fmt::format("{}: future {} lie outside the data; compare with "
                       "--exclude {}",
                       data::JoinWords(*columns, " and "),
                       PluralOfUnit(of.HoldoutOfAdvice()),
                       data::JoinWords(*columns, ",")),
           Tone::kBad}};
}

Remarks RowsLearnt(const Numbers& of) {
  Remarks remarks;
  for (const HoldoutRecord& holdout : of.record.holdouts) {
    if (!holdout.rows_of_training) continue;
    remarks.push_back({"ignore " + holdout.name,
                       fmt::format("{} of its rows were used for training; "
                                   "give a file of another day",
                                   *holdout.rows_of_training),
                       Tone::kBad});
  }
  return remarks;
}

Remarks BetterWithoutMap(const Numbers& of) {
  const auto& better = of.Advice().better_without_map;
  if (!better) return {};
  return {{"lower error",
           fmt::format("{}, {}: predictions without a map to use",
                       of.RmseWithUnit(*better),
                       *better)}};
}

// How the error compares with the goal that was given.
Remarks HeldAgainstGoal(const Numbers& of) {
  const RecommendationRecord& advice = of.Advice();
  const models::DisplayRecord& display = of.record.display;
  const std::string wanted = WithSymbol(
      fmt::format("{:g}", of.record.goal * display.scale), display.unit);
  const models::ResultRecord& result = of.Result(advice.model, advice.holdout);
  const stats::ErrorMetrics& found = result.test;
  switch (advice.goal_standing) {
    case GoalStanding::kMet: {
      const HoldoutRecord* const later =
          LaterHoldoutOf(of.record, advice.holdout);
      const bool fails_later =
          later != nullptr &&
          TestRmse(of.Model(advice.model), later->name) > of.record.goal;
      return {{"goal",
               fmt::format(
                   "{}: reached{}{}",
                   wanted,
                   result.ci95[1] <= of.record.goal ? "" : "; not proven",
                   fails_later ? "; not on later " + PluralOfUnit(*later) : ""),
               fails_later ? Tone::kBad : Tone::kGood}};
    }
    case GoalStanding::kMetAfterRezeroing:
      return {
          {"goal",
           fmt::format("{}: reached after re-zeroing; the scatter is {} about "
                       "an offset of {}",
                       wanted,
                       of.error.WithUnit(found.sd),
                       of.error.WithUnit(found.mean)),
           Tone::kGood}};
    case GoalStanding::kMissed:
      return {{"goal", wanted + ": not reached", Tone::kBad}};
    case GoalStanding::kNotJudged:
      return {{"goal",
               found.n < models::kFewestRowsForGoal
                   ? fmt::format("{}: not judged on {} rows; {} are needed",
                                 wanted,
                                 found.n,
                                 models::kFewestRowsForGoal)
                   : wanted + ": not judged, since fits are missing"}};
    case GoalStanding::kNone:
      return {};
  }
  return {};
}

// Who gave a goal waits for this line.
Remarks Goal(const Numbers& of) {
  if (!std::isfinite(of.record.goal)) return {};
  Remarks remarks = HeldAgainstGoal(of);
  for (Remark& remark : remarks) remark.must_show = true;
  return remarks;
}

Remarks NoGoal(const Numbers& of) {
  if (std::isfinite(of.record.goal) || !of.record.display.unit.ends_with("m")) {
    return {};
  }
  return {{"goal", "none given; --goal 2um sets one"}};
}

Remarks CheckTheData(const Numbers& of) {
  Remarks remarks;
  for (const std::string& doubt : of.record.data.doubts) {
    remarks.push_back({"check the data", doubt, Tone::kBad});
  }
  return remarks;
}

// "sessions:5", "groups:5": holds out every day or cycle once.
std::string HoldoutOfAll(const HoldoutRecord& holdout, std::int64_t units) {
  constexpr std::int64_t kFolds = 5;
  return fmt::format("--holdout {}:{}",
                     holdout.whole_sessions ? "sessions" : "groups",
                     std::min(kFolds, units));
}

// "; 11 days may": how many would show which map is best. Where the data
// have enough of them, another hold-out does what measurements need not.
void SayHowManyWould(const Numbers& of,
                     const models::Obstacle& obstacle,
                     const std::string& may,
                     Remark* remark) {
  if (obstacle.needed <= 0) return;
  const HoldoutRecord& holdout = of.HoldoutOfAdvice();
  const std::int64_t all = of.UnitsOfData(holdout);
  const bool holds_out_all = all == holdout.units;
  const std::string how = holds_out_all ? "" : HoldoutOfAll(holdout, all);
  if (obstacle.needed <= all && !holds_out_all) {
    remark->text += fmt::format(
        "; all {} held out, by {}, {}", CountOfUnits(all, holdout), how, may);
    return;
  }
  remark->text +=
      fmt::format("; {} {}", CountOfUnits(obstacle.needed, holdout), may);
  remark->measure = fmt::format("{} {} or more in all{}",
                                obstacle.needed,
                                PluralOfUnit(holdout),
                                holds_out_all ? "" : ", with " + how);
}

// How much so few units tell, and how many would show which map is best.
Remarks HowSure(const Numbers& of) {
  const HoldoutRecord& holdout = of.HoldoutOfAdvice();
  const std::int64_t sessions = of.record.data.sessions;
  const bool little = !holdout.another_file && holdout.whole_sessions &&
                      sessions > 1 &&
                      sessions < models::kFewestSessionsToDecide;
  const auto obstacle = holdout.unit_of_analysis == models::kBlockOfRows
                            ? std::nullopt
                            : of.ObstacleOfAdvice();
  if (!little && !obstacle) return {};
  const std::string count = of.CountOfHeldOut(holdout.units, holdout);
  Remark remark{.label = "how sure",
                .text = count + (little ? " say little about another"
                                        : " cannot prove which map is best"),
                .tone = little ? Tone::kBad : Tone::kPlain};
  if (obstacle) {
    SayHowManyWould(
        of, *obstacle, little ? "may tell which map is best" : "may", &remark);
  }
  return {std::move(remark)};
}

// A range that reaches beyond what is there without a map leaves open whether
// the map helps at all.
Remarks PerhapsWorse(const Numbers& of) {
  const RecommendationRecord& advice = of.Advice();
  const auto& [low, high] = of.Result(advice.model, advice.holdout).ci95;
  if (advice.model == "zero" || !(low > 0.0)) return {};
  const ModelRecord* const none = models::FindNamed(of.record.models, "zero");
  const double without =
      none == nullptr ? models::kNotKnown : TestRmse(*none, advice.holdout);
  if (!(high > without)) return {};
  const models::PairRecord* const pair =
      models::FindPair(of.record, advice.holdout, advice.model, "zero");
  if (pair != nullptr && pair->established) return {};
  return {{"is it better?",
           fmt::format("not proven: the range ends above the {} without a map",
                       of.error.WithUnit(without)),
           Tone::kBad}};
}

// Their order is that of the answer. Where it has too little room, the last of
// those that need not be shown is left out first.
constexpr RemarkEntry kAnswer[] = {
    {WithoutAMap, Place::kAnswer, false},
    {PerhapsWorse, Place::kAnswer, true},
    {Rival, Place::kAnswer, false},
    {Goal, Place::kAnswer, false},
    {AnotherDay, Place::kAnswer, true},
    {LaterOn, Place::kAnswer, true},
    {GoodFor, Place::kAnswer, true},
    {Interrupted, Place::kAnswer, true},
    {WhatIsLeft, Place::kAnswer, false},
    {Rezeroed, Place::kAnswer, false},
    {OnlyGrows, Place::kAnswer, true},
    {RowsLearnt, Place::kAnswer, true},
    {BetterWithoutMap, Place::kAnswer, true},
    {CheckTheData, Place::kAnswer, true},
    {HowSure, Place::kAnswer, true},
    {NoGoal, Place::kAnswer, false},
};

}  // namespace

std::vector<Remark> RemarksOf(const ComponentNumbers& component) {
  Remarks all;
  for (const auto& entries :
       {std::span<const RemarkEntry>(kAnswer), FurtherRemarks()}) {
    for (const RemarkEntry& entry : entries) {
      for (Remark& remark : entry.make(component)) {
        remark.place = remark.must_show ? Place::kAnswer : entry.place;
        remark.is_caveat = entry.is_caveat;
        remark.must_show |= entry.is_caveat;
        all.push_back(std::move(remark));
      }
    }
  }
  return all;
}

std::string SentenceOf(const Remark& remark) {
  std::string label = remark.label;
  label.front() = static_cast<char>(
      std::toupper(static_cast<unsigned char>(label.front())));
  return fmt::format(
      "{}: {}{}", label, remark.text, remark.text.ends_with('.') ? "" : ".");
}

}  // namespace errmap::report
