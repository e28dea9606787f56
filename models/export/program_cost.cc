#include "models/export/program_cost.h"

#include <cstddef>
#include <cstdint>
#include <iterator>

#include "models/export/language.h"

namespace errmap::models {
namespace {

constexpr ProgramCost kProduct{.additions = 1, .multiplications = 1};

// In the order of Op.
constexpr ProgramCost kCosts[] = {
    {.copies = 1},                                         // kSet
    {.copies = 1},                                         // kCopy
    {.additions = 1},                                      // kSubtract
    {.additions = 1},                                      // kShift
    kProduct,                                              // kScale
    {.multiplications = 1},                                // kTimes
    kProduct,                                              // kTimesPlus
    kProduct,                                              // kTimesPlusTerm
    kProduct,                                              // kLinear
    kProduct,                                              // kAccumulate
    {.additions = 1, .divisions = 2, .exponentials = 1},   // kMeanDecay
    {.multiplications = 1, .divisions = 1},                // kGain
    {.additions = 2, .multiplications = 1},                // kLag
    kProduct,                                              // kAddProduct
    {.multiplications = 1, .sines = 1},                    // kSine
    {.multiplications = 1, .sines = 1},                    // kCosine
    {.comparisons = 1},                                    // kFloor
    {.comparisons = 1},                                    // kCeiling
    kProduct,                                              // kAffine, each
    {.additions = 1, .divisions = 1, .exponentials = 1}};  // kSigmoid, each
static_assert(std::size(kCosts) == static_cast<int>(Op::kSigmoid) + 1);

void Count(const MapProgram& program,
           const Instruction& it,
           ProgramCost* cost) {
  const ProgramCost& one = kCosts[static_cast<std::size_t>(it.op)];
  std::int64_t times = it.op == Op::kSigmoid ? it.count : 1;
  if (it.op == Op::kAffine) {
    times = it.count * (program.tables[it.table].cols() - 1);
  }
  cost->additions += times * one.additions;
  cost->multiplications += times * one.multiplications;
  cost->divisions += times * one.divisions;
  cost->exponentials += times * one.exponentials;
  cost->sines += times * one.sines;
  cost->comparisons += times * one.comparisons;
  cost->copies += times * one.copies;
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
    default:
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
  if (program.read.empty()) {  // the map alone, without its controller
    for (const Part part : {Part::kAdvance, Part::kEvaluate}) {
      for (const Instruction& it : program.part(part)) {
        Count(program, it, &cost);
      }
    }
  }
  CountRoutine(program, program.read, &cost);
  CountRoutine(program, program.move, &cost);
  constexpr int kBesideState = 2;  // the map's identity and the sum
  cost.state_bytes = static_cast<std::int64_t>(sizeof(double)) *
                     (NumSaved(program) - kBesideState);
  return cost;
}

}  // namespace errmap::models
