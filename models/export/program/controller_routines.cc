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

// True if it is asked only beyond the end of its travel whether it is outside.
bool IsAskedAtEnd(const MapProgram& program, const Operand& place) {
  if (place.space != Space::kReading || program.has_directions()) return false;
  const auto& reading = program.readings[static_cast<std::size_t>(place.index)];
  return reading.is_position && reading.far_high < kHuge;
}

// Of the places that `is_one` holds for.
template <typename IsOne>
Routine CheckRanges(const MapProgram& program, const IsOne& is_one) {
  return OfTheForm(program, [&](int form) {
    Routine ranges;
    for (const TrainedRange& range :
         program.forms[static_cast<std::size_t>(form)].ranges) {
      if (!is_one(range.place)) continue;
      const Expression number{range.place};
      ranges.push_back(If(!(number >= range.low && number <= range.high),
                          {Flag(kMapOutside)}));
    }
    return ranges;
  });
}

// A value that is not a number is not within.
Statement CheckFar(int at) {
  const Expression x{Cell::kReading, at};
  return If(
      !(x >= Expression{Cell::kFarLow, at} &&
        x <= Expression{Cell::kFarHigh, at}),
      {If(x > -kHuge && x < kHuge, {Flag(kMapFar)}, {Flag(kMapInvalid)})});
}

