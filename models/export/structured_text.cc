#include "models/export/structured_text.h"

#include <algorithm>

#include <fmt/format.h>

#include "models/export/safe_names.h"
#include "models/history/lag.h"

namespace errmap::models {
namespace {

using Eigen::Index;

// Readings are inputs with a name of their own, all else arrays of the block.
class StructuredTextLanguage final : public Language {
 public:
  StructuredTextLanguage(std::string name, std::vector<std::string> inputs)
      : Language(Precision::kDouble),
        name_(std::move(name)),
        inputs_(std::move(inputs)) {}

 private:
  std::string Place(Operand operand) const override {
    if (operand.space == Space::kReading) {
      return inputs_[static_cast<std::size_t>(operand.index)];
    }
    if (operand.space == Space::kTime) return "DtSeconds";
    if (operand.space == Space::kError) return "Found";
    std::string place = Language::Place(operand);
    place.front() = static_cast<char>(place.front() - 'a' + 'A');
    return place;
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
                        guards ? " Clipped := TRUE;" : "")};
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
  std::vector<std::string> inputs_;
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

std::string Declarations(const MapProgram& program,
                         const std::vector<std::string>& inputs) {
  std::string text = "VAR_INPUT\n";
  if (program.has_memory()) {
    text +=
        "  Start : BOOL; (* a session begins: filters in their steady state, "
        "the zero taken *)\n"
        "  TakeZero : BOOL; (* takes the zero anew *)\n"
        "  DtSeconds : LREAL; (* since the call before *)\n";
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const ProgramReading& reading = program.readings[i];
    text += fmt::format("  {} : LREAL; (* {}{}{} *)\n",
                        inputs[i],
                        CommentText(reading.column.name),
                        reading.column.unit.symbol.empty() ? "" : ", ",
                        CommentText(reading.column.unit.symbol));
  }
  text += R"(END_VAR
VAR_OUTPUT
  Error : LREAL; (* the last one that was valid *)
  Compensation : LREAL; (* -Error *)
  Valid : BOOL; (* inputs and error are numbers *)
  Outside : BOOL; (* an input left its trained range: extrapolated *)
  Far : BOOL; (* ... so far that its sensor is to be doubted *)
  Clipped : BOOL; (* a guard clipped an input or the error *)
END_VAR
VAR
)";
  struct Array {
    Space space;
    char name;
  };
  for (const Array array : {Array{Space::kState, 'S'},
                            Array{Space::kGain, 'G'},
                            Array{Space::kDerived, 'V'},
                            Array{Space::kForm, 'U'},
                            Array{Space::kScaled, 'Z'},
                            Array{Space::kHidden, 'H'},
                            Array{Space::kTerm, 'T'}}) {
    if (program.size(array.space) == 0) continue;
    text += fmt::format("  {} : ARRAY[0..{}] OF LREAL;\n",
                        array.name,
                        program.size(array.space) - 1);
  }
  if (program.has_memory()) text += "  Started : BOOL := FALSE;\n";
  return text + "  Found : LREAL;\nEND_VAR\n";
}

std::string Checks(const MapProgram& program,
                   const std::vector<std::string>& inputs) {
  std::string text =
      "Valid := TRUE;\nOutside := FALSE;\nFar := FALSE;\nClipped := FALSE;\n";
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const ProgramReading& reading = program.readings[i];
    // A comparison with what is no number is false.
    text += fmt::format(
        "IF NOT (({0} > -1.0E+300) AND ({0} < 1.0E+300)) THEN Valid := FALSE; "
        "END_IF;\n"
        "IF ({0} < {1}) OR ({0} > {2}) THEN Outside := TRUE; END_IF;\n"
        "IF ({0} < {3}) OR ({0} > {4}) THEN Far := TRUE; END_IF;\n",
        inputs[i],
        RealText(reading.trained_min),
        RealText(reading.trained_max),
        RealText(reading.far_min),
        RealText(reading.far_max));
  }
  if (program.has_memory()) {
    text += "IF NOT (DtSeconds >= 0.0) THEN Valid := FALSE; END_IF;\n";
  }
  return text;
}

}  // namespace

std::vector<ExportedFile> StructuredText(const MapProgram& program,
                                         const std::string& name) {
  const std::vector<std::string> inputs = InputNames(program);
  const StructuredTextLanguage language(name, inputs);
  const auto write = [&](const Instructions& part, const char* indent) {
    return Joined(language.Write(program, part), indent);
  };
  std::string text = Comment(AboutMap(program, name, Precision::kDouble)) +
                     Functions(program, name) +
                     fmt::format("\nFUNCTION_BLOCK {}_map\n", name) +
                     Declarations(program, inputs) + "\n" +
                     Checks(program, inputs) + "IF Valid THEN\n";
  if (program.has_memory()) {
    text += "  IF Start OR NOT Started THEN\n" + write(program.begin, "    ") +
            "    Started := TRUE;\n  ELSE\n" + write(program.advance, "    ") +
            "  END_IF;\n";
    if (!program.zero.empty()) {
      text +=
          "  IF TakeZero THEN\n" + write(program.zero, "    ") + "  END_IF;\n";
    }
  }
  text += write(program.evaluate, "  ");
  text +=
      "  Valid := (Found > -1.0E+300) AND (Found < 1.0E+300);\n"
      "  IF Valid THEN\n"
      "    Error := Found;\n"
      "    Compensation := -Found;\n"
      "  END_IF;\n"
      "END_IF;\n"
      "END_FUNCTION_BLOCK\n";
  return {{name + ".st", text}};
}

}  // namespace errmap::models
