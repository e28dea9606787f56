#include "models/export/program/controller_routines.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "models/export/program/controller.h"
#include "models/export/program/error_curve.h"

namespace errmap::models {
namespace {

// No control is silent for so long (s).
constexpr double kLongestStep = 1e9;
// No sensor hangs that held its value for fewer steps, nor by its noise alone.
constexpr double kFrozenSteps = 5.0;
constexpr double kQuietSteps = 10.0;

// Applies `of_form` to the map that acts in this direction of motion.
template <typename OfForm>
Routine OfTheForm(const MapProgram& program, const OfForm& of_form) {
  Routine first = of_form(0);
  if (!program.has_directions()) return first;
  Routine second = of_form(1);
  const Expression is_down = Read(Cell::kDown) > 0.0;
  if (first.empty() && second.empty()) return {};
  if (second.empty()) return {If(!is_down, std::move(first))};
  return {If(is_down, std::move(second), std::move(first))};
}

void Append(Routine more, Routine* routine) {
  for (Statement& statement : more) routine->push_back(std::move(statement));
}

// Of readings, or of what is derived from them.
Routine CheckRanges(const MapProgram& program, bool are_readings) {
  return OfTheForm(program, [&](int form) {
    Routine ranges;
    for (const TrainedRange& range :
         program.forms[static_cast<std::size_t>(form)].ranges) {
      if ((range.place.space == Space::kReading) != are_readings) continue;
      const Expression number{range.place};
      ranges.push_back(If(!(number >= range.low && number <= range.high),
                          {Flag(kMapOutside)}));
    }
    return ranges;
  });
}

Routine CheckReadings(const MapProgram& program) {
  const std::vector<ProgramReading>& readings = program.readings;
  const Expression x{Cell::kReading};
  if (readings.empty()) return {};
  Routine checks = CheckRanges(program, true);
  // A value that is not a number is not within.
  Statement far = EachReading({If(
      !(x >= Cell::kFarLow && x <= Cell::kFarHigh),
      {If(x > -kHuge && x < kHuge, {Flag(kMapFar)}, {Flag(kMapInvalid)})})});
  // A healthy reading is asked least; two maps may read different ones.
  checks.push_back(program.has_directions()
                       ? std::move(far)
                       : If(Any(kMapOutside), {std::move(far)}));
  for (std::size_t i = 0; i < readings.size(); ++i) {
    for (const double value : readings[i].dead) {
      checks.push_back(
          If(Expression{Cell::kReading, static_cast<int>(i)} == value,
             {Flag(kMapDead)}));
    }
  }
  return checks;
}

// The last step may have been long ago, but not while a reading is refused.
Statement SpanOfChange() {
  return If(Read(Cell::kLeapt) > 0.0,
            {Set(Cell::kSpan, Cell::kDt)},
            {Set(Cell::kSpan, Cell::kWaited)});
}

// What is kept of one that changed, or is new.
Routine WatchAnew(int at, bool has_others) {
  Routine anew{SetAt(Cell::kHeld, at, 0.0)};
  if (has_others) {
    anew.push_back(SetAt(Cell::kSince, at, Cell::kCommon));
    anew.push_back(SetAt(Cell::kAlike, at, 0.0));
  }
  return anew;
}

// It holds its value.
Routine WatchHeld(int at, bool has_others) {
  const Expression alike{Cell::kAlike, at};
  const Expression held{Cell::kHeld, at};
  Routine watch{SetAt(Cell::kHeld, at, held + Cell::kDt)};
  if (!has_others) return watch;
  const Expression moved =
      Absolute(Read(Cell::kCommon) - Expression{Cell::kSince, at});
  watch.push_back(
      If(alike < kQuietSteps, {SetAt(Cell::kAlike, at, alike + 1.0)}));
  watch.push_back(
      If((alike > kFrozenSteps && moved > Expression{Cell::kOthersMove, at}) ||
             (alike >= kQuietSteps && held > Expression{Cell::kQuiet, at} &&
              moved > Expression{Cell::kFinest, at}),
         {Flag(kMapFrozen)}));
  return watch;
}

// It has another value than in the step before.
Routine WatchChanged(int at, bool has_others, bool jumps, bool has_silence) {
  Routine changed;
  if (jumps) {
    const Expression allowed = Expression{Cell::kJump, at} +
                               Expression{Cell::kFastest, at} *
                                   (Expression{Cell::kHeld, at} + Cell::kSpan);
    changed.push_back(If(Absolute(Expression{Cell::kReading, at} -
                                  Expression{Cell::kLast, at}) > allowed,
                         {Flag(kMapJumped)}));
  }
  Append(WatchAnew(at, has_others), &changed);
  if (has_silence) changed.push_back(Set(Cell::kStood, 0.0));
  return changed;
}

// Applies `of_one` to the index of each watched reading. A few are written one
// by one, since a loop takes longer than its body.
template <typename OfOne>
Routine OfTheWatched(const MapProgram& program, const OfOne& of_one) {
  constexpr int kFew = 4;
  std::vector<int> watched;
  for (std::size_t i = 0; i < program.readings.size(); ++i) {
    if (program.readings[i].weight > 0.0)
      watched.push_back(static_cast<int>(i));
  }
  if (std::ssize(watched) > kFew) {
    return {EachReading(
        {If(Read(Cell::kWeight) > 0.0, of_one(Expression::kLoop))})};
  }
  Routine all;
  for (const int at : watched) Append(of_one(at), &all);
  return all;
}

// Of the watched readings, which hang or jump, in a session that has begun.
Routine WatchTheStill(const MapProgram& program) {
  const auto& readings = program.readings;
  const bool jumps = std::ranges::any_of(
      readings, [](const auto& reading) { return reading.jump < kHuge; });
  const bool has_others = std::ranges::count_if(readings, [](const auto& it) {
                            return it.weight > 0.0;
                          }) > 1;
  const double silence = program.limits.silence;
  const Expression stood{Cell::kStood};

  Routine watch;
  if (jumps) watch.push_back(SpanOfChange());
  if (silence > 0.0) {
    const double most = silence / kFrozenSteps;
    watch.push_back(If(Read(Cell::kDt) < most,
                       {Set(Cell::kStood, stood + Cell::kDt)},
                       {Set(Cell::kStood, stood + most)}));
  }
  Append(OfTheWatched(
             program,
             [&](int at) -> Routine {
               const Expression x{Cell::kReading, at};
               return {If(x == Expression{Cell::kLast, at},
                          WatchHeld(at, has_others),
                          WatchChanged(at, has_others, jumps, silence > 0.0))};
             }),
         &watch);
  if (silence > 0.0) {
    watch.push_back(If(stood > silence, {Flag(kMapFrozen)}));
  }
  if (jumps) {
    watch.push_back(If(
        Any(kMapJumped), {Set(Cell::kLeapt, 1.0)}, {Set(Cell::kLeapt, 0.0)}));
  }
  Routine first =
      OfTheWatched(program, [&](int at) { return WatchAnew(at, has_others); });
  if (silence > 0.0) first.push_back(Set(Cell::kStood, 0.0));

  Routine all;
  if (has_others) {
    all.push_back(Set(Cell::kCommon, 0.0));
    Append(OfTheWatched(program,
                        [](int at) -> Routine {
                          const Expression x{Cell::kReading, at};
                          return {Set(Cell::kCommon,
                                      Cell::kCommon +
                                          Expression{Cell::kWeight, at} * x)};
                        }),
           &all);
  }
  all.push_back(
      If(Read(Cell::kBegun) > 0.0, std::move(watch), std::move(first)));
  return all;
}

// Which of two maps acts: the position has gone one way, but for a little.
Statement FollowDirection(const MapProgram& program) {
  const Expression x{Cell::kReading, PositionOf(program)};
  const Expression turn{Cell::kTurn};
  const double band = program.limits.band;
  const auto turn_to = [&](double down) -> Routine {
    return {
        Set(Cell::kDown, down),
        Set(Cell::kTurn, x),
        Set(Cell::kRoom, Cell::kRoom + Expression{program.limits.reversal})};
  };
  return If(Read(Cell::kBegun) > 0.0,
            {If(Read(Cell::kDown) > 0.0,
                {If(x < turn, {Set(Cell::kTurn, x)}),
                 If(x > turn + band, turn_to(0.0))},
                {If(x > turn, {Set(Cell::kTurn, x)}),
                 If(x < turn - band, turn_to(1.0))})},
            {Set(Cell::kTurn, x)});
}

// kAway = the squared distance of the thermal state from a point.
template <typename Coordinate>
Routine MeasureFrom(const MapForm& of, const Coordinate& coordinate) {
  Routine measure;
  for (int k = 0; k < static_cast<int>(of.states.cols()); ++k) {
    const Expression along =
        Expression{Operand{Space::kScore, k}} - coordinate(k);
    const Expression square = along * along;
    measure.push_back(Set(Cell::kAway, k == 0 ? square : Cell::kAway + square));
  }
  return measure;
}

// The position of the thermal state among the trained ones. The one that was
// near in the previous step is tried first, since heat moves slowly.
Routine MeasureState(const MapForm& of, int form) {
  const Expression known{Cell::kKnown};
  const Expression away{Cell::kAway};
  Routine take{Set(Cell::kKnown, form + 1.0)};
  for (int k = 0; k < static_cast<int>(of.states.cols()); ++k) {
    take.push_back(SetAt(Cell::kNear, k, Trained(form, k)));
  }
  Routine seek = MeasureFrom(of, [form](int k) { return Trained(form, k); });
  seek.push_back(If(away <= of.reach, std::move(take)));

  Routine measure{Do(Part::kMeasure, form)};
  Append(MeasureFrom(of, [](int) { return Expression{0.0}; }), &measure);
  measure.push_back(If(away > of.most_spread, {Flag(kMapLeverage)}));
  Append(MeasureFrom(of,
                     [](int k) {
                       return Expression{Cell::kNear, k};
                     }),
         &measure);
  measure.push_back(If(!(known == form + 1.0 && away <= of.reach),
                       {Set(Cell::kKnown, 0.0),
                        Each(static_cast<int>(of.states.rows()),
                             {If(!(known > 0.0), std::move(seek))}),
                        If(!(known > 0.0), {Flag(kMapDistance)})}));
  return measure;
}

// The time until what filters remember is good again, before a step of them. It
// passes in whole seconds: of hours in single precision no part of a
// millisecond can be taken.
Routine Settle(const MapProgram& program) {
  const Expression left{Cell::kSettling};
  const Expression waited{Cell::kWaited};
  const Expression pending{Cell::kPending};
  Routine settle{
      Set(Cell::kPending, pending + waited),
      If(pending >= 1.0,
         {Set(Cell::kSettling, left - pending), Set(Cell::kPending, 0.0)})};
  if (std::isfinite(program.longest_bridged)) {
    settle.push_back(
        If(waited > program.longest_bridged,
           {If(!(Read(Cell::kFresh) > 0.0 && left - pending > waited),
               {Set(Cell::kSettling, waited), Set(Cell::kPending, 0.0)})}));
  }
  settle.push_back(If(!(left > pending),
                      {Set(Cell::kSettling, 0.0),
                       Set(Cell::kPending, 0.0),
                       Set(Cell::kFresh, 0.0)}));
  return settle;
}

// The position of the axis, or the end of its range if it is beyond. The axis'
// motion lets the error change by more.
Routine FollowPositions(const std::vector<ProgramReading>& readings) {
  Routine follow;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const ProgramReading& reading = readings[i];
    if (!reading.is_position) continue;
    const auto at = static_cast<int>(i);
    const Expression x{Cell::kReading, at};
    const Expression last{Cell::kLast, at};
    Routine known;
    if (reading.far_high < kHuge) {
      known = {If(x < reading.trained_min,
                  {SetAt(Cell::kReading, at, reading.trained_min)}),
               If(x > reading.trained_max,
                  {SetAt(Cell::kReading, at, reading.trained_max)})};
    }
    if (reading.slope > 0.0) {
      known.push_back(
          If(Read(Cell::kBegun) > 0.0,
             {Set(Cell::kRoom,
                  Cell::kRoom + reading.slope * Absolute(x - last))}));
    }
    known.push_back(SetAt(Cell::kLast, at, x));
    follow.push_back(
        If(x >= reading.far_low && x <= reading.far_high, std::move(known)));
  }
  return follow;
}

// Filters and zeros go on, and the readings are those that are held should the
// next ones fail.
Routine Advance(const MapProgram& program) {
  Routine take;
  const bool remembers = program.settles_after > 0.0;
  if (remembers || !program.advance.empty()) {
    Routine go_on;
    if (remembers) go_on = Settle(program);
    if (!program.advance.empty()) go_on.push_back(Do(Part::kAdvance));
    take.push_back(
        If(Read(Cell::kBegun) > 0.0, std::move(go_on), {Do(Part::kBegin)}));
    if (remembers) {
      take.push_back(If(Read(Cell::kSettling) > 0.0,
                        {If(Read(Cell::kFresh) > 0.0,
                            {Flag(kMapSettling)},
                            {Flag(kMapGap)})}));
    }
  } else if (!program.begin.empty()) {
    take.push_back(If(!(Read(Cell::kBegun) > 0.0), {Do(Part::kBegin)}));
  }
  if (!program.zero.empty()) {
    take.push_back(If(Read(Cell::kZeroDue) > 0.0,
                      {Do(Part::kZero), Set(Cell::kZeroDue, 0.0)}));
  }
  take.push_back(Set(Cell::kWaited, 0.0));
  return take;
}

// What is said of a step that is taken.
Routine JudgeStep(const MapProgram& program) {
  Routine taken = CheckRanges(program, false);
  Routine measure = OfTheForm(program, [&](int form) -> Routine {
    const MapForm& of = program.forms[static_cast<std::size_t>(form)];
    if (of.measure.empty()) return {};
    return MeasureState(of, form);
  });
  // A column that is at fault says more than that the state is unlike.
  if (!measure.empty()) {
    taken.push_back(If(!Any(kMapOutside | kMapRelation), std::move(measure)));
  }
  taken.push_back(Set(Cell::kMissed, 0.0));
  taken.push_back(Set(Cell::kBegun, 1.0));
  if (!program.readings.empty()) {
    taken.push_back(EachReading({Set(Cell::kLast, Cell::kReading)}));
  }
  return taken;
}

// The error of these readings, or of those that are held.
Statement TakeStep(const MapProgram& program) {
  const Expression e{Cell::kError};
  const Expression is_taken = !Any(kMapNotTaken);
  Routine held;
  if (!program.readings.empty()) {
    held.push_back(EachReading({Set(Cell::kReading, Cell::kLast)}));
  }
  Routine take{If(is_taken, Advance(program), std::move(held))};
  Append(OfTheForm(
             program,
             [](int form) -> Routine { return {Do(Part::kEvaluate, form)}; }),
         &take);
  take.push_back(If(e > -kHuge && e < kHuge,
                    {Set(Cell::kWanted, e), If(is_taken, JudgeStep(program))},
                    {Flag(kMapInvalid)}));
  return If(is_taken || Read(Cell::kBegun) > 0.0, std::move(take));
}

Statement TidyTime(bool says_so) {
  Routine not_passed{Set(Cell::kDt, 0.0)};
  if (says_so) not_passed.insert(not_passed.begin(), Flag(kMapInvalid));
  return If(!(Read(Cell::kDt) >= 0.0 && Read(Cell::kDt) <= kLongestStep),
            std::move(not_passed));
}

// `to` is the value set if `is_one` holds; else the map's own.
Routine UseLimit(Cell to, Cell set, double own, Expression is_one) {
  // A map without an error has nothing to set, but the parameter.
  if (!(own > 0.0))
    return {Set(to, set), If(!(Read(to) == 0.0), {Set(to, 0.0)})};
  return {Set(to, set),
          If(!std::move(is_one),
             {Set(to, own), Flag(kMapParameter), Flag(kMapUnhealthy)})};
}

}  // namespace

