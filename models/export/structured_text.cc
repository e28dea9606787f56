#include "models/export/structured_text.h"

#include <algorithm>

#include <fmt/format.h>

#include "models/export/program/safe_names.h"
#include "models/export/program/saved_state.h"
#include "models/history/lag.h"

namespace errmap::models {
namespace {

using Eigen::Index;

constexpr Syntax kStructuredText{.conjunction = "AND",
                                 .disjunction = "OR",
                                 .negation = "NOT ",
                                 .equal = "=",
                                 .absolute = "ABS",
                                 .when = "IF {} THEN",
                                 .otherwise = "ELSE",
                                 .end_when = "END_IF;",
                                 .loop = "FOR I := 0 TO {1} DO",
                                 .end_loop = "END_FOR;",
                                 .index = "I",
                                 .indent = "  "};

// "zero_due" -> "ZeroDue": every word of the language has capitals only.
std::string CamelCase(const std::string& name) {
  std::string text;
  bool begins = true;
  for (const char c : name) {
    if (c != '_') text += begins ? static_cast<char>(c - 'a' + 'A') : c;
    begins = c == '_';
  }
  return text;
}

std::string BitName(const StatusBit& bit) {
  std::string name = bit.name;
  std::ranges::transform(
      name.begin() + 1, name.end(), name.begin() + 1, [](char c) {
        return static_cast<char>(c - 'A' + 'a');
      });
  return name;
}

// Arrays and bits of the status are variables of the block.
class StructuredTextLanguage final : public Language {
 public:
  explicit StructuredTextLanguage(std::string name)
      : Language(Precision::kDouble, kStructuredText), name_(std::move(name)) {}

  std::string CellName(Cell cell) const override {
    if (cell == Cell::kError) return "Found";
    return CamelCase(InfoOf(cell).name);
  }

  std::string TrainedState(int form, int coordinate) const override {
    return fmt::format("States{}_{}[I]", form, coordinate);
  }

  std::string HasAny(int mask) const override {
    std::string names;
    for (const StatusBit& bit : StatusBits()) {
      if ((mask & bit.bit) == 0) continue;
      names += (names.empty() ? "" : " OR ") + BitName(bit);
    }
    return names;
  }

 private:
  std::string Place(Operand operand) const override {
    if (operand.space == Space::kError) return CellName(Cell::kError);
    std::string place = Language::Place(operand);
    if (operand.space != Space::kTime) {
      place.front() = static_cast<char>(place.front() - 'a' + 'A');
    }
    return place;
  }

  std::string Flag(int bit) const override {
    return Assign(HasAny(bit), "TRUE", false);
  }

  std::string Assign(const std::string& to,
                     const std::string& value,
                     bool /*narrows*/) const override {
    return to + " := " + value + ";";
  }

  std::string Call(Function function,
                   const std::string& argument,
                   bool /*single*/) const override {
    switch (function) {
      case Function::kMeanDecay:
        return fmt::format("{}_mean_decay(U := {})", name_, argument);
      case Function::kSine:
        return "SIN(" + argument + ")";
      case Function::kCosine:
        return "COS(" + argument + ")";
      case Function::kSigmoid:
        return fmt::format("{}_sigmoid(A := {})", name_, argument);
    }
    return "";
  }

  Lines Bound(const std::string& condition,
              const std::string& to,
              const std::string& value,
              bool guards) const override {
    return {fmt::format("IF {} THEN {} := {};{} END_IF;",
                        condition,
                        to,
                        value,
                        guards ? " " + Flag(kMapClipped) : "")};
  }

  // Three products a line: editors of controllers cut long ones.
  Lines Affine(const Instruction& it,
               const Eigen::MatrixXd& table) const override {
    constexpr Index kProductsPerLine = 3;
    Lines lines;
    const Index num_inputs = table.cols() - 1;
    for (int row = 0; row < it.count; ++row) {
      const std::string to = Place({it.to.space, it.to.index + row});
      lines.push_back(Assign(to, RealText(table(row, num_inputs)), false));
      for (Index first = 0; first < num_inputs; first += kProductsPerLine) {
        std::string sum = to;
        for (Index i = first;
             i < std::min(first + kProductsPerLine, num_inputs);
             ++i) {
          sum += fmt::format(
              " + ({}) * {}",
              RealText(table(row, i)),
              Place({it.a.space, it.a.index + static_cast<int>(i)}));
        }
        lines.push_back(Assign(to, sum, false));
      }
    }
    return lines;
  }

