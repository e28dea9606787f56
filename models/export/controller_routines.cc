#include "models/export/controller_routines.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "models/export/controller.h"

namespace errmap::models {
namespace {

// No control is silent for so long (s).
constexpr double kLongestStep = 1e9;
// A sensor stands still where the others moved by so much of their trained
// ranges, and so many steps passed, since it last changed.
constexpr double kFrozenWhile = 0.5;
constexpr double kFrozenSteps = 5.0;

Routine CheckReadings(const std::vector<ProgramReading>& readings) {
  const Expression x{Cell::kReading};
  Routine checks;
  if (readings.empty()) return checks;
  // A healthy reading is asked least; one that is no number is not within.
  checks.push_back(
      EachReading({If(!(x >= Cell::kLow && x <= Cell::kHigh),
                      {Flag(kMapOutside),
                       If(!(x >= Cell::kFarLow && x <= Cell::kFarHigh),
                          {If(x > -kHuge && x < kHuge,
                              {Flag(kMapFar)},
                              {Flag(kMapInvalid)})})})}));
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
    Statement set = Set(Cell::kLast, Expression{Cell::kReading, at});
    set.sides.front().index = at;
    keep.push_back(std::move(set));
  }
  return keep;
}

Routine TakeStep(const MapProgram& program) {
  const Expression e{Cell::kError};
  Routine take;
  if (!program.advance.empty()) {
    take.push_back(
        If(Read(Cell::kBegun) > 0.0, {Do(Part::kAdvance)}, {Do(Part::kBegin)}));
  } else if (!program.begin.empty()) {
    take.push_back(If(!(Read(Cell::kBegun) > 0.0), {Do(Part::kBegin)}));
  }
  if (!program.zero.empty()) {
    take.push_back(If(Read(Cell::kZeroDue) > 0.0,
                      {Do(Part::kZero), Set(Cell::kZeroDue, 0.0)}));
  }
  take.push_back(Set(Cell::kWaited, 0.0));
  take.push_back(Do(Part::kEvaluate));
  Routine good{Set(Cell::kMissed, 0.0), Set(Cell::kWanted, e)};
  if (Routine room = MakeRoom(program.readings); !room.empty()) {
    good.push_back(If(Read(Cell::kBegun) > 0.0, std::move(room)));
  }
  for (Statement& keep : KeepPositions(program.readings)) {
    good.push_back(std::move(keep));
  }
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
  for (Statement& check : CheckReadings(program.readings)) {
    read.push_back(std::move(check));
  }
  Routine doubt;
  if (std::ranges::any_of(program.readings, [](const ProgramReading& reading) {
        return reading.weight > 0.0;
      })) {
    doubt = WatchTheStill();
  }
  if (!program.judge.empty()) {
    const Expression r{Cell::kDoubt};
    doubt.push_back(Do(Part::kJudge));
    doubt.push_back(EachReading(
        {If(Absolute(r) > Cell::kBelieved, {Flag(kMapContradicts)})}));
  }
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
