#include "models/export/language.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "models/export/program/error_curve.h"
#include "models/export/program/safe_names.h"
#include "models/history/lag.h"
#include "models/version.h"

namespace errmap::models {
namespace {

std::string UnitText(const data::Unit& unit) {
  return unit.symbol.empty() ? "no unit" : CommentText(unit.symbol);
}

// The array of a space that is not a single number.
char ArrayOf(Space space) {
  if (space == Space::kReading) return 'x';
  if (space == Space::kState) return 's';
  return std::ranges::find(kLocalArrays, space, &LocalArray::space)->name;
}

// What the controller around the map does, for the head of a file.
Lines AboutLimits(const MapProgram& program) {
  const ControllerLimits& limits = program.limits;
  const std::string unit = UnitText(program.target.unit);
  Lines lines{
      fmt::format("Limits: the error given is at most {:.6g} {} in size and "
                  "changes by at most",
                  limits.max_error,
                  unit),
      fmt::format(
          "{:.6g} {} per second, which no heat does.", limits.max_rate, unit)};
  for (const ProgramReading& reading : program.readings) {
    if (!(reading.slope > 0.0)) continue;
    lines.push_back(fmt::format(
        "Motion of the axis adds up to {:.3g} {} for each {} of {}.",
        reading.slope,
        unit,
        UnitText(reading.column.unit),
        CommentText(reading.column.name)));
  }
  for (const char* line :
       {"A step is not taken where a sensor is dead (0, -127, 85 or 850 "
        "outside "
        "of what",
        "was trained), is not a number, is far beyond its trained range, "
        "stands still while",
        "the others move, or contradicts them. The filters keep their state "
        "then, and",
        "the last good readings are held, where the axis is now, for"}) {
    lines.emplace_back(line);
  }
  lines.back() += fmt::format(" {:g} s; then the", limits.hold);
  lines.insert(
      lines.end(),
      {"error goes to 0. Beyond its travel the axis counts as at its end; "
       "beyond once",
       "the travel it is refused.",
       "UNHEALTHY is for the control: do not go on while it is set."});
  return lines;
}

}  // namespace

std::string Language::Place(Operand operand) const {
  if (operand.space == Space::kTime) return CellName(Cell::kWaited);
  if (operand.space == Space::kError) return "e";
  return fmt::format("{}[{}]", ArrayOf(operand.space), operand.index);
}

std::string Language::Number(double value, bool /*single*/) const {
  return RealText(value);
}

std::string Language::List(const std::vector<double>& values,
                           const std::string& indent,
                           bool single) const {
  std::vector<std::string> numbers;
  for (const double value : values) numbers.push_back(Number(value, single));
  return Joined(Wrapped(numbers, indent), "");
}

std::string Language::ArrayAt(Operand first, const char* index) const {
  const std::string place = Place(first);
  const std::string array = place.substr(0, place.find('['));
  return first.index == 0
             ? fmt::format("{}[{}]", array, index)
             : fmt::format("{}[{} + {}]", array, first.index, index);
}

Lines Language::Write(const MapProgram& program,
                      const Instructions& instructions) const {
  Lines lines;
  for (const Instruction& instruction : instructions) {
    for (std::string& line : WriteOne(program, instruction)) {
      lines.push_back(std::move(line));
    }
  }
  return lines;
}

Lines Language::WriteOne(const MapProgram& program,
                         const Instruction& it) const {
  const bool narrow_place = IsSingle(it.to.space);
  // Arithmetic is double as soon as one number of it is.
  const bool single =
      narrow_place && IsSingle(it.a.space) && IsSingle(it.b.space);
  const std::string to = Place(it.to);
  if (it.op == Op::kAffine) return Affine(it, program.tables[it.table]);
  if (it.op == Op::kSigmoid && it.count > 1) return Sigmoids(it);
  if (it.op == Op::kFloor || it.op == Op::kCeiling) {
    const std::string bound = Number(it.c, narrow_place);
    const char* relation = it.op == Op::kFloor ? " < " : " > ";
    return Bound(to + relation + bound, to, bound, it.guards);
  }
  const bool narrows = narrow_place && !single;
  const std::string value = ValueText(it, single);
  return it.op == Op::kLag || it.op == Op::kAddProduct
             ? Grow(it.to, value, narrows)
             : Set(it.to, value, narrows);
}

Lines Language::Bound(const std::string& condition,
                      const std::string& to,
                      const std::string& value,
                      bool guards) const {
  Lines lines{fmt::format(fmt::runtime(syntax_.when), condition),
              syntax_.indent + Assign(to, value, false)};
  if (guards) lines.push_back(syntax_.indent + Flag(kMapClipped));
  if (*syntax_.end_when != '\0') lines.emplace_back(syntax_.end_when);
  return lines;
}

Lines Language::Set(Operand to, const std::string& value, bool narrows) const {
  return {Assign(Place(to), value, narrows)};
}

Lines Language::Grow(Operand to, const std::string& by, bool narrows) const {
  return {Assign(Place(to), Place(to) + " + " + by, narrows)};
}

std::string Language::ValueText(const Instruction& it, bool single) const {
  const std::string to = Place(it.to);
  std::string a = Place(it.a);
  const std::string b = Place(it.b);
  std::string c = Number(it.c, single);
  switch (it.op) {
    case Op::kSet:
      return c;
    case Op::kCopy:
      return a;
    case Op::kSubtract:
      return a + " - " + b;
    case Op::kShift:
      return a + Plus(-it.c, single);
    case Op::kScale:
      return "(" + a + Plus(-it.c, single) + ") * " + Number(it.d, single);
    case Op::kTimes:
      return a + " * " + b;
    case Op::kTimesPlus:
      return a + " * " + b + Plus(it.c, single);
    case Op::kTimesPlusTerm:
      return a + " * " + b + " + " + Place({it.to.space, it.to.index + 1});
    case Op::kLinear:
      return a + " * " + c + Plus(it.d, single);
    case Op::kAccumulate:
      return to + " + " + a + " * " + c;
    case Op::kMeanDecay:
      return Call(kMeanDecayHelper, a + " / " + c);
    case Op::kGain:
      return a + " / " + c + " * " + b;
    case Op::kLag:
      return a + " * (" + b + " - " + to + ")";
    case Op::kAddProduct:
      return a + " * " + b;
    case Op::kSine:
    case Op::kCosine:
      return fmt::format("{}{}({} * {})",
                         it.op == Op::kSine ? syntax_.sine : syntax_.cosine,
                         single ? syntax_.of_single : "",
                         a,
                         c);
    case Op::kSigmoid:
      return Call(kSigmoidHelper, to);
    case Op::kFloor:
    case Op::kCeiling:
    case Op::kAffine:
      break;  // no value of one line
  }
  return "";
}

// " + 2.0", " - 2.0".
std::string Language::Plus(double value, bool single) const {
  return (std::signbit(value) ? " - " : " + ") +
         Number(std::fabs(value), single);
}

Lines Language::Write(const MapProgram& program, const Routine& routine) const {
  Lines lines;
  for (const Statement& statement : routine) {
    for (std::string& line : WriteOne(program, statement)) {
      lines.push_back(std::move(line));
    }
  }
  return lines;
}

Lines Language::Block(const MapProgram& program,
                      const std::string& first,
                      const Routine& body) const {
  Lines lines{first};
  for (const std::string& line : Write(program, body)) {
    lines.push_back(syntax_.indent + line);
  }
  return lines;
}

Lines Language::WriteOne(const MapProgram& program, const Statement& it) const {
  const auto end = [](Lines lines, const std::string& last) {
    if (!last.empty()) lines.push_back(last);
    return lines;
  };
  switch (it.kind) {
    case Statement::Kind::kAssign:
      return {Assign(
          Text(it.sides[0]),
          Text(it.sides[1]),
          it.sides[0].cell == Cell::kReading && IsSingle(Space::kReading))};
    case Statement::Kind::kFlag:
      return {Flag(it.flag)};
    case Statement::Kind::kRun:
      return Write(program, program.part(it.part, it.form));
    case Statement::Kind::kEach: {
      const int count = it.count > 0 ? it.count : program.size(Space::kReading);
      return end(
          Block(program,
                fmt::format(fmt::runtime(syntax_.loop), count, count - 1),
                it.body),
          syntax_.end_loop);
    }
    case Statement::Kind::kIf:
      break;
  }
  Lines lines =
      Block(program,
            fmt::format(fmt::runtime(syntax_.when), Text(it.sides[0])),
            it.body);
  if (!it.otherwise.empty()) {
    for (std::string& line : Block(program, syntax_.otherwise, it.otherwise)) {
      lines.push_back(std::move(line));
    }
  }
  return end(std::move(lines), syntax_.end_when);
}

// As part of another expression.
std::string Language::Inner(const Expression& it) const {
  using Kind = Expression::Kind;
  const bool stands_alone = it.kind == Kind::kNumber ||
                            it.kind == Kind::kCell || it.kind == Kind::kPlace ||
                            it.kind == Kind::kTrained ||
                            it.kind == Kind::kAbsolute;
  return stands_alone ? Text(it) : "(" + Text(it) + ")";
}

std::string Language::Text(const Expression& it) const {
  using Kind = Expression::Kind;
  const auto both = [&](const char* sign) {
    return fmt::format(
        "{} {} {}", Inner(it.parts[0]), sign, Inner(it.parts[1]));
  };
  switch (it.kind) {
    case Kind::kNumber:
      return Number(it.number, false);
    case Kind::kCell: {
      std::string name = CellName(it.cell);
      if (!InfoOf(it.cell).is_array) return name;
      return it.index == Expression::kLoop
                 ? fmt::format("{}[{}]", name, syntax_.index)
                 : fmt::format("{}[{}]", name, it.index);
    }
    case Kind::kPlace:
      return Place(it.place);
    case Kind::kTrained:
      return TrainedState(it.form, it.index);
    case Kind::kAny:
      return HasAny(it.mask);
    case Kind::kNot:
      return syntax_.negation + Inner(it.parts[0]);
    case Kind::kNegative:
      return "-" + Inner(it.parts[0]);
    case Kind::kAbsolute:
      return fmt::format("{}({})", syntax_.absolute, Text(it.parts[0]));
    case Kind::kAnd:
      return both(syntax_.conjunction);
    case Kind::kOr:
      return both(syntax_.disjunction);
    case Kind::kLess:
      return both("<");
    case Kind::kMore:
      return both(">");
    case Kind::kAtLeast:
      return both(">=");
    case Kind::kAtMost:
      return both("<=");
    case Kind::kEqual:
      return both(syntax_.equal);
    case Kind::kPlus:
      return both("+");
    case Kind::kMinus:
      return both("-");
    case Kind::kTimes:
      return both("*");
  }
  return "";
}

std::vector<CellInfo> KeptCells(const MapProgram& program) {
  std::vector<CellInfo> kept;
  for (int i = 0; i < kNumCells; ++i) {
    const CellInfo& info = InfoOf(static_cast<Cell>(i));
    if (info.kind == CellKind::kKept && program.Uses(info.cell)) {
      kept.push_back(info);
    }
  }
  return kept;
}

int NumSaved(const MapProgram& program) {
  int count = 2 + program.size(Space::kState);
  for (const CellInfo& cell : KeptCells(program)) {
    count += cell.is_array ? program.size(Space::kReading) : 1;
  }
  return count;
}

std::string StatusNames(int mask,
                        const std::string& before,
                        const std::string& between) {
  std::string names;
  for (const StatusBit& bit : StatusBits()) {
    if ((mask & bit.bit) == 0) continue;
    names += (names.empty() ? "" : between) + before + bit.name;
  }
  return names;
}

Lines AboutMap(const MapProgram& program,
               const std::string& name,
               Precision precision) {
  const bool single = precision == Precision::kSingle;
  Lines lines{
      fmt::format("{}: the map {} of {}, written by errmap {}.",
                  name,
                  CommentText(program.model),
                  CommentText(program.target.name),
                  Version()),
      fmt::format("Export {:.0f}: files of another one do not go with it.",
                  program.export_id),
      "",
      fmt::format(
          "error = actual - nominal, in {}{}.",
          UnitText(program.target.unit),
          program.since_first_row ? ", since the session's first row" : ""),
      "compensation = -error: the wrong sign doubles the error.",
      "",
      program.readings.empty() ? "It reads no inputs."
                               : "Inputs, in this order:"};
  if (!program.made_for.empty()) {
    lines.insert(lines.begin() + 5,
                 fmt::format("Made for {} alone.", program.made_for));
  }
  for (std::size_t i = 0; i < program.readings.size(); ++i) {
    const ProgramReading& reading = program.readings[i];
    lines.push_back(fmt::format("  {} {}, {}, trained {:g} to {:g}",
                                i,
                                CommentText(reading.column.name),
                                UnitText(reading.column.unit),
                                reading.trained_min,
                                reading.trained_max));
  }
  if (program.has_directions()) {
    const int position = PositionOf(program);
    const std::string where = CommentText(
        program.readings[static_cast<std::size_t>(position)].column.name);
    lines.insert(
        lines.end(),
        {"",
         fmt::format("Two maps: the first acts while {} increases, the second",
                     where),
         fmt::format("while it decreases. A turn counts once it has come back "
                     "by {:.3g};",
                     program.limits.band),
         fmt::format("the error may then change by {:.3g} at once. Before any "
                     "motion the",
                     program.limits.reversal),
         "first one acts."});
  }
  lines.push_back("");
  for (std::string& line : AboutLimits(program)) {
    lines.push_back(std::move(line));
  }
  lines.push_back("");
  const int states = program.size(Space::kState);
  lines.push_back(
      states > 0 ? fmt::format("Its filters and zeros: {} numbers.", states)
                 : "It has no memory but for what holds the error.");
  if (single) {
    lines.push_back("Single precision; the state stays double.");
  }
  return lines;
}

std::string MeanDecaySeries(const std::string& u) {
  std::string text = "1.0";
  for (int k = kMeanDecaySeriesTerms; k >= 2; --k) {
    text = fmt::format("(1.0 - {} / {}.0 * {})", u, k, text);
  }
  return text;
}

Lines Wrapped(const std::vector<std::string>& items,
              const std::string& indent) {
  constexpr std::size_t kWidth = 78;
  Lines lines;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string item = items[i] + (i + 1 < items.size() ? "," : "");
    if (lines.empty() || lines.back().size() + item.size() + 1 > kWidth) {
      lines.push_back(indent + item);
    } else {
      lines.back() += " " + item;
    }
  }
  return lines;
}

std::string Joined(const Lines& lines, const std::string& indent) {
  std::string text;
  for (const std::string& line : lines) {
    text += (line.empty() ? "" : indent + line) + "\n";
  }
  return text;
}

}  // namespace errmap::models