  Lines Sigmoids(const Instruction& it) const override {
    Lines lines;
    for (int i = 0; i < it.count; ++i) {
      const std::string to = Place({it.to.space, it.to.index + i});
      lines.push_back(Assign(to, Call(Function::kSigmoid, to, false), false));
    }
    return lines;
  }

  std::string name_;
};

std::vector<std::string> InputNames(const MapProgram& program) {
  constexpr std::size_t kLongest = 28;
  std::vector<std::string> names;
  for (const ProgramReading& reading : program.readings) {
    names.push_back(reading.column.name);
  }
  names = SafeIdentifiers(names, kLongest);
  // No word of the language, nor of the block, begins so.
  for (std::string& name : names) name.insert(0, "In_");
  return names;
}

std::string Comment(const Lines& lines) {
  return "(* " + Joined(lines, "   ").substr(3) + "*)\n";
}

std::string Functions(const MapProgram& program, const std::string& name) {
  std::string text;
  if (program.Uses(Op::kMeanDecay)) {
    text += fmt::format(R"(
FUNCTION {0}_mean_decay : LREAL
(* (1 - exp(-U)) / U; of a short step by its series, since the difference would
   keep no digits. *)
VAR_INPUT
  U : LREAL;
END_VAR
IF U >= {1} THEN
  {0}_mean_decay := (1.0 - EXP(-U)) / U;
ELSE
  {0}_mean_decay := {2};
END_IF;
END_FUNCTION
)",
                        name,
                        RealText(kMeanDecaySeriesBelow),
                        MeanDecaySeries("U"));
  }
  if (program.Uses(Op::kSigmoid)) {
    text += fmt::format(R"(
FUNCTION {0}_sigmoid : LREAL
VAR_INPUT
  A : LREAL;
END_VAR
IF A > -700.0 THEN
  {0}_sigmoid := 1.0 / (1.0 + EXP(-A));
ELSE
  {0}_sigmoid := 0.0;
END_IF;
END_FUNCTION
)",
                        name);
  }
  return text;
}

std::string ArrayText(const std::string& name, int size) {
  return fmt::format("  {} : ARRAY[0..{}] OF LREAL", name, size - 1);
}

// Constants of the readings, and the trained states.
std::string Tables(const MapProgram& program,
                   const StructuredTextLanguage& language) {
  std::string text;
  const auto add = [&](const std::string& name,
                       const std::vector<double>& values) {
    std::vector<std::string> numbers;
    for (const double value : values) numbers.push_back(RealText(value));
    text += ArrayText(name, static_cast<int>(values.size())) + " := [\n" +
            Joined(Wrapped(numbers, "    "), "");
    text.insert(text.size() - 1, "];");
  };
  for (const Cell cell : kTables) {
    if (!program.Uses(cell)) continue;
    std::vector<double> values;
    for (const ProgramReading& reading : program.readings) {
      values.push_back(TableValue(reading, cell));
    }
    add(language.CellName(cell), values);
  }
  for (std::size_t form = 0; form < program.forms.size(); ++form) {
    const Eigen::MatrixXd& states = program.forms[form].states;
    for (Index k = 0; k < states.cols(); ++k) {
      add(fmt::format("States{}_{}", form, k),
          {states.col(k).begin(), states.col(k).end()});
    }
  }
  return text;
}

std::string Inputs(const MapProgram& program,
                   const std::vector<std::string>& inputs) {
  std::string text =
      "VAR_INPUT\n"
      "  Start : BOOL; (* a session begins with the next step taken: filters "
      "in their steady state, the zero taken *)\n"
      "  TakeZero : BOOL; (* the next step taken takes the zero anew *)\n"
      "  DtSeconds : LREAL; (* since the call before *)\n"
      "  AwaySeconds : LREAL := 1.0E+30; (* in the first call after a restart: "
      "how long it was; from an hour on it begins anew *)\n";
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const ProgramReading& reading = program.readings[i];
    text += fmt::format("  {} : LREAL; (* {}{}{} *)\n",
                        inputs[i],
                        CommentText(reading.column.name),
                        reading.column.unit.symbol.empty() ? "" : ", ",
                        CommentText(reading.column.unit.symbol));
  }
  return text + fmt::format(
                    "  MaxError : LREAL := {}; (* limits *)\n"
                    "  MaxRate : LREAL := {};\nEND_VAR\n",
                    RealText(program.limits.max_error),
                    RealText(program.limits.max_rate));
}

// The limits, which the block's caller may set.
bool IsInput(Cell cell) {
  return cell == Cell::kMostError || cell == Cell::kMostRate;
}

