#include "models/export/run_program.h"

#include <cmath>

#include "models/history/lag.h"

namespace errmap::models {

using Eigen::Index;

int StatusOfReadings(const MapProgram& program,
                     const Eigen::VectorXd& readings) {
  int status = 0;
  for (std::size_t i = 0; i < program.readings.size(); ++i) {
    const ProgramReading& trusted = program.readings[i];
    const double value = readings[static_cast<Index>(i)];
    if (!std::isfinite(value)) return kMapInvalid;
    if (value < trusted.trained_min || value > trusted.trained_max) {
      status |= kMapOutside;
    }
    if (value < trusted.far_min || value > trusted.far_max) status |= kMapFar;
  }
  return status;
}

ProgramRun::ProgramRun(const MapProgram& program, Precision precision)
    : program_(program), precision_(precision) {
  for (std::size_t i = 0; i < kNumSpaces; ++i) {
    values_[i].assign(static_cast<std::size_t>(program.sizes[i]), 0.0);
  }
}

int ProgramRun::Begin(const Eigen::VectorXd& readings) {
  const int status = StatusOfReadings(program_, readings);
  if ((status & kMapInvalid) != 0) return status;
  Load(readings);
  Execute(program_.begin);
  return status;
}

int ProgramRun::Step(double dt,
                     const Eigen::VectorXd& readings,
                     double* error) {
  const int status = StatusOfReadings(program_, readings);
  if ((status & kMapInvalid) != 0 || (program_.has_memory() && !(dt >= 0.0))) {
    return status | kMapInvalid;
  }
  Load(readings);
  At({Space::kTime, 0}) = dt;
  Execute(program_.advance);
  clipped_ = false;
  Execute(program_.evaluate);
  const double found = At({Space::kError, 0});
  if (!std::isfinite(found)) return status | kMapInvalid;
  *error = found;
  return status | (clipped_ ? kMapClipped : 0);
}

int ProgramRun::Zero(const Eigen::VectorXd& readings) {
  const int status = StatusOfReadings(program_, readings);
  if ((status & kMapInvalid) != 0) return status;
  Load(readings);
  Execute(program_.zero);
  return status;
}

void ProgramRun::Load(const Eigen::VectorXd& readings) {
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
      const Eigen::MatrixXd& table = program_.tables[it.table];
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

}  // namespace errmap::models
