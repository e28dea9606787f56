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
// A sensor stands still where the others moved by so much of their trained
// ranges, and so many steps passed, since it last changed.
constexpr double kFrozenWhile = 0.5;
constexpr double kFrozenSteps = 5.0;

// What `of_form` says of the map that acts in this direction of motion.
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
  // One that is no number is not within.
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

Routine WatchTheStill() {
  const Expression x{Cell::kReading};
  const Expression common{Cell::kCommon};
  const Expression alike{Cell::kAlike};
  return {Set(Cell::kCommon, 0.0),
          EachReading({Set(Cell::kCommon, common + Read(Cell::kWeight) * x)}),
          EachReading(
              {If(Read(Cell::kWeight) > 0.0,
                  {If(Read(Cell::kBegun) > 0.0 && x == Cell::kLast,
                      {If(alike < kFrozenSteps,
                          {Set(Cell::kAlike, alike + 1.0)},
                          {If(Absolute(common - Cell::kSince) > kFrozenWhile,
                              {Flag(kMapFrozen)})})},
                      {Set(Cell::kLast, x),
                       Set(Cell::kSince, common),
                       Set(Cell::kAlike, 0.0)})})})};
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

// Where the thermal state stands among those of training. The one that was
// close by in the step before is asked first, since heat takes its time.
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

// The time until what filters remember is good again, before a step of them.
Routine Settle(const MapProgram& program) {
  const Expression left{Cell::kSettling};
  const Expression waited{Cell::kWaited};
  Routine settle{Set(Cell::kSettling, left - waited)};
  if (std::isfinite(program.longest_bridged)) {
    settle.push_back(If(waited > program.longest_bridged,
                        {If(!(Read(Cell::kFresh) > 0.0 && left > waited),
                            {Set(Cell::kSettling, waited)})}));
  }
  settle.push_back(
      If(!(left > 0.0), {Set(Cell::kSettling, 0.0), Set(Cell::kFresh, 0.0)}));
  return settle;
}

// What the axis' own motion may change the error by.
Routine MakeRoom(const std::vector<ProgramReading>& readings) {
  Routine room;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (!readings[i].is_position) continue;
    const Expression x{Cell::kReading, static_cast<int>(i)};
    const Expression last{Cell::kLast, static_cast<int>(i)};
    room.push_back(
        Set(Cell::kRoom, Cell::kRoom + readings[i].slope * Absolute(x - last)));
  }
  return room;
}

Routine KeepPositions(const std::vector<ProgramReading>& readings) {
  Routine keep;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (!readings[i].is_position) continue;
    const auto at = static_cast<int>(i);
    keep.push_back(SetAt(Cell::kLast, at, Expression{Cell::kReading, at}));
  }
  return keep;
}

Routine TakeStep(const MapProgram& program) {
  const Expression e{Cell::kError};
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
  Append(OfTheForm(
             program,
             [](int form) -> Routine { return {Do(Part::kEvaluate, form)}; }),
         &take);
  Append(CheckRanges(program, false), &take);
  Routine measure = OfTheForm(program, [&](int form) -> Routine {
    const MapForm& of = program.forms[static_cast<std::size_t>(form)];
    if (of.measure.empty()) return {};
    return MeasureState(of, form);
  });
  // A column that is at fault says more than that the state is unlike.
  if (!measure.empty()) {
    take.push_back(If(!Any(kMapOutside | kMapRelation), std::move(measure)));
  }
  Routine good{Set(Cell::kMissed, 0.0), Set(Cell::kWanted, e)};
  if (Routine room = MakeRoom(program.readings); !room.empty()) {
    good.push_back(If(Read(Cell::kBegun) > 0.0, std::move(room)));
  }
  Append(KeepPositions(program.readings), &good);
  good.push_back(Set(Cell::kBegun, 1.0));
  take.push_back(
      If(e > -kHuge && e < kHuge, std::move(good), {Flag(kMapInvalid)}));
  return take;
}

Statement TidyTime(bool says_so) {
  Routine not_passed{Set(Cell::kDt, 0.0)};
  if (says_so) not_passed.insert(not_passed.begin(), Flag(kMapInvalid));
  return If(!(Read(Cell::kDt) >= 0.0 && Read(Cell::kDt) <= kLongestStep),
            std::move(not_passed));
}

}  // namespace

Routine ReadRoutine(const MapProgram& program) {
  const Expression missed{Cell::kMissed};
  Routine read{TidyTime(true),
               Set(Cell::kWaited, Cell::kWaited + Expression{Cell::kDt}),
               Set(Cell::kMissed, missed + Cell::kDt)};
  if (program.has_directions()) read.push_back(FollowDirection(program));
  Append(CheckReadings(program), &read);
  Routine doubt;
  if (std::ranges::any_of(program.readings, [](const ProgramReading& reading) {
        return reading.weight > 0.0;
      })) {
    doubt = WatchTheStill();
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
  read.push_back(If(!Any(kMapNotTaken), TakeStep(program)));
  read.push_back(If(Any(kMapNotTaken) && missed > program.limits.hold,
                    {Set(Cell::kWanted, 0.0), Flag(kMapFaded)}));
  return read;
}

Routine MoveRoutine() {
  const Expression given{Cell::kGiven};
  const Expression most{Cell::kMostError};
  const Expression room{Cell::kRoom};
  const Expression target{Cell::kTarget};
  return {TidyTime(false),
          Set(Cell::kRoom, room + Cell::kMostRate * Expression{Cell::kDt}),
          Set(Cell::kTarget, Cell::kWanted),
          If(target > most, {Set(Cell::kTarget, most), Flag(kMapLimited)}),
          If(target < -most, {Set(Cell::kTarget, -most), Flag(kMapLimited)}),
          If(target > given + room,
             {Set(Cell::kGiven, given + room), Flag(kMapRamping)},
             {If(target < given - room,
                 {Set(Cell::kGiven, given - room), Flag(kMapRamping)},
                 {Set(Cell::kGiven, target)})}),
          Set(Cell::kRoom, 0.0)};
}

}  // namespace errmap::models