Routine ReadRoutine(const MapProgram& program) {
  const Expression missed{Cell::kMissed};
  Routine read{TidyTime(true),
               Set(Cell::kWaited, Cell::kWaited + Expression{Cell::kDt}),
               Set(Cell::kMissed, missed + Cell::kDt)};
  if (program.has_directions()) read.push_back(FollowDirection(program));
  Append(CheckReadings(program), &read);
  Append(FollowPositions(program.readings), &read);
  Routine doubt;
  if (std::ranges::any_of(program.readings, [](const ProgramReading& reading) {
        return reading.weight > 0.0;
      })) {
    doubt = WatchTheStill(program);
  }
  const Expression r = Absolute(Cell::kDoubt);
  Append(
      OfTheForm(
          program,
          [&](int form) -> Routine {
            if (program.part(Part::kJudge, form).empty()) return {};
            Routine judge{Do(Part::kJudge, form)};
            if (program.forms[static_cast<std::size_t>(form)].has_relations) {
              judge.push_back(EachReading(
                  {If(r > 1.0,
                      {Flag(kMapRelation),
                       If(r > Cell::kBelieved, {Flag(kMapContradicts)})})}));
            }
            return judge;
          }),
      &doubt);
  if (!doubt.empty()) read.push_back(If(!Any(kMapNotTaken), std::move(doubt)));
  read.push_back(TakeStep(program));
  read.push_back(If(Any(kMapNotTaken) && missed > program.limits.hold,
                    {Set(Cell::kWanted, 0.0), Flag(kMapFaded)}));
  read.push_back(
      If(Any(kMapAlarms) || (Any(kMapRelation) && Any(kMapBesideRelation)),
         {Flag(kMapUnhealthy)}));
  return read;
}

