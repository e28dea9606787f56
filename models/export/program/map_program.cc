#include "models/export/program/map_program.h"

#include <algorithm>

namespace errmap::models {

void MapProgram::MeasureSpaces() {
  const auto grow = [&](Space space, int size) {
    int& known = sizes[static_cast<std::size_t>(space)];
    known = std::max(known, size);
  };
  grow(Space::kReading, static_cast<int>(readings.size()));
  grow(Space::kTime, 1);
  grow(Space::kError, 1);
  for (const Instructions* part : parts()) {
    for (const Instruction& instruction : *part) {
      grow(instruction.to.space, instruction.to.index + instruction.count);
    }
  }
}

const Instructions& MapProgram::part(Part part, int form) const {
  const MapForm& of = forms[static_cast<std::size_t>(form)];
  switch (part) {
    case Part::kBegin:
      return begin;
    case Part::kAdvance:
      return advance;
    case Part::kZero:
      return zero;
    case Part::kEvaluate:
      return of.evaluate;
    case Part::kJudge:
      return of.judge;
    case Part::kMeasure:
      break;
  }
  return of.measure;
}

std::vector<const Instructions*> MapProgram::parts() const {
  std::vector<const Instructions*> all{&begin, &advance, &zero};
  for (const MapForm& form : forms) {
    all.insert(all.end(), {&form.evaluate, &form.judge, &form.measure});
  }
  return all;
}

bool MapProgram::IsTableDouble(std::size_t table) const {
  return std::ranges::any_of(forms, [table](const MapForm& form) {
    const auto is_it = [table](const Instruction& it) {
      return it.op == Op::kAffine && it.table == table;
    };
    return std::ranges::any_of(form.judge, is_it) ||
           std::ranges::any_of(form.measure, is_it);
  });
}

bool MapProgram::Uses(Cell cell) const {
  return models::Uses(read, cell) || models::Uses(move, cell);
}

bool MapProgram::Uses(Op op) const {
  const std::vector<const Instructions*> all = parts();
  return std::ranges::any_of(all, [op](const Instructions* part) {
    return std::ranges::find(*part, op, &Instruction::op) != part->end();
  });
}

std::vector<double> TableValues(const MapProgram& program,
                                const ReadingTable& table) {
  std::vector<double> values;
  for (const ProgramReading& reading : program.readings) {
    values.push_back(reading.*table.value);
  }
  return values;
}

VectorXd MeanReadings(const MapProgram& program) {
  VectorXd mean(std::ssize(program.readings));
  for (Index i = 0; i < mean.size(); ++i) {
    mean[i] = program.readings[static_cast<std::size_t>(i)].trained_mean;
  }
  return mean;
}

}  // namespace errmap::models
