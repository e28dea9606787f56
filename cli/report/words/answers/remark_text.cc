#include "cli/report/words/answers/remark_text.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/report/number_text.h"
#include "cli/report/words/answers/interval_text.h"
#include "cli/report/words/answers/verdict_sentences.h"
#include "data/text.h"
#include "data/units.h"

namespace errmap::report {
namespace {

using models::Confidence;
using models::FindNamed;
using models::GoalStanding;
using models::HoldoutRecord;
using models::RecommendationRecord;
using models::RemarkKind;
using models::RemarkRecord;
using models::VerdictRecord;
using Kind = models::Obstacle::Kind;

// What one more session of measurements may bring.
std::string OneMoreText(const models::SessionWorth& worth,
                        const std::string& unit) {
  constexpr double kWorthSaying = 0.02;
  const double saved = 1.0 - worth.ratio_of_one_more;
  if (!(saved > kWorthSaying)) {
    return fmt::format(
        "With one {0} fewer to learn from it erred {1:.2f} times as much: one "
        "more {0} of the same kind promises little.",
        unit,
        worth.ratio_of_one_fewer);
  }
  return fmt::format(
      "With one {0} fewer to learn from it erred {1:.2f} times as much: one "
      "more {0} may take {2:.0f} % off its error.",
      unit,
      worth.ratio_of_one_fewer,
      kPercent * saved);
}

// After how long a step of temperature is forgotten, and the zero.
std::string MemoryText(const models::MemoryRecord& memory) {
  // After three time constants 5 % of a step is left.
  constexpr double kForgotten = 3.0;
  constexpr double kSecondsPerMinute = 60.0;
  constexpr double kMinutesPerHour = 60.0;
  std::string text;
  if (memory.longest > 0.0) {
    const double span = kForgotten * memory.longest;
    const double minutes = span / kSecondsPerMinute;
    text +=
        memory.time_unit != "s"
            ? fmt::format(" over the last {:.0f} rows", span)
        : minutes < 2.0 * kMinutesPerHour
            ? fmt::format(" over the last {:.0f} min", minutes)
            : fmt::format(" over the last {:.2g} h", minutes / kMinutesPerHour);
  }
  if (memory.zeroed) text += ", zeroed at the start of a session";
  return text;
}

std::string CostSentence(const RecommendationRecord& advice) {
  std::string sensors =
      advice.memory ? "no sensor, but the other inputs" : "no sensor";
  if (!advice.sensors.empty()) {
    sensors = Count(std::ssize(advice.sensors), "sensor");
    if (advice.sensors.size() <= kMostSensorsNamed) {
      std::vector<std::string> names;
      for (const std::string& sensor : advice.sensors) {
        names.push_back(data::Printable(sensor, std::string_view::npos));
      }
      sensors += fmt::format(" ({})", data::JoinWords(names, ", "));
    }
  }
  std::string cost = Count(advice.cost.multiplications, "multiplication");
  if (advice.cost.exponentials > 0) {
    cost += " and " + Count(advice.cost.exponentials, "exponential");
  }
  return fmt::format("It needs {}{}; a prediction costs {}.",
                     sensors,
                     advice.memory ? MemoryText(*advice.memory) : "",
                     cost);
}

std::string SimplestSentence(const ComponentNumbers& component,
                             const RemarkRecord& remark) {
  const RecommendationRecord& advice = component.Advice();
  if (remark.kind == RemarkKind::kLowestAndSimplest) {
    return fmt::format(
        "It has the lowest error and is the simplest of its "
        "tier (the others: {}).",
        ListBesides(advice.first_tier, advice.model));
  }
  const std::string& model = There(remark.model);
  const std::string rmse =
      component.error.WithUnit(component.Rmse(model, advice.holdout));
  switch (remark.kind) {
    case RemarkKind::kAveragesMaps:
      return fmt::format(
          "No single map is proven better by separate days, and an average of "
          "maps risks less than the choice of one. {} {} ({}).",
          advice.decided_by != advice.holdout
              ? fmt::format("Of single maps {} would choose", advice.decided_by)
          : std::ranges::find(advice.first_tier, model) ==
                  advice.first_tier.end()
              ? "The best single map is"
              : "The simplest single map is",
          model,
          rmse);
    case RemarkKind::kSimplestNearLowest:
      return fmt::format(
          "It is the simplest of those that are near the lowest "
          "error ({} of {}); more is not known.",
          rmse,
          model);
    default:
      return fmt::format(
          "It is the simplest of those without practical difference: {} has "
          "the lowest error ({}). With 95 % certainty it loses at most {} to "
          "it{}.",
          model,
          rmse,
          component.error.WithUnit(There(remark.excess)),
          There(remark.confidence) != Confidence::kEstablished
              ? fmt::format(", as if {} were independent",
                            PluralOfUnit(component.Holdout(advice.holdout)))
              : "");
  }
}

// "1.645 um, 0.837 um more (95 % 0.490 to 1.184)": another one beside the map.
std::string BesideTheMap(const ComponentNumbers& component,
                         const std::string& other) {
  const RecommendationRecord& advice = component.Advice();
  const double rmse = component.Rmse(other, advice.holdout);
  const double more = rmse - component.Rmse(advice.model, advice.holdout);
  std::string text = fmt::format("{}, {} {}",
                                 component.error.WithUnit(rmse),
                                 component.error.WithUnit(std::abs(more)),
                                 more < 0.0 ? "less" : "more");
  const models::PairRecord* const pair =
      FindPair(component.record, advice.holdout, advice.model, other);
  if (pair == nullptr) return text;
  const models::IntervalRecord excess =
      IntervalOfExcess(*pair, more < 0.0 ? advice.model : other);
  // As of a baseline: verdict_sentences.cc.
  return text + component.In95(excess) +
         (pair->established ? ""
          : excess[0] > 0.0 ? "; call it likely"
                            : "; that may be chance");
}

// "The best net, net:scg, has 1.645 um, 0.837 um more (95 % 0.490 to 1.184)."
std::string BestNetSentence(const ComponentNumbers& component,
                            const std::string& net) {
  const RecommendationRecord& advice = component.Advice();
  const double rmse = component.Rmse(net, advice.holdout);
  const auto in_first_tier = [&](const std::string& model) {
    return std::ranges::find(advice.first_tier, model) !=
           advice.first_tier.end();
  };
  if (in_first_tier(net) && in_first_tier(advice.model)) {
    const auto parameters = component.Model(net).parameters;
    return fmt::format("The best net, {} ({}), is interchangeable with it{}.",
                       net,
                       component.error.WithUnit(rmse),
                       parameters && *parameters > advice.parameters
                           ? fmt::format(" and dearer: {} parameters for {}",
                                         *parameters,
                                         advice.parameters)
                           : "");
  }
  return fmt::format(
      "The best net, {}, has {}.", net, BesideTheMap(component, net));
}

// "poly:ridge takes 63 operations a step in place of 812 and has 0.900 um,
// 0.199 um more (95 % 0.100 to 0.300)."
std::string SmallerSentence(const ComponentNumbers& component,
                            const std::string& smaller) {
  const auto operations = [&](const std::string& model) {
    return component.Model(model).step_cost->operations();
  };
  return fmt::format("{} takes {} operations a step in place of {} and has {}.",
                     smaller,
                     operations(smaller),
                     operations(component.Advice().model),
                     BesideTheMap(component, smaller));
}

// Few sessions were held out whole: what they promise is little known.
std::string FewSessionsSentence(const ComponentNumbers& component,
                                const std::string& decided_by) {
  const RecommendationRecord& advice = component.Advice();
  return fmt::format(
      "{} tell little of another{}.",
      CountOfUnits(component.record.data.sessions,
                   component.Holdout(advice.holdout)),
      decided_by == advice.holdout
          ? ""
          : fmt::format(", so the map was chosen by {} held out ({})",
                        PluralOfUnit(component.Holdout(decided_by)),
                        decided_by));
}

std::string GoalSentence(const ComponentNumbers& component) {
  const RecommendationRecord& advice = component.Advice();
  const models::MetricsRecord& found =
      component.Result(advice.model, advice.holdout).test;
  std::string why;
  if (advice.goal_standing == GoalStanding::kNotJudged) {
    why = ": the run was interrupted or a fit failed";
  } else if (std::isfinite(found.sd)) {
    why = fmt::format(": scatter {} about an offset of {}",
                      component.error.WithUnit(found.sd),
                      component.error.WithUnit(found.mean));
  }
  return fmt::format("The goal (RMSE at most {:g}{}{}) is {}{}.",
                     component.record.goal * component.record.display.scale,
                     component.record.display.unit.empty() ? "" : " ",
                     component.record.display.unit,
                     models::ToString(advice.goal_standing),
                     why);
}

std::string DisagreementSentence(const ComponentNumbers& component,
                                 const RemarkRecord& remark) {
  std::vector<std::string> parts;
  for (const std::string& holdout : There(remark.holdouts)) {
    const std::string& best = component.Verdict(holdout).model;
    parts.push_back(
        fmt::format("Under {} it has {}, {} has {}.",
                    holdout,
                    component.error.WithUnit(
                        component.Rmse(component.Advice().model, holdout)),
                    best,
                    component.error.WithUnit(component.Rmse(best, holdout))));
  }
  return "The hold-outs of unseen rows disagree. " +
         data::JoinWords(parts, " ");
}

std::string CorrelationSentence(const ComponentNumbers& component,
                                const RemarkRecord& remark) {
  return fmt::format(
      "Neighbouring {} resemble each other (lag-1 correlation {:.2f} of the "
      "loss differences), so their number proves little. {} is called "
      "established; more days, held out whole, would tell.",
      PluralOfUnit(component.Holdout(component.Advice().holdout)),
      There(remark.lag1),
      There(remark.established) == 0
          ? "Nothing"
          : fmt::format("Only what is free of that, {} of {},",
                        There(remark.established),
                        Count(There(remark.pairs), "difference")));
}

// "6 cycles cannot prove a difference between 9 maps: ..."
std::string TooFewSentence(const ComponentNumbers& component,
                           const RemarkRecord& remark) {
  const RecommendationRecord& advice = component.Advice();
  const HoldoutRecord& holdout = component.Holdout(advice.holdout);
  const models::Obstacle& obstacle =
      There(component.Verdict(advice.holdout).obstacle);
  const std::string found = Count(obstacle.units, holdout.unit_of_analysis);
  const bool one = obstacle.units == 1;
  if (remark.kind == RemarkKind::kTooManyMaps) {
    const auto maps = std::ranges::count(
        component.record.models, false, &ModelRecord::baseline);
    return fmt::format(
        "{} cannot prove a difference between {} maps: {}compare fewer.",
        found,
        maps,
        obstacle.needed > 0
            ? fmt::format("measure {} or more in all, or ", obstacle.needed)
            : "");
  }
  if (obstacle.kind == Kind::kPerhapsOneSession) {
    return fmt::format(
        "{} that may be of one day cannot prove which map is better: measure "
        "{} or more in all, or on several days (a column day or session).",
        found,
        obstacle.needed);
  }
  return fmt::format(
      "{} alone cannot prove which map is better: measure {} or more in "
      "all.",
      one ? "One " + holdout.unit_of_analysis : found,
      obstacle.needed);
}

std::string OtherCutsSentence(const ComponentNumbers& component) {
  std::vector<std::string> parts;
  for (const models::StabilityRecord& cuts : component.record.stability) {
    constexpr std::size_t kMostNamed = 3;
    std::vector<std::string> shares;
    for (std::size_t i = 0; i < std::min(cuts.wins.size(), kMostNamed); ++i) {
      shares.push_back(fmt::format(
          "{} {:.0f} %", cuts.wins[i].model, kPercent * cuts.wins[i].share));
    }
    parts.push_back(fmt::format("{} {} cuts of {} the lowest error went to {}",
                                parts.empty() ? "Of" : "of",
                                cuts.repeats,
                                cuts.holdout,
                                data::JoinWords(shares, ", ")));
  }
  return fmt::format("{}.", data::JoinWords(parts, "; "));
}

// Readings that never return: what is ahead lies outside the data.
std::string OnlyGrowsSentence(const ComponentNumbers& component,
                              const RemarkRecord& remark) {
  const RecommendationRecord& advice = component.Advice();
  const std::vector<std::string>& columns = There(remark.columns);
  std::string forward;
  if (remark.holdouts) {
    const std::string& holdout = First(*remark.holdouts);
    forward = fmt::format(
        "; predicted from those before ({}) it has {}",
        holdout,
        component.error.WithUnit(component.Rmse(advice.model, holdout)));
  }
  return fmt::format(
      "{} hardly ever {} had: {} to come lie beyond all that were held "
      "out{}. Compare without: --exclude {}.",
      data::JoinWords(columns, " and "),
      columns.size() == 1 ? "returns to values it" : "return to values they",
      PluralOfUnit(component.Holdout(advice.holdout)),
      forward,
      data::JoinWords(columns, ","));
}

std::string RowsLearntSentence(const ComponentNumbers& component,
                               const RemarkRecord& remark) {
  std::vector<std::string> parts;
  for (const std::string& name : There(remark.holdouts)) {
    parts.push_back(fmt::format("{} of the rows of {}",
                                There(component.Holdout(name).rows_of_training),
                                name));
  }
  return fmt::format(
      "{} were learnt: ignore {}, or give a file of another day.",
      data::JoinWords(parts, " and "),
      parts.size() == 1 ? "its column" : "their columns");
}

// What a person does to bring a column below, or above, all its values so far.
struct StatesBeyond {
  const char* below;
  const char* above;
};

StatesBeyond StatesOf(const std::string& column) {
  const data::Unit unit = data::UnitOfColumn(column);
  if (unit.symbol == "rpm") return {"a slower spindle", "a faster spindle"};
  switch (unit.quantity) {
    case data::Quantity::kTemperature:
      return {"a colder start or room", "a longer run or hotter room"};
    case data::Quantity::kTime:
      return {"the first minutes", "a longer run"};
    case data::Quantity::kLength:
    case data::Quantity::kAngle:
      return {"positions further down", "positions further up"};
    default:
      return {"smaller values", "larger values"};
  }
}

// What is left is no noise where it has an offset per cycle, or repeats along
// the position.
std::string WhatIsLeftSentence(const ComponentNumbers& component,
                               const RemarkRecord& remark) {
  const auto& by_group =
      component.Result(component.Advice().model, component.Advice().holdout)
          .randomness.by_group;
  std::string text;
  for (std::size_t i = 0; i < There(remark.columns).size(); ++i) {
    const std::string& column = remark.columns->at(i);
    const double percent = kPercent * Part(There(remark.shares), i);
    text += text.empty() ? "" : " ";
    text += by_group && by_group->column == column
                ? fmt::format(
                      "{:.0f} % of what is left is an offset per {}: a thermal "
                      "state that the sensors do not see.{}",
                      percent,
                      column,
                      !remark.add_sensor
                          ? ""
                          : fmt::format(" {} each {}.",
                                        *remark.add_sensor
                                            ? "Add a sensor, or re-zero"
                                            : "Re-zero",
                                        column))
                : fmt::format(
                      "{:.0f} % of what is left repeats along {}: the map is "
                      "too smooth there.",
                      percent,
                      column);
  }
  return text;
}

std::string FlatteredSentence(const ComponentNumbers& component,
                              const std::string& model) {
  const models::GapModelRecord& row = component.Gap(model);
  return fmt::format(
      "Ignore the {} column for {}: {} next to known rows, {} on a {} it "
      "never saw.",
      component.record.gap->neighbours,
      model,
      component.error.WithUnit(row.neighbours_rmse),
      component.error.WithUnit(row.unseen_rmse),
      component.Holdout(component.record.gap->unseen).unit_of_analysis);
}

}  // namespace

std::string RemarkText(const ComponentNumbers& component,
                       const RemarkRecord& remark) {
  const RecommendationRecord& advice = component.Advice();
  const HoldoutRecord& holdout = component.Holdout(advice.holdout);
  const ModelRecord& model = component.Model(advice.model);
  const auto unknown_day = [](const char* why) {
    return fmt::format("How it does on another day is not known, since {}.",
                       why);
  };
  switch (remark.kind) {
    case RemarkKind::kAveragesMaps:
    case RemarkKind::kLowestAndSimplest:
    case RemarkKind::kSimplestNearLowest:
    case RemarkKind::kSimplestOfTier:
      return SimplestSentence(component, remark);
    case RemarkKind::kOnlyGrows:
      return OnlyGrowsSentence(component, remark);
    case RemarkKind::kSimpleHolds:
      return fmt::format(
          "It is simple: under {} the average of maps typically errs more than "
          "twice as much.",
          First(There(remark.holdouts)));
    case RemarkKind::kRowsLearnt:
      return RowsLearntSentence(component, remark);
    case RemarkKind::kProvenBetter:
      return fmt::format(
          "{} prove it better than the average of maps that is used else, {} "
          "({}).",
          CountOfUnits(holdout.units, holdout),
          There(remark.model),
          component.error.WithUnit(
              component.Rmse(There(remark.model), advice.holdout)));
    case RemarkKind::kRemoves:
      return fmt::format(
          "It removes {:.0f} % of the error ({} without a map).",
          std::floor(kPercent * advice.removed_share),
          component.error.WithUnit(component.Rmse("zero", advice.holdout)));
    case RemarkKind::kBeatsBaseline:
      return AgainstBaselineSentence(component);
    case RemarkKind::kBestNet:
      return BestNetSentence(component, There(remark.model));
    case RemarkKind::kSmaller:
      return SmallerSentence(component, There(remark.model));
    case RemarkKind::kGap: {
      const models::GapModelRecord& row = component.Gap(advice.model);
      return fmt::format(
          "Next to known rows ({}) {} has {}, on unseen {} {} times that.",
          component.record.gap->neighbours,
          advice.model,
          component.error.WithUnit(row.neighbours_rmse),
          PluralOfUnit(component.Holdout(component.record.gap->unseen)),
          RatioText(row.ratio));
    }
    case RemarkKind::kPromise:
      return IntervalText(There(advice.promise), component.error) +
             (component.record.rezero ? ", never re-zeroed." : ".");
    case RemarkKind::kOneMoreSession:
      return OneMoreText(There(advice.session_worth), holdout.unit_of_analysis);
    case RemarkKind::kGoal:
      return GoalSentence(component);
    case RemarkKind::kCost:
      return CostSentence(advice);
    case RemarkKind::kNotNoise:
      return WhatIsLeftSentence(component, remark);
    case RemarkKind::kInterrupted:
      return "The run was interrupted; fits are incomplete.";
    case RemarkKind::kOneRunOnly:
      return component.IsOfOneRun(holdout)
                 ? "Nothing is known of another day."
                 : "One run only: nothing is known of another day.";
    case RemarkKind::kGroupFitsFailed:
      return unknown_day("no fit for whole groups held out succeeded");
    case RemarkKind::kNoGroupsHeldOut:
      return unknown_day("no whole groups were held out (--holdout groups:K)");
    case RemarkKind::kNoGroups:
      return unknown_day(
          "no whole cycles were held out (name their column with --group)");
    case RemarkKind::kFewSessions:
      return FewSessionsSentence(component, First(There(remark.holdouts)));
    case RemarkKind::kBlocksForUnits:
      return fmt::format(
          "There are no groups: the tests count {} of held-out rows in order, "
          "which may still resemble each other.",
          Count(holdout.units, "block"));
    case RemarkKind::kTooFewUnits:
    case RemarkKind::kTooManyMaps:
      return TooFewSentence(component, remark);
    case RemarkKind::kIgnoreNeighbours:
      return FlatteredSentence(component, There(remark.model));
    case RemarkKind::kHoldoutsDisagree:
      return DisagreementSentence(component, remark);
    case RemarkKind::kUnitsCorrelated:
      return CorrelationSentence(component, remark);
    case RemarkKind::kExtrapolates: {
      const std::string where = WhereToMeasure(remark);
      return fmt::format(
          "In {:.0f} % of the held-out rows an input lies outside what the "
          "fold was trained on: the map extrapolates.{}",
          kPercent * advice.extrapolated_share,
          where.empty() ? "" : " Measure " + where + ".");
    }
    case RemarkKind::kNotConverged:
      return fmt::format(
          "Its fit ended without converging ({}): another start or run length "
          "would give another map.",
          fitting::ToString(There(model.final).summary.value.stop));
    case RemarkKind::kNoiseLearning:
      return There(model.memorisation).sentence;
    case RemarkKind::kOtherCuts:
      return OtherCutsSentence(component);
    case RemarkKind::kBetterWithoutMap:
      return fmt::format(
          "The predictions {} are better ({}), but there is no map of them "
          "here to use.",
          There(remark.model),
          component.error.WithUnit(
              component.Rmse(There(remark.model), advice.holdout)));
  }
  return "";
}

std::string WhereToMeasure(const RemarkRecord& remark) {
  if (!remark.columns || !remark.below || !remark.above ||
      remark.below->size() != remark.columns->size() ||
      remark.above->size() != remark.columns->size()) {
    return "";  // of an older record
  }
  // By what a person can do, the columns that would show it; one is named.
  std::vector<std::pair<const char*, std::vector<std::string>>> states;
  const auto add = [&](const char* state, std::string shown) {
    auto found = std::ranges::find(
        states, std::string_view(state), [](const auto& entry) {
          return std::string_view(entry.first);
        });
    if (found == states.end()) found = states.insert(found, {state, {}});
    found->second.push_back(std::move(shown));
  };
  for (std::size_t i = 0; i < There(remark.columns).size(); ++i) {
    const std::string& column = remark.columns->at(i);
    const std::string name = data::Printable(column, column.size());
    const StatesBeyond beyond = StatesOf(column);
    if (const double below = remark.below->at(i); std::isfinite(below)) {
      add(beyond.below, fmt::format("{} below {:.4g}", name, below));
    }
    if (const double above = remark.above->at(i); std::isfinite(above)) {
      add(beyond.above, fmt::format("{} above {:.4g}", name, above));
    }
  }
  std::vector<std::string> parts;
  for (const auto& [state, shown] : states) {
    parts.push_back(fmt::format("{} ({})", state, shown.front()));
  }
  return data::JoinWords(parts, "; ");
}

}  // namespace errmap::report
