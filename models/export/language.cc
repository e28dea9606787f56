#include "models/export/language.h"

#include <cmath>

#include <fmt/format.h>

#include "models/export/safe_names.h"
#include "models/history/lag.h"
#include "models/version.h"

namespace errmap::models {
namespace {

std::string UnitText(const data::Unit& unit) {
  return unit.symbol.empty() ? "no unit" : CommentText(unit.symbol);
}

// The array of a space; '\0' of those that are one number.
char ArrayOf(Space space) {
  switch (space) {
    case Space::kReading:
      return 'x';
    case Space::kState:
      return 's';
    case Space::kGain:
      return 'g';
    case Space::kDerived:
      return 'v';
    case Space::kForm:
      return 'u';
    case Space::kScaled:
      return 'z';
    case Space::kHidden:
      return 'h';
    case Space::kTerm:
      return 't';
    case Space::kTime:
    case Space::kError:
      break;
  }
  return '\0';
}

}  // namespace

std::string Language::Place(Operand operand) const {
  if (operand.space == Space::kTime) return "dt_s";
  if (operand.space == Space::kError) return "e";
  return fmt::format("{}[{}]", ArrayOf(operand.space), operand.index);
}

std::string Language::Number(double value, bool /*single*/) const {
  return RealText(value);
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
  return {Assign(to, ValueText(it, single), narrow_place && !single)};
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
      return Call(Function::kMeanDecay, Place(it.a) + " / " + c, false);
    case Op::kGain:
      return a + " / " + c + " * " + b;
    case Op::kLag:
      return to + " + " + a + " * (" + b + " - " + to + ")";
    case Op::kAddProduct:
      return to + " + " + a + " * " + b;
    case Op::kSine:
      return Call(Function::kSine, a + " * " + c, single);
    case Op::kCosine:
      return Call(Function::kCosine, a + " * " + c, single);
    case Op::kSigmoid:
      return Call(Function::kSigmoid, to, single);
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
      "",
      fmt::format(
          "error = actual - nominal, in {}{}.",
          UnitText(program.target.unit),
          program.since_first_row ? ", since the session's first row" : ""),
      "compensation = -error: the wrong sign doubles the error.",
      "",
      program.readings.empty() ? "It reads no inputs."
                               : "Inputs, in this order:"};
  for (std::size_t i = 0; i < program.readings.size(); ++i) {
    const ProgramReading& reading = program.readings[i];
    lines.push_back(fmt::format("  {} {}, {}, trained {:g} to {:g}",
                                i,
                                CommentText(reading.column.name),
                                UnitText(reading.column.unit),
                                reading.trained_min,
                                reading.trained_max));
  }
  lines.push_back("");
  const int states = program.size(Space::kState);
  lines.push_back(states > 0 ? fmt::format("Its state: {} doubles, {} bytes.",
                                           states,
                                           static_cast<std::size_t>(states) *
                                               sizeof(double))
                             : "It has no memory.");
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