Routine CheckReadings(const MapProgram& program) {
  const std::vector<ProgramReading>& readings = program.readings;
  if (readings.empty()) return {};
  Routine checks = CheckRanges(program, [&](const Operand& place) {
    return place.space == Space::kReading && !IsAskedAtEnd(program, place);
  });
  Statement far = EachReading({CheckFar(Expression::kLoop)});
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

bool Jumps(const MapProgram& program) {
  return std::ranges::any_of(program.readings, [](const auto& reading) {
    return reading.jump < kHuge;
  });
}

// How the others move is told from where it changed, or is new.
Routine WatchOthersFrom(int at, bool has_others) {
  if (!has_others) return {};
  return {SetAt(Cell::kSince, at, Cell::kCommon), SetAt(Cell::kAlike, at, 0.0)};
}

// It holds its value.
Routine WatchHeld(int at, bool has_others) {
  const Expression alike{Cell::kAlike, at};
  Routine watch{
      SetAt(Cell::kHeld, at, Expression{Cell::kHeld, at} + Cell::kDt)};
  if (has_others) {
    watch.push_back(
        If(alike < kQuietSteps, {SetAt(Cell::kAlike, at, alike + 1.0)}));
  }
  return watch;
}

// It held its value for some steps, in which the others moved.
Statement CheckHeld(int at) {
  const Expression alike{Cell::kAlike, at};
  const Expression moved =
      Absolute(Read(Cell::kCommon) - Expression{Cell::kSince, at});
  return If(
      alike > kFrozenSteps,
      {If(moved > Expression{Cell::kOthersMove, at} ||
              (alike >= kQuietSteps &&
               Expression{Cell::kHeld, at} > Expression{Cell::kQuiet, at} &&
               moved > Expression{Cell::kFinest, at}),
          {Flag(kMapFrozen)})});
}

// It has another value than in the step before. What it may change by grows
// with the time since the last step taken, but not while one is refused for a
// leap.
Routine WatchChanged(int at, bool has_others, bool jumps) {
  Routine changed;
  if (jumps) {
    const Expression jump{Cell::kJump, at};
    const Expression change =
        Absolute(Expression{Cell::kReading, at} - Expression{Cell::kLast, at});
    const Expression span =
        Expression{Cell::kHeld, at} + Cell::kWaited - Cell::kLeapt;
    changed.push_back(
        If(change > jump,
           {If(change > jump + Expression{Cell::kFastest, at} * span,
               {Flag(kMapJumped), Set(Cell::kLeapt, Cell::kWaited)})}));
  }
  changed.push_back(SetAt(Cell::kHeld, at, 0.0));
  Append(WatchOthersFrom(at, has_others), &changed);
  return changed;
}

// Applies `of_one` to the index of each watched reading.
template <typename OfOne>
Routine OfTheWatched(const MapProgram& program, const OfOne& of_one) {
  std::vector<int> watched;
  for (std::size_t i = 0; i < program.readings.size(); ++i) {
    if (program.readings[i].weight > 0.0)
      watched.push_back(static_cast<int>(i));
  }
  if (std::ssize(watched) > kFewSensors) {
    return {EachReading(
        {If(Read(Cell::kWeight) > 0.0, of_one(Expression::kLoop))})};
  }
  Routine all;
  for (const int at : watched) Append(of_one(at), &all);
  return all;
}

// No watched reading changed. A pause says little: it counts as a part of the
// time that is too long.
Routine WatchSilence(double silence) {
  const double most = silence / kFrozenSteps;
  const Expression stood{Cell::kStood};
  return {If(Read(Cell::kDt) < most,
             {Set(Cell::kStood, stood + Cell::kDt)},
             {Set(Cell::kStood, stood + most)}),
          If(stood > silence, {Flag(kMapFrozen)})};
}

Routine CheckDoubts(const MapForm& form) {
  const auto check = [](int at) {
    const Expression r = Absolute(Expression{Cell::kDoubt, at});
    return If(
        r > 1.0,
        {Flag(kMapRelation),
         If(r > Expression{Cell::kBelieved, at}, {Flag(kMapContradicts)})});
  };
  Routine checks;
  for (const Instruction& it : form.judge) {
    if (it.a.space == Space::kReading) checks.push_back(check(it.a.index));
  }
  if (std::ssize(checks) <= kFewSensors) return checks;
  return {EachReading({check(Expression::kLoop)})};
}

// Of the watched readings, which hang or jump, in a session that has begun.
Routine WatchTheStill(const MapProgram& program) {
  const auto& readings = program.readings;
  const bool jumps = Jumps(program);
  const bool has_others = std::ranges::count_if(readings, [](const auto& it) {
                            return it.weight > 0.0;
                          }) > 1;
  const bool has_silence = program.limits.silence > 0.0;

  const bool asks_for_change = has_others || has_silence;

  Routine watch;
  if (asks_for_change) watch.push_back(Set(Cell::kChanged, 0.0));
  Append(OfTheWatched(program,
                      [&](int at) -> Routine {
                        const Expression x{Cell::kReading, at};
                        Routine changed = WatchChanged(at, has_others, jumps);
                        if (asks_for_change) {
                          changed.push_back(Set(Cell::kChanged, 1.0));
                        }
                        return {If(x == Expression{Cell::kLast, at},
                                   WatchHeld(at, has_others),
                                   std::move(changed))};
                      }),
         &watch);
  Routine moves;
  if (has_others) {
    moves = OfTheWatched(program,
                         [](int at) -> Routine { return {CheckHeld(at)}; });
  }
  Routine silent;
  if (has_silence) {
    moves.push_back(Set(Cell::kStood, 0.0));
    silent = WatchSilence(program.limits.silence);
  }
  if (asks_for_change) {
    watch.push_back(
        If(Read(Cell::kChanged) > 0.0, std::move(moves), std::move(silent)));
  }
  Routine first = OfTheWatched(program, [&](int at) {
    Routine anew{SetAt(Cell::kHeld, at, 0.0)};
    Append(WatchOthersFrom(at, has_others), &anew);
    return anew;
  });
  if (has_silence) first.push_back(Set(Cell::kStood, 0.0));

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
Routine FollowPositions(const MapProgram& program) {
  const std::vector<ProgramReading>& readings = program.readings;
  Routine follow;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const ProgramReading& reading = readings[i];
    if (!reading.is_position) continue;
    const auto at = static_cast<int>(i);
    const Expression x{Cell::kReading, at};
    const Expression last{Cell::kLast, at};
    const double low =
        reading.far_high < kHuge ? reading.trained_min : reading.far_low;
    const double high =
        reading.far_high < kHuge ? reading.trained_max : reading.far_high;
    const auto stop_at = [&](double end) {
      return SetAt(Cell::kReading, at, end);
    };
    Routine beyond;
    if (const Operand place{Space::kReading, at};
        IsAskedAtEnd(program, place)) {
      beyond = CheckRanges(
          program, [&](const Operand& other) { return other == place; });
      beyond.push_back(CheckFar(at));
    }
    // One that is refused stays where it was.
    beyond.push_back(If(x >= reading.far_low && x < low,
                        {stop_at(low)},
                        {If(x > high && x <= reading.far_high,
                            {stop_at(high)},
                            {SetAt(Cell::kReading, at, last)})}));
    follow.push_back(If(!(x >= low && x <= high), std::move(beyond)));
    if (reading.slope > 0.0) {
      follow.push_back(
          If(Read(Cell::kBegun) > 0.0,
             {Set(Cell::kRoom,
                  Cell::kRoom + reading.slope * Absolute(x - last))}));
    }
    follow.push_back(SetAt(Cell::kLast, at, x));
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
  if (Jumps(program)) take.push_back(Set(Cell::kLeapt, 0.0));
  return take;
}

// What is said of a step that is taken.
Routine JudgeStep(const MapProgram& program) {
  Routine taken = CheckRanges(program, [](const Operand& place) {
    return place.space != Space::kReading;
  });
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
  take.push_back(If(Absolute(e) < kHuge,
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
  return {Set(to, own),
          If(!(Read(set) == own),
             {If(std::move(is_one),
                 {Set(to, set)},
                 {Flag(kMapParameter), Flag(kMapUnhealthy)})})};
}

}  // namespace

Routine ReadRoutine(const MapProgram& program) {
  const Expression missed{Cell::kMissed};
  Routine read{TidyTime(true),
               Set(Cell::kWaited, Cell::kWaited + Expression{Cell::kDt})};
  if (program.has_directions()) read.push_back(FollowDirection(program));
  Append(CheckReadings(program), &read);
  Append(FollowPositions(program), &read);
  Routine doubt;
  if (std::ranges::any_of(program.readings, [](const ProgramReading& reading) {
        return reading.weight > 0.0;
      })) {
    doubt = WatchTheStill(program);
  }
  Append(
      OfTheForm(
          program,
          [&](int form) -> Routine {
            if (program.part(Part::kJudge, form).empty()) return {};
            Routine judge{Do(Part::kJudge, form)};
            if (program.forms[static_cast<std::size_t>(form)].has_relations) {
              Append(CheckDoubts(program.forms[static_cast<std::size_t>(form)]),
                     &judge);
            }
            return judge;
          }),
      &doubt);
  if (!doubt.empty()) read.push_back(If(!Any(kMapNotTaken), std::move(doubt)));
  read.push_back(TakeStep(program));
  read.push_back(If(Any(kMapNotTaken),
                    {Set(Cell::kMissed, missed + Cell::kDt),
                     If(missed > program.limits.hold,
                        {Set(Cell::kWanted, 0.0), Flag(kMapFaded)})}));
  Expression is_alarm = Any(kMapAlarms);
  if (std::ranges::any_of(program.forms, &MapForm::has_relations)) {
    is_alarm = is_alarm || (Any(kMapRelation) && Any(kMapBesideRelation));
  }
  read.push_back(If(std::move(is_alarm), {Flag(kMapUnhealthy)}));
  return read;
}

Routine MoveRoutine(const ControllerLimits& limits) {
  const Expression given{Cell::kGiven};
  const Expression limit{Cell::kBound};
  const Expression room{Cell::kRoom};
  const Expression target{Cell::kTarget};
  // What is not a number is 0.
  const auto to_limit = [&](Cell cell) {
    return If(Read(cell) > limit,
              {Set(cell, limit)},
              {If(Read(cell) < -limit, {Set(cell, -limit)}, {Set(cell, 0.0)})});
  };
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
          If(Absolute(target) > limit,
             {to_limit(Cell::kTarget), Flag(kMapLimited)}),
          If(Absolute(target - given) > room,
             {If(target > given,
                 {Set(Cell::kGiven, given + room)},
                 {Set(Cell::kGiven, given - room)}),
              Flag(kMapRamping)},
             {Set(Cell::kGiven, target)}),
          Set(Cell::kRoom, 0.0),
          // The last check, in any case: the limit may have been lowered, or
          // the value may not be a number.
          If(!(Absolute(given) <= limit),
             {to_limit(Cell::kGiven), Flag(kMapLimited)})},
         &move);
  return move;
}

}  // namespace errmap::models
