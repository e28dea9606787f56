#include "models/export/program/routine.h"

#include <algorithm>
#include <array>

namespace errmap::models {
namespace {

constexpr std::array<CellInfo, kNumCells> kCells{{
    {Cell::kDt, "passed", CellKind::kLocal, false},
    {Cell::kCommon, "common", CellKind::kLocal, false},
    {Cell::kAway, "away", CellKind::kLocal, false},
    {Cell::kTarget, "target", CellKind::kLocal, false},
    {Cell::kBound, "bound", CellKind::kLocal, false},
    {Cell::kPace, "pace", CellKind::kLocal, false},
    {Cell::kChanged, "changed", CellKind::kLocal, false},
    {Cell::kReading, "x", CellKind::kLocal, true},
    {Cell::kDoubt, "r", CellKind::kLocal, true},
    {Cell::kError, "e", CellKind::kLocal, false},
    {Cell::kBegun, "begun", CellKind::kKept, false},
    {Cell::kZeroDue, "zero_due", CellKind::kKept, false},
    {Cell::kWaited, "waited", CellKind::kKept, false},
    {Cell::kMissed, "missed", CellKind::kKept, false},
    {Cell::kWanted, "wanted", CellKind::kKept, false},
    {Cell::kGiven, "given", CellKind::kKept, false},
    {Cell::kRoom, "room", CellKind::kKept, false},
    {Cell::kMostError, "max_error", CellKind::kKept, false},
    {Cell::kMostRate, "max_rate", CellKind::kKept, false},
    {Cell::kFresh, "fresh", CellKind::kKept, false},
    {Cell::kSettling, "settles_in", CellKind::kKept, false},
    {Cell::kPending, "pending", CellKind::kKept, false},
    {Cell::kStood, "stood", CellKind::kKept, false},
    {Cell::kLeapt, "leapt", CellKind::kKept, false},
    {Cell::kKnown, "known", CellKind::kKept, false},
    {Cell::kDown, "down", CellKind::kKept, false},
    {Cell::kTurn, "turn", CellKind::kKept, false},
    {Cell::kLast, "last", CellKind::kKept, true},
    {Cell::kSince, "since", CellKind::kKept, true},
    {Cell::kAlike, "alike", CellKind::kKept, true},
    {Cell::kHeld, "held", CellKind::kKept, true},
    {Cell::kNear, "near", CellKind::kKept, true},
    {Cell::kFarLow, "far_low", CellKind::kTable, true},
    {Cell::kFarHigh, "far_high", CellKind::kTable, true},
    {Cell::kWeight, "weight", CellKind::kTable, true},
    {Cell::kOthersMove, "others_move", CellKind::kTable, true},
    {Cell::kFinest, "finest", CellKind::kTable, true},
    {Cell::kQuiet, "quiet", CellKind::kTable, true},
    {Cell::kJump, "jump", CellKind::kTable, true},
    {Cell::kFastest, "fastest", CellKind::kTable, true},
    {Cell::kBelieved, "believed", CellKind::kTable, true},
}};

bool Mentions(const Expression& expression, Cell cell) {
  return (expression.kind == Expression::Kind::kCell &&
          expression.cell == cell) ||
         std::ranges::any_of(expression.parts, [cell](const Expression& part) {
           return Mentions(part, cell);
         });
}

}  // namespace

const CellInfo& InfoOf(Cell cell) {
  return *std::ranges::find(kCells, cell, &CellInfo::cell);
}

bool Uses(const Routine& routine, Cell cell) {
  return std::ranges::any_of(routine, [cell](const Statement& statement) {
    return std::ranges::any_of(
               statement.sides,
               [cell](const Expression& e) { return Mentions(e, cell); }) ||
           Uses(statement.body, cell) || Uses(statement.otherwise, cell);
  });
}

}  // namespace errmap::models