Routine MoveRoutine(const ControllerLimits& limits) {
  const Expression given{Cell::kGiven};
  const Expression limit{Cell::kBound};
  const Expression room{Cell::kRoom};
  const Expression target{Cell::kTarget};
  Routine move{TidyTime(false)};
  const double own = limits.max_error;
  const Expression bound{Cell::kMostError};
  Append(UseLimit(Cell::kBound,
                  Cell::kMostError,
                  own,
                  bound > 0.0 && bound <= kMostTimesOwn * own),
         &move);
  // Any rate will do: the limit has the last word.
  Append(UseLimit(Cell::kPace,
                  Cell::kMostRate,
                  limits.max_rate,
                  Read(Cell::kMostRate) > 0.0),
         &move);
  Append({Set(Cell::kRoom, room + Cell::kPace * Expression{Cell::kDt}),
          Set(Cell::kTarget, Cell::kWanted),
          If(target > limit, {Set(Cell::kTarget, limit), Flag(kMapLimited)}),
          If(target < -limit, {Set(Cell::kTarget, -limit), Flag(kMapLimited)}),
          If(target > given + room,
             {Set(Cell::kGiven, given + room), Flag(kMapRamping)},
             {If(target < given - room,
                 {Set(Cell::kGiven, given - room), Flag(kMapRamping)},
                 {Set(Cell::kGiven, target)})}),
          Set(Cell::kRoom, 0.0),
          // The last check, in any case: the limit may have been lowered, or
          // the value may not be a number.
          If(!(given >= -limit && given <= limit),
             {Flag(kMapLimited),
              If(given > limit,
                 {Set(Cell::kGiven, limit)},
                 {If(given < -limit,
                     {Set(Cell::kGiven, -limit)},
                     {Set(Cell::kGiven, 0.0)})})})},
         &move);
  return move;
}

}  // namespace errmap::models