std::string Declarations(const MapProgram& program,
                         const std::vector<std::string>& inputs,
                         const StructuredTextLanguage& language) {
  std::string text = Inputs(program, inputs) + R"(VAR_OUTPUT
  Error : LREAL; (* within the limits *)
  Compensation : LREAL; (* -Error *)
  Valid : BOOL; (* the step was taken *)
)";
  if (program.Uses(Cell::kSettling)) {
    text += "  Settles : LREAL; (* s until what filters remember is good *)\n";
  }
  for (const StatusBit& bit : StatusBits()) {
    text += fmt::format("  {} : BOOL; (* {} *)\n", BitName(bit), bit.what);
  }
  text += "END_VAR\nVAR\n" + Tables(program, language);
  const auto array = [&](const std::string& name, int size) {
    if (size > 0) text += ArrayText(name, size) + ";\n";
  };
  array("X", program.size(Space::kReading));
  for (const LocalArray local : kLocalArrays) {
    array({static_cast<char>(local.name - 'a' + 'A')},
          program.size(local.space));
  }
  for (const Cell cell :
       {Cell::kDt, Cell::kCommon, Cell::kAway, Cell::kTarget, Cell::kError}) {
    if (program.Uses(cell) || cell == Cell::kError) {
      text += fmt::format("  {} : LREAL;\n", language.CellName(cell));
    }
  }
  if (!inputs.empty()) text += "  I : INT;\n";
  // Over a warm restart these are kept, but the first is not.
  text += "  Running : BOOL;\nEND_VAR\nVAR RETAIN\n  OfMap : LREAL;\n";
  array("S", program.size(Space::kState));
  for (const CellInfo& cell : KeptCells(program)) {
    if (IsInput(cell.cell)) continue;
    const std::string name = language.CellName(cell.cell);
    if (cell.is_array) {
      array(name, program.size(Space::kReading));
    } else {
      text += fmt::format("  {} : LREAL;\n", name);
    }
  }
  return text + "END_VAR\n";
}

// What stands before the routines.
std::string Prelude(const MapProgram& program,
                    const std::vector<std::string>& inputs,
                    const StructuredTextLanguage& language) {
  std::string text;
  std::string anew;
  std::string session;
  for (const CellInfo& cell : KeptCells(program)) {
    if (IsInput(cell.cell) || cell.is_array) continue;
    const std::string name = language.CellName(cell.cell);
    anew += fmt::format(
        "    {} := {};\n", name, RealText(InitialValue(program, cell.cell)));
    if (IsOfSession(cell.cell)) session += fmt::format("  {} := 0.0;\n", name);
  }
  text += fmt::format(R"(IF NOT Running THEN
  Running := TRUE;
  IF OfMap = {0} AND AwaySeconds >= 0.0 AND AwaySeconds <= {1} THEN
    Waited := Waited + AwaySeconds;
    Missed := Missed + AwaySeconds;
    Room := Room + MaxRate * AwaySeconds;
  ELSE
    OfMap := {0};
{2}  END_IF;
END_IF;
)",
                      RealText(Fingerprint(program)),
                      RealText(LongestAge(program)),
                      anew);
  for (const StatusBit& bit : StatusBits()) {
    text += BitName(bit) + " := FALSE;\n";
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    text += fmt::format("X[{}] := {};\n", i, inputs[i]);
  }
  text += "Passed := DtSeconds;\nIF Start THEN\n" + session + "END_IF;\n";
  if (!program.zero.empty()) {
    text += "IF TakeZero THEN ZeroDue := 1.0; END_IF;\n";
  }
  return text;
}

}  // namespace

std::vector<ExportedFile> StructuredText(const MapProgram& program,
                                         const std::string& name) {
  const std::vector<std::string> inputs = InputNames(program);
  const StructuredTextLanguage language(name);
  const std::string text =
      Comment(AboutMap(program, name, Precision::kDouble)) +
      Functions(program, name) +
      fmt::format("\nFUNCTION_BLOCK {}_map\n", name) +
      Declarations(program, inputs, language) + "\n" +
      Prelude(program, inputs, language) +
      Joined(language.Write(program, program.read), "") +
      Joined(language.Write(program, program.move), "") +
      fmt::format(
          "Error := Given;\nCompensation := -Given;\nValid := NOT ({});\n{}",
          language.HasAny(kMapNotTaken),
          program.Uses(Cell::kSettling) ? "Settles := SettlesIn;\n" : "") +
      "END_FUNCTION_BLOCK\n";
  return {{name + ".st", text}};
}

}  // namespace errmap::models
