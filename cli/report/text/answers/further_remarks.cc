#include "cli/report/text/answers/further_remarks.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "cli/report/number_text.h"
#include "cli/report/text/answers/interval_text.h"
#include "cli/report/text/answers/mark_words.h"
#include "cli/report/text/answers/rezero_text.h"
#include "cli/report/text/answers/verdict_sentences.h"
#include "data/column_header.h"
#include "data/text.h"
#include "data/units.h"

namespace errmap::report {
namespace {

using models::Choice;
using models::GoalStanding;
using models::PairRecord;
using models::RecommendationRecord;
using Numbers = ComponentNumbers;
using Place = Remark::Place;
using Remarks = std::vector<Remark>;
using Tone = Remark::Tone;

// --- Next steps --------------------------------------------------------------

// What to do for readings beyond those of training, of a column in this unit.
struct StatesBeyond {
  const char* below;
  const char* above;
};

StatesBeyond StatesOf(const std::string& column) {
  const data::Unit unit = data::UnitOfColumn(column);
  if (unit.symbol == "rpm") return {"a slower spindle", "a faster spindle"};
  switch (unit.quantity) {
    case data::Quantity::kTemperature:
      return {"a colder start or room", "a longer or hotter run"};
    case data::Quantity::kTime:
      return {"the first minutes", "a longer run"};
    case data::Quantity::kLength:
    case data::Quantity::kAngle:
      return {"positions further down", "positions further up"};
    default:
      return {"", ""};  // only the column says what to do
  }
}

// "a colder start or room (t12_degC below 21.5)": what a person can do, with
// the first column that would show it.
std::string WhereToMeasure(const std::vector<models::BeyondRecord>& beyond) {
  std::vector<std::string> parts;
  std::vector<std::string_view> named;
  const auto add = [&](const char* state,
                       const std::string& column,
                       const char* side,
                       double value) {
    const bool has_state = *state != '\0';
    if (!std::isfinite(value) ||
        (has_state && std::ranges::find(named, state) != named.end())) {
      return;
    }
    if (has_state) named.emplace_back(state);
    const std::string limit =
        fmt::format("{} {} {:.4g}", data::Printable(column), side, value);
    parts.push_back(has_state ? fmt::format("{} ({})", state, limit)
                              : "readings with " + limit);
  };
  for (const models::BeyondRecord& of : beyond) {
    const StatesBeyond states = StatesOf(of.column);
    add(states.below, of.column, "below", of.below);
    add(states.above, of.column, "above", of.above);
  }
  return data::JoinWords(parts, "; ");
}

Remarks Extrapolated(const Numbers& of) {
  const RecommendationRecord& advice = of.Advice();
  if (!advice.beyond) return {};
  return {{.label = "extrapolated",
           .text = fmt::format(
               "{:.0f} % of the test readings were beyond all training "
               "data; expect more error in such states",
               kPercent * advice.extrapolated_share),
           .measure = WhereToMeasure(*advice.beyond),
           .must_show = advice.extrapolated_share > 0.5}};
}

// "1.645 um, 0.837 um more (95 % 0.490 to 1.184)": another one beside the map.
std::string BesideTheMap(const Numbers& of, const std::string& other) {
  const RecommendationRecord& advice = of.Advice();
  const double more =
      of.Rmse(other, advice.holdout) - of.Rmse(advice.model, advice.holdout);
  std::string text = fmt::format("{}, {} {}",
                                 of.RmseWithUnit(other),
                                 of.error.WithUnit(std::abs(more)),
                                 more < 0.0 ? "less" : "more");
  const PairRecord* const pair =
      models::FindPair(of.record, advice.holdout, advice.model, other);
  if (pair == nullptr) return text;
  return text +
         of.In95(IntervalOfExcess(*pair, more < 0.0 ? advice.model : other)) +
         "; " + of.Certainty(other);
}

// For a control with little time: the smallest map that meets the goal as the
// recommended one does, else the best one of half its operations or fewer that
// errs at most twice as much.
Remarks SmallerMap(const Numbers& of) {
  constexpr std::int64_t kSmallAlready = 100;  // for any control
  constexpr double kMostLoss = 2.0;
  const RecommendationRecord& advice = of.Advice();
  const auto operations = [](const ModelRecord& model) {
    return model.step_cost ? model.step_cost->operations() : 0;
  };
  const std::int64_t full = operations(of.Model(advice.model));
  if (full < kSmallAlready) return {};
  const bool by_goal = advice.goal_standing == GoalStanding::kMet;
  const ModelRecord* smaller = nullptr;
  for (const ModelRecord& model : of.record.models) {
    const ResultRecord* const result = ResultOf(model, advice.holdout);
    const std::int64_t own = operations(model);
    if (result == nullptr || own == 0 || 2 * own > full ||
        (by_goal ? result->goal_standing != GoalStanding::kMet
                 : result->test.rmse >
                       kMostLoss * of.Rmse(advice.model, advice.holdout))) {
      continue;
    }
    if (smaller == nullptr ||
        (by_goal ? own < operations(*smaller)
                 : result->test.rmse < TestRmse(*smaller, advice.holdout))) {
      smaller = &model;
    }
  }
  if (smaller == nullptr) return {};
  return {{"a smaller map",
           fmt::format("{}: {} operations for the map alone, not {}; {}",
                       smaller->name,
                       operations(*smaller),
                       full,
                       BesideTheMap(of, smaller->name))}};
}

// Who does not get a net asks why; where it errs less, nothing says why not.
Remarks WhyNoNet(const Numbers& of) {
  const RecommendationRecord& advice = of.Advice();
  const auto is_net = [](const ModelRecord& model) {
    return model.choice == Choice::kNeural;
  };
  const ModelRecord* net = nullptr;
  for (const ModelRecord& model : of.record.models) {
    if (!is_net(model) || !std::isfinite(TestRmse(model, advice.holdout))) {
      continue;
    }
    if (net == nullptr ||
        TestRmse(model, advice.holdout) < TestRmse(*net, advice.holdout)) {
      net = &model;
    }
  }
  if (net == nullptr || is_net(of.Model(advice.model))) return {};
  const bool errs_less =
      TestRmse(*net, advice.holdout) < of.Rmse(advice.model, advice.holdout);
  return {
      {errs_less ? "a neural net" : "why no net",
       fmt::format(
           "the best, {}, has {}", net->name, BesideTheMap(of, net->name))}};
}

// --- Details -----------------------------------------------------------------

Remarks WhyThisOne(const Numbers& of) {
  const std::string why = WhyRecommended(of);
  if (why.empty()) return {};
  return {{"why this one", why}};
}

// The maps that a blend averages, those of the largest share by name.
Remarks Averages(const Numbers& of) {
  constexpr std::size_t kMostNamed = 2;
  const ModelRecord& model = of.Model(of.Advice().model);
  if (model.choice != Choice::kBlend || !model.final) return {};
  return {{"made of",
           data::ShortList(model.final->remarks, kMostNamed, "; ", "; ")}};
}

Remarks Interval(const Numbers& of) {
  const auto& promise = of.Advice().promise;
  if (!promise) return {};
  return {{"interval",
           IntervalText(*promise, of.error) +
               (of.record.rezero ? ", never re-zeroed" : "")}};
}

// What one more session of measurements may bring.
Remarks MoreData(const Numbers& of) {
  constexpr double kWorthSaying = 0.02;
  const auto& worth = of.Advice().session_worth;
  if (!worth) return {};
  const std::string& unit = of.HoldoutOfAdvice().unit_of_analysis;
  const double saved = 1.0 - worth->ratio_of_one_more;
  return {
      {"more data",
       fmt::format(
           "with one {} fewer the error is {:.2f} times as large; one more {}",
           unit,
           worth->ratio_of_one_fewer,
           saved > kWorthSaying
               ? fmt::format("may reduce it by {:.0f} %", kPercent * saved)
               : "would hardly reduce it")}};
}

// How far the map looks back, and the zero.
std::string MemoryText(const models::MemoryRecord& memory) {
  // After three time constants 5 % of a step is left.
  constexpr double kForgotten = 3.0;
  std::string text;
  if (memory.longest > 0.0) {
    const double span = kForgotten * memory.longest;
    text += "; it looks back " + (memory.time_unit == "s"
                                      ? DurationText(span)
                                      : fmt::format("{:.0f} rows", span));
  }
  if (memory.zeroed) text += "; its zero is the start of a session";
  return text;
}

Remarks Cost(const Numbers& of) {
  constexpr std::size_t kMostSensorsNamed = 8;
  const RecommendationRecord& advice = of.Advice();
  std::string text = advice.sensors.empty()
                         ? "no sensor"
                         : Count(std::ssize(advice.sensors), "sensor");
  if (!advice.sensors.empty() && advice.sensors.size() <= kMostSensorsNamed) {
    const std::string names = data::JoinWords(advice.sensors, ", ");
    text += fmt::format(" ({})", data::Printable(names));
  }
  if (advice.memory) text += MemoryText(*advice.memory);
  text += "; a prediction takes " +
          Count(advice.cost.multiplications, "multiplication");
  if (advice.cost.exponentials > 0) {
    text += " and " + Count(advice.cost.exponentials, "exponential");
  }
  return {{"cost", std::move(text)}};
}

Remarks Neighbours(const Numbers& of) {
  const auto& gap = of.record.gap;
  if (!gap || gap->warning.empty()) return {};
  return {{"neighbours", GapSentence(of)}};
}

// Other hold-outs of unseen rows in whose first tier the map is not.
Remarks Disagreement(const Numbers& of) {
  const RecommendationRecord& advice = of.Advice();
  std::vector<std::string> parts;
  for (const models::VerdictRecord& verdict : of.record.verdict) {
    if (verdict.holdout == advice.holdout ||
        of.Holdout(verdict.holdout).among_neighbours) {
      continue;
    }
    const ResultRecord* const result =
        ResultOf(of.Model(advice.model), verdict.holdout);
    if (result == nullptr || result->tier < 2) continue;
    parts.push_back(
        fmt::format("{} has a lower error under {}: {}, not {}",
                    verdict.model,
                    verdict.holdout,
                    of.error.WithUnit(of.Rmse(verdict.model, verdict.holdout)),
                    of.error.WithUnit(result->test.rmse)));
  }
  if (parts.empty()) return {};
  return {{"disagreement", data::JoinWords(parts, "; ")}};
}

Remarks ErrAlike(const Numbers& of) {
  const RecommendationRecord& advice = of.Advice();
  const auto verdict = std::ranges::find(
      of.record.verdict, advice.holdout, &models::VerdictRecord::holdout);
  if (verdict == of.record.verdict.end() || !verdict->rival) return {};
  const PairRecord* const pair = models::FindPair(
      of.record, advice.holdout, verdict->model, *verdict->rival);
  if (pair == nullptr || !pair->correlated) return {};
  const auto established =
      std::ranges::count_if(of.record.comparisons, [&](const PairRecord& one) {
        return one.holdout == advice.holdout && one.established;
      });
  return {{"memory",
           fmt::format("neighbouring {} err alike (lag-1 autocorrelation "
                       "{:.2f}), so their number proves little; {}",
                       PluralOfUnit(of.HoldoutOfAdvice()),
                       pair->lag1,
                       established == 0
                           ? "no difference is established"
                           : fmt::format("{} established",
                                         Count(established, "difference"))),
           Tone::kPlain,
           of.record.data.sessions > 1 ? "more days" : "other days"}};
}

Remarks NotConverged(const Numbers& of) {
  const ModelRecord& model = of.Model(of.Advice().model);
  const auto& summary = Require(model.final).summary.value;
  if (summary.converged) return {};
  return {{"not converged",
           fmt::format("its fit ended by {}: another start or more iterations "
                       "would give another map",
                       fitting::ToString(summary.stop))}};
}

Remarks LearnsNoise(const Numbers& of) {
  const auto& found = of.Model(of.Advice().model).memorisation;
  if (!found || found->learning != models::NoiseLearning::kMuch) return {};
  return {{"noise", found->sentence}};
}

Remarks OtherCuts(const Numbers& of) {
  constexpr std::size_t kMostNamed = 3;
  Remarks remarks;
  for (const models::StabilityRecord& cuts : of.record.stability) {
    std::vector<std::string> shares;
    for (std::size_t i = 0; i < std::min(cuts.wins.size(), kMostNamed); ++i) {
      shares.push_back(fmt::format(
          "{} {:.0f} %", cuts.wins[i].model, kPercent * cuts.wins[i].share));
    }
    remarks.push_back(
        {"other splits",
         fmt::format("in {} splits of {} the lowest error went to {}",
                     cuts.repeats,
                     cuts.holdout,
                     data::JoinWords(shares, ", "))});
  }
  return remarks;
}

constexpr RemarkEntry kFurther[] = {
    {WhyThisOne, Place::kDetails, false},
    {Averages, Place::kNextSteps, false},
    {Extrapolated, Place::kNextSteps, true},
    {SmallerMap, Place::kNextSteps, false},
    {WhyNoNet, Place::kNextSteps, false},
    {Interval, Place::kDetails, false},
    {MoreData, Place::kDetails, false},
    {Cost, Place::kDetails, false},
    {Neighbours, Place::kDetails, true},
    {Disagreement, Place::kDetails, true},
    {ErrAlike, Place::kDetails, true},
    {NotConverged, Place::kDetails, true},
    {LearnsNoise, Place::kDetails, true},
    {OtherCuts, Place::kDetails, true},
};

}  // namespace

std::span<const RemarkEntry> FurtherRemarks() { return kFurther; }

}  // namespace errmap::report
