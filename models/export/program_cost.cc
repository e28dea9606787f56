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

}  // namespace

ProgramCost CostOf(const MapProgram& program) {
  ProgramCost cost;
  for (const Instructions* part : {&program.advance, &program.evaluate}) {
    for (const Instruction& it : *part) Count(program, it, &cost);
  }
  // Finite, in the trained range, not far from it.
  constexpr std::int64_t kChecks = 5;
  cost.comparisons += kChecks * program.size(Space::kReading);
  cost.state_bytes =
      static_cast<std::int64_t>(sizeof(double)) * program.size(Space::kState);
  return cost;
}

}  // namespace errmap::models
