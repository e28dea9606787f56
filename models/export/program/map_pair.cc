#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "models/export/program/error_curve.h"
#include "models/export/program/map_program.h"
#include "models/export/program/safe_names.h"

namespace errmap::models {
namespace {

void RequireAlike(bool alike, const std::string& what) {
  if (alike) return;
  throw std::invalid_argument("the two maps do not go together: " + what);
}

// The places of a program's numbers within a joined one.
struct Move {
  const std::vector<int>& readings;  // to
  int states = 0;                    // those before
  std::size_t tables = 0;

  Operand operator()(Operand operand) const {
    if (operand.space == Space::kState) operand.index += states;
    if (operand.space == Space::kReading) {
      operand.index = readings[static_cast<std::size_t>(operand.index)];
    }
    return operand;
  }
  void Append(const Instructions& from, Instructions* to) const {
    for (Instruction instruction : from) {
      instruction.to = (*this)(instruction.to);
      instruction.a = (*this)(instruction.a);
      instruction.b = (*this)(instruction.b);
      instruction.table += tables;
      to->push_back(instruction);
    }
  }
};

// Adds a reading, or widens the one of that name: its index.
int Join(const ProgramReading& reading, std::vector<ProgramReading>* readings) {
  const auto found =
      std::ranges::find_if(*readings, [&](const ProgramReading& known) {
        return known.column.name == reading.column.name;
      });
  const auto index = static_cast<int>(found - readings->begin());
  if (found == readings->end()) {
    readings->push_back(reading);
    return index;
  }
  RequireAlike(
      found->column.unit == reading.column.unit,
      fmt::format("{} has two units", CommentText(reading.column.name)));
  found->trained_min = std::min(found->trained_min, reading.trained_min);
  found->trained_max = std::max(found->trained_max, reading.trained_max);
  return index;
}

std::string PositionName(const MapProgram& program) {
  const int position = PositionOf(program);
  RequireAlike(position >= 0, "one reads no position");
  return program.readings[static_cast<std::size_t>(position)].column.name;
}

}  // namespace

MapProgram JoinedPrograms(const MapProgram& increasing,
                          const MapProgram& decreasing) {
  RequireAlike(increasing.target.unit == decreasing.target.unit &&
                   increasing.since_first_row == decreasing.since_first_row,
               "their errors have not the same unit, or not the same zero");
  RequireAlike(PositionName(increasing) == PositionName(decreasing),
               "they read different positions");
  MapProgram joined = increasing;
  joined.made_for.clear();
  if (decreasing.model != increasing.model) {
    joined.model += " and " + decreasing.model;
  }
  MapForm& form = joined.forms.emplace_back();
  for (const ProgramReading& reading : decreasing.readings) {
    form.readings.push_back(Join(reading, &joined.readings));
  }
  const Move move{.readings = form.readings,
                  .states = increasing.size(Space::kState),
                  .tables = increasing.tables.size()};
  joined.tables.insert(
      joined.tables.end(), decreasing.tables.begin(), decreasing.tables.end());
  move.Append(decreasing.begin, &joined.begin);
  move.Append(decreasing.advance, &joined.advance);
  move.Append(decreasing.zero, &joined.zero);
  const MapForm& from = decreasing.forms.front();
  move.Append(from.evaluate, &form.evaluate);
  for (const TrainedRange& range : from.ranges) {
    form.ranges.push_back({move(range.place), range.low, range.high});
  }
  joined.longest_bridged =
      std::min(increasing.longest_bridged, decreasing.longest_bridged);
  joined.settles_after =
      std::max(increasing.settles_after, decreasing.settles_after);
  joined.MeasureSpaces();
  return joined;
}

VectorXd ReadingsOfProgram(const MapProgram& program,
                           std::size_t form,
                           const VectorXd& of_map) {
  VectorXd readings = MeanReadings(program);
  readings(program.forms[form].readings) = of_map;
  return readings;
}

}  // namespace errmap::models
