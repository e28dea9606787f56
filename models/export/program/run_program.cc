#include "models/export/program/run_program.h"

#include <cmath>

#include "models/history/lag.h"

namespace errmap::models {

ProgramRun::ProgramRun(const MapProgram& program, Precision precision, int form)
    : program_(&program), precision_(precision), form_(form) {
  for (std::size_t i = 0; i < kNumSpaces; ++i) {
    values_[i].assign(static_cast<std::size_t>(program.sizes[i]), 0.0);
  }
}

int ProgramRun::Begin(const VectorXd& readings) {
  if (!readings.allFinite()) return kMapInvalid;
  Load(readings);
  Execute(program_->begin);
  return 0;
}

int ProgramRun::Step(double dt, const VectorXd& readings, double* error) {
  if (!readings.allFinite() || (program_->has_memory() && !(dt >= 0.0))) {
    return kMapInvalid;
  }
  Load(readings);
  At({Space::kTime, 0}) = dt;
  Execute(program_->advance);
  ClearClipped();
  Execute(program_->part(Part::kEvaluate, form_));
  const double found = At({Space::kError, 0});
  if (!std::isfinite(found)) return kMapInvalid;
  *error = found;
  return clipped_ ? kMapClipped : 0;
}

int ProgramRun::Zero(const VectorXd& readings) {
  if (!readings.allFinite()) return kMapInvalid;
  Load(readings);
  Execute(program_->zero);
  return 0;
}

void ProgramRun::Load(const VectorXd& readings) {
  for (Index i = 0; i < readings.size(); ++i) {
    At({Space::kReading, static_cast<int>(i)}) =
        Rounded(readings[i], Space::kReading);
  }
}

void ProgramRun::Execute(const Instructions& instructions) {
  for (const Instruction& instruction : instructions) Apply(instruction);
}

double& ProgramRun::At(Operand operand) {
  return values_[static_cast<std::size_t>(operand.space)]
                [static_cast<std::size_t>(operand.index)];
}

// A sum or product of single numbers, rounded from double, is the single one.
double ProgramRun::Rounded(double value, Space to) const {
  if (precision_ == Precision::kDouble || IsAlwaysDouble(to)) return value;
  return static_cast<float>(value);
}

void ProgramRun::Apply(const Instruction& it) {
  const auto set = [&](double value) {
    At(it.to) = Rounded(value, it.to.space);
  };
  // A number of the program, or an intermediate result.
  const auto r = [&](double value) { return Rounded(value, it.to.space); };
  switch (it.op) {
    case Op::kSet:
      return set(it.c);
    case Op::kCopy:
      return set(At(it.a));
    case Op::kSubtract:
      return set(At(it.a) - At(it.b));
    case Op::kShift:
      return set(At(it.a) - it.c);
    case Op::kScale:
      return set(r(At(it.a) - it.c) * r(it.d));
    case Op::kTimes:
      return set(At(it.a) * At(it.b));
    case Op::kTimesPlus:
      return set(r(At(it.a) * At(it.b)) + r(it.c));
    case Op::kTimesPlusTerm:
      return set(r(At(it.a) * At(it.b)) + At({it.to.space, it.to.index + 1}));
    case Op::kLinear:
      return set(r(r(it.c) * At(it.a)) + r(it.d));
    case Op::kAccumulate:
      return set(At(it.to) + r(r(it.c) * At(it.a)));
    case Op::kMeanDecay:
      return set(MeanDecay(At(it.a) / it.c));
    case Op::kGain:
      return set(At(it.a) / it.c * At(it.b));
    case Op::kLag:
      return set(At(it.to) + At(it.a) * (At(it.b) - At(it.to)));
    case Op::kAddProduct:
      return set(At(it.to) + At(it.a) * At(it.b));
    case Op::kSine:
      return set(std::sin(it.c * At(it.a)));
    case Op::kCosine:
      return set(std::cos(it.c * At(it.a)));
    case Op::kFloor:
    case Op::kCeiling: {
      const double bound = r(it.c);
      const bool beyond =
          it.op == Op::kFloor ? At(it.to) < bound : At(it.to) > bound;
      if (!beyond) return;
      clipped_ = clipped_ || it.guards;
      return set(bound);
    }
    case Op::kAffine: {
      const MatrixXd& table = program_->tables[it.table];
      const auto num_inputs = static_cast<int>(table.cols()) - 1;
      for (int row = 0; row < it.count; ++row) {
        double sum = r(table(row, num_inputs));
        for (int i = 0; i < num_inputs; ++i) {
          sum = r(sum + r(r(table(row, i)) * At({it.a.space, it.a.index + i})));
        }
        At({it.to.space, it.to.index + row}) = sum;
      }
      return;
    }
    case Op::kSigmoid:
      for (int i = 0; i < it.count; ++i) {
        double& value = At({it.to.space, it.to.index + i});
        value = r(1.0 / r(1.0 + r(std::exp(-value))));
      }
      return;
  }
}

ControllerRun::ControllerRun(const MapProgram& program, Precision precision)
    : program_(&program), run_(program, precision) {
  const auto count = program.readings.size();
  for (int i = 0; i < kNumCells; ++i) {
    const bool is_array = InfoOf(static_cast<Cell>(i)).is_array;
    values_[static_cast<std::size_t>(i)].assign(
        is_array ? count : 1, InitialValue(program, static_cast<Cell>(i)));
  }
  for (const ReadingTable& table : kTables) {
    values_[static_cast<std::size_t>(table.cell)] = TableValues(program, table);
  }
}

int ControllerRun::Step(double dt, const VectorXd& readings, double* error) {
  status_ = 0;
  run_.ClearClipped();
  run_.Load(readings);
  Value(Cell::kDt) = dt;
  Run(program_->read);
  Run(program_->move);
  *error = run_.Rounded(Value(Cell::kGiven), Space::kError);
  return Status();
}

void ControllerRun::Run(const Routine& routine) {
  for (const Statement& statement : routine) RunOne(statement);
}

void ControllerRun::RunOne(const Statement& it) {
  switch (it.kind) {
    case Statement::Kind::kAssign:
      Place(it.sides[0]) = it.sides[0].cell == Cell::kReading
                               ? run_.Rounded(Of(it.sides[1]), Space::kReading)
                               : Of(it.sides[1]);
      return;
    case Statement::Kind::kIf:
      return Run(Of(it.sides[0]) != 0.0 ? it.body : it.otherwise);
    case Statement::Kind::kEach: {
      const int count =
          it.count > 0 ? it.count : program_->size(Space::kReading);
      for (loop_ = 0; loop_ < count; ++loop_) Run(it.body);
      return;
    }
    case Statement::Kind::kFlag:
      status_ |= it.flag;
      return;
    case Statement::Kind::kRun:
      run_.At({Space::kTime, 0}) = Value(Cell::kWaited);
      return run_.Execute(program_->part(it.part, it.form));
  }
}

double& ControllerRun::Place(const Expression& it) {
  const bool is_array = InfoOf(it.cell).is_array;
  const int index = !is_array                       ? 0
                    : it.index == Expression::kLoop ? loop_
                                                    : it.index;
  if (it.cell == Cell::kReading) return run_.At({Space::kReading, index});
  if (it.cell == Cell::kDoubt) return run_.At({Space::kDoubt, index});
  if (it.cell == Cell::kError) return run_.At({Space::kError, 0});
  return Value(it.cell, index);
}

double ControllerRun::Of(const Expression& it) {
  using Kind = Expression::Kind;
  const auto a = [&] { return Of(it.parts[0]); };
  const auto b = [&] { return Of(it.parts[1]); };
  switch (it.kind) {
    case Kind::kNumber:
      return it.number;
    case Kind::kCell:
      return Place(it);
    case Kind::kPlace:
      return run_.At(it.place);
    case Kind::kTrained:
      return program_->forms[static_cast<std::size_t>(it.form)].states(
          loop_, it.index);
    case Kind::kAny:
      return (Status() & it.mask) != 0 ? 1.0 : 0.0;
    case Kind::kNot:
      return a() != 0.0 ? 0.0 : 1.0;
    case Kind::kNegative:
      return -a();
    case Kind::kAbsolute:
      return std::fabs(a());
    case Kind::kAnd:
      return a() != 0.0 && b() != 0.0 ? 1.0 : 0.0;
    case Kind::kOr:
      return a() != 0.0 || b() != 0.0 ? 1.0 : 0.0;
    case Kind::kLess:
      return a() < b() ? 1.0 : 0.0;
    case Kind::kMore:
      return a() > b() ? 1.0 : 0.0;
    case Kind::kAtLeast:
      return a() >= b() ? 1.0 : 0.0;
    case Kind::kAtMost:
      return a() <= b() ? 1.0 : 0.0;
    case Kind::kEqual:
      return a() == b() ? 1.0 : 0.0;
    case Kind::kPlus:
      return a() + b();
    case Kind::kMinus:
      return a() - b();
    case Kind::kTimes:
      return a() * b();
  }
  return 0.0;
}

}  // namespace errmap::models
