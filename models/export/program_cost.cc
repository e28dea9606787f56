#include "models/export/program_cost.h"

namespace errmap::models {
namespace {

void Count(const MapProgram& program,
           const Instruction& it,
           ProgramCost* cost) {
  switch (it.op) {
    case Op::kSet:
    case Op::kCopy:
      ++cost->copies;
      return;
    case Op::kSubtract:
    case Op::kShift:
      ++cost->additions;
      return;
    case Op::kTimes:
      ++cost->multiplications;
      return;
    case Op::kScale:
    case Op::kTimesPlus:
    case Op::kTimesPlusTerm:
    case Op::kLinear:
    case Op::kAccumulate:
      ++cost->additions;
      ++cost->multiplications;
      return;
    case Op::kMeanDecay:
      cost->divisions += 2;
      ++cost->exponentials;
      ++cost->additions;
      return;
    case Op::kGain:
      ++cost->divisions;
      ++cost->multiplications;
      return;
    case Op::kAddProduct:
      ++cost->additions;
      ++cost->multiplications;
      return;
    case Op::kLag:
      cost->additions += 2;
      ++cost->multiplications;
      return;
    case Op::kSine:
    case Op::kCosine:
      ++cost->multiplications;
      ++cost->sines;
      return;
    case Op::kFloor:
    case Op::kCeiling:
      ++cost->comparisons;
      return;
    case Op::kAffine: {
      const std::int64_t products =
          it.count * (program.tables[it.table].cols() - 1);
      cost->additions += products;
      cost->multiplications += products;
      return;
    }
    case Op::kSigmoid:
      cost->additions += it.count;
      cost->divisions += it.count;
      cost->exponentials += it.count;
      return;
  }
}

// Of an expression, `times`.
void CountExpression(const Expression& it,
                     std::int64_t times,
                     ProgramCost* cost) {
  using Kind = Expression::Kind;
  for (const Expression& part : it.parts) CountExpression(part, times, cost);
  switch (it.kind) {
    case Kind::kLess:
    case Kind::kMore:
    case Kind::kAtLeast:
    case Kind::kAtMost:
    case Kind::kEqual:
    case Kind::kAny:
      cost->comparisons += times;
      return;
    case Kind::kPlus:
    case Kind::kMinus:
      cost->additions += times;
      return;
    case Kind::kTimes:
      cost->multiplications += times;
      return;
    case Kind::kNumber:
    case Kind::kCell:
    case Kind::kPlace:
    case Kind::kTrained:
    case Kind::kNot:
    case Kind::kNegative:
    case Kind::kAbsolute:
    case Kind::kAnd:
    case Kind::kOr:
      return;
  }
}

// Both branches of every condition: what a step may cost at most, but for a
// session's first and a new zero.
void CountRoutine(const MapProgram& program,
                  const Routine& routine,
                  ProgramCost* cost,
                  std::int64_t times = 1) {
  for (const Statement& it : routine) {
    for (const Expression& side : it.sides) {
      CountExpression(side, times, cost);
    }
    switch (it.kind) {
      case Statement::Kind::kRun:
        if (it.part == Part::kBegin || it.part == Part::kZero) break;
        for (const Instruction& step : program.part(it.part, it.form)) {
          Count(program, step, cost);
        }
        break;
      case Statement::Kind::kAssign:
        cost->copies += times;
        break;
      case Statement::Kind::kFlag:
        break;
      case Statement::Kind::kIf:
        CountRoutine(program, it.body, cost, times);
        CountRoutine(program, it.otherwise, cost, times);
        break;
      case Statement::Kind::kEach:
        CountRoutine(
            program,
            it.body,
            cost,
            times * (it.count > 0 ? it.count : program.size(Space::kReading)));
        break;
    }
  }
}

}  // namespace

ProgramCost CostOf(const MapProgram& program) {
  ProgramCost cost;
  if (program.read.empty()) {
    for (const Part part : {Part::kAdvance, Part::kEvaluate}) {
      for (const Instruction& it : program.part(part)) {
        Count(program, it, &cost);
      }
    }
  }
  CountRoutine(program, program.read, &cost);
  CountRoutine(program, program.move, &cost);
  std::int64_t kept = program.size(Space::kState);
  for (int i = 0; i < kNumCells; ++i) {
    const CellInfo& cell = InfoOf(static_cast<Cell>(i));
    if (cell.kind != CellKind::kKept || !program.Uses(cell.cell)) continue;
    kept += cell.is_array ? program.size(Space::kReading) : 1;
  }
  cost.state_bytes = static_cast<std::int64_t>(sizeof(double)) * kept;
  return cost;
}

}  // namespace errmap::models
