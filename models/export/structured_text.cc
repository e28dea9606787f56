#include <algorithm>

#include <fmt/format.h>

#include "models/export/program/run_program.h"
#include "models/export/program/safe_names.h"
#include "models/export/program_text.h"
#include "models/history/lag.h"

namespace errmap::models {
namespace {

constexpr Syntax kStandard{.conjunction = "AND",
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
                           .indent = "  ",
                           .sine = "SIN",
                           .cosine = "COS",
                           .of_single = ""};

// Siemens marks what is local.
constexpr Syntax kScl = [] {
  Syntax syntax = kStandard;
  syntax.loop = "FOR #I := 0 TO {1} DO";
  syntax.index = "#I";
  return syntax;
}();

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

std::string Indented(const std::string& lines) {
  std::string text;
  bool begins = true;
  for (const char c : lines) {
    if (begins) text += "  ";
    text += c;
    begins = c == '\n';
  }
  return text;
}

// Arrays and bits of the status are variables of the block.
class StructuredTextLanguage final : public Language {
 public:
  StructuredTextLanguage(std::string name, Precision precision, TextForm form)
      : Language(precision, form == TextForm::kScl ? kScl : kStandard),
        name_(std::move(name)),
        is_scl_(form == TextForm::kScl) {}

  // A variable of the block at hand.
  std::string Local(const std::string& name) const {
    return is_scl_ ? '#' + name : name;
  }

  // All of a file is single, or nothing.
  std::string Number(double value, bool /*single*/ = false) const override {
    return RealText(value, is_single());
  }

  std::string NameOf(const Helper& helper) const {
    return fmt::format("{}_{}", name_, helper.name);
  }
  bool is_single() const { return precision() == Precision::kSingle; }

  static std::string VariableOf(Cell cell) {
    return cell == Cell::kError ? "Found" : CamelCase(InfoOf(cell).name);
  }

  std::string CellName(Cell cell) const override {
    return Local(VariableOf(cell));
  }

  std::string TrainedState(int form, int coordinate) const override {
    return Local(fmt::format("States{}_{}[{}]", form, coordinate, Local("I")));
  }

  std::string HasAny(int mask) const override {
    std::string names;
    for (const StatusBit& bit : StatusBits()) {
      if ((mask & bit.bit) == 0) continue;
      names += (names.empty() ? "" : " OR ") + Local(BitName(bit));
    }
    return names;
  }

 private:
  std::string Place(Operand operand) const override {
    if (operand.space == Space::kError) return CellName(Cell::kError);
    std::string place = Language::Place(operand);
    if (operand.space != Space::kTime) {
      place.front() = static_cast<char>(place.front() - 'a' + 'A');
      place = Local(place);
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

  std::string Call(const Helper& helper,
                   const std::string& argument) const override {
    const char* quote = is_scl_ ? "\"" : "";
    return fmt::format("{0}{1}{0}({2} := {3})",
                       quote,
                       NameOf(helper),
                       helper.argument,
                       argument);
  }

  // A slow filter would stop in single precision: the part of a step below the
  // last digit of its state is kept (Kahan 1965).
  Lines Grow(Operand to, const std::string& by, bool narrows) const override {
    if (!is_single() || to.space != Space::kState) {
      return Language::Grow(to, by, narrows);
    }
    const std::string state = Place(to);
    const std::string added = Local("Added");
    const std::string sum = Local("Sum");
    return {
        Assign(added, by + " - " + Lost(to), false),
        Assign(sum, state + " + " + added, false),
        Assign(
            Lost(to), fmt::format("({} - {}) - {}", sum, state, added), false),
        Assign(state, sum, false)};
  }

  Lines Set(Operand to, const std::string& value, bool narrows) const override {
    Lines lines = Language::Set(to, value, narrows);
    if (is_single() && to.space == Space::kState) {
      lines.push_back(Assign(Lost(to), "0.0", false));
    }
    return lines;
  }

  std::string Lost(Operand state) const {
    return fmt::format("{}[{}]", Local("Lost"), state.index);
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
  Lines Affine(const Instruction& it, const MatrixXd& table) const override {
    constexpr Index kProductsPerLine = 3;
    Lines lines;
    const Index num_inputs = table.cols() - 1;
    for (int row = 0; row < it.count; ++row) {
      const std::string to = Place({it.to.space, it.to.index + row});
      lines.push_back(Assign(to, Number(table(row, num_inputs)), false));
      for (Index first = 0; first < num_inputs; first += kProductsPerLine) {
        std::string sum = to;
        for (Index i = first;
             i < std::min(first + kProductsPerLine, num_inputs);
             ++i) {
          sum += fmt::format(
              " + ({}) * {}",
              Number(table(row, i)),
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
      lines.push_back(Assign(to, Call(kSigmoidHelper, to), false));
    }
    return lines;
  }

  std::string name_;
  bool is_scl_;
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

using Type = TextVariable::Type;

std::vector<TextFunction> Functions(const MapProgram& program,
                                    const StructuredTextLanguage& language) {
  std::vector<TextFunction> functions;
  const auto add = [&](const Helper& helper,
                       const char* comment,
                       const std::string& condition,
                       const std::string& value,
                       const std::string& otherwise) {
    const std::string name = language.NameOf(helper);
    functions.push_back(
        {.name = name,
         .argument = helper.argument,
         .comment = comment,
         .body = fmt::format("IF {1} THEN\n  {0} := {2};\nELSE\n"
                             "  {0} := {3};\nEND_IF;\n",
                             language.Local(name),
                             condition,
                             value,
                             otherwise)});
  };
  if (program.Uses(Op::kMeanDecay)) {
    const std::string u = language.Local("U");
    add(kMeanDecayHelper,
        "(1 - exp(-U)) / U; of a short step by its series, since the "
        "difference would\n   keep no digits.",
        u + " >= " + language.Number(kMeanDecaySeriesBelow),
        fmt::format("(1.0 - EXP(-{0})) / {0}", u),
        MeanDecaySeries(u));
  }
  if (program.Uses(Op::kSigmoid)) {
    const std::string a = language.Local("A");
    // What EXP can take.
    add(kSigmoidHelper,
        "",
        a + (language.is_single() ? " > -80.0" : " > -700.0"),
        fmt::format("1.0 / (1.0 + EXP(-{}))", a),
        "0.0");
  }
  return functions;
}

// Constants of the readings, and the trained states.
void AddTables(const MapProgram& program,
               const StructuredTextLanguage& language,
               std::vector<TextVariable>* variables) {
  const auto add = [&](const std::string& name, std::vector<double> values) {
    const auto size = static_cast<int>(values.size());
    variables->push_back(
        {.name = name, .size = size, .initial = std::move(values)});
  };
  for (const ReadingTable& table : kTables) {
    if (!program.Uses(table.cell)) continue;
    add(language.VariableOf(table.cell), TableValues(program, table));
  }
  for (std::size_t form = 0; form < program.forms.size(); ++form) {
    const MatrixXd& states = program.forms[form].states;
    for (Index k = 0; k < states.cols(); ++k) {
      add(fmt::format("States{}_{}", form, k),
          {states.col(k).begin(), states.col(k).end()});
    }
  }
}

std::vector<TextVariable> Inputs(const MapProgram& program,
                                 const std::vector<std::string>& names) {
  std::vector<TextVariable> inputs{
      {.name = "Start",
       .type = Type::kBool,
       .comment = "rising edge: a session begins with the next step taken, "
                  "filters in their steady state, the zero taken"},
      {.name = "TakeZero",
       .type = Type::kBool,
       .comment = "rising edge: the next step taken takes the zero again"},
      {.name = "DtSeconds", .comment = "since the call before"},
      {.name = "AwaySeconds",
       .initial = {1e30},
       .comment = "in the first call after a restart: how long it was; from an "
                  "hour on it starts again"}};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const data::ColumnInfo& column = program.readings[i].column;
    const std::string unit = CommentText(column.unit.symbol);
    inputs.push_back({.name = names[i],
                      .comment = CommentText(column.name) +
                                 (unit.empty() ? "" : ", " + unit)});
  }
  inputs.push_back({.name = "MaxError",
                    .initial = {program.limits.max_error},
                    .comment = "limits; not heeded unless above 0, nor above "
                               "ten times this error"});
  inputs.push_back({.name = "MaxRate", .initial = {program.limits.max_rate}});
  return inputs;
}

// The limits, which the block's caller may set.
bool IsInput(Cell cell) {
  return cell == Cell::kMostError || cell == Cell::kMostRate;
}

std::vector<TextVariable> Outputs(const MapProgram& program) {
  std::vector<TextVariable> outputs{
      {.name = "Error", .comment = "within the limits"},
      {.name = "Compensation", .comment = "-Error"},
      {.name = "Valid", .type = Type::kBool, .comment = "the step was taken"},
      {.name = "Healthy",
       .type = Type::kBool,
       .comment = "FALSE: the control must not go on with it; wire this one"},
      {.name = "MapExport",
       .initial = {program.export_id},
       .comment = "which export this is"}};
  if (program.Uses(Cell::kSettling)) {
    outputs.push_back({.name = "Settles",
                       .comment = "s until what filters remember is good"});
  }
  for (const StatusBit& bit : StatusBits()) {
    outputs.push_back(
        {.name = BitName(bit), .type = Type::kBool, .comment = bit.what});
  }
  return outputs;
}

void AddArray(const std::string& name,
              int size,
              std::vector<TextVariable>* variables) {
  if (size > 0) variables->push_back({.name = name, .size = size});
}

// What is computed anew in each call. Over a warm restart `Running` is lost,
// but what is retained is not.
std::vector<TextVariable> Locals(const MapProgram& program,
                                 const StructuredTextLanguage& language) {
  std::vector<TextVariable> locals;
  AddTables(program, language, &locals);
  AddArray("X", program.size(Space::kReading), &locals);
  for (const LocalArray local : kLocalArrays) {
    AddArray({static_cast<char>(local.name - 'a' + 'A')},
             program.size(local.space),
             &locals);
  }
  for (const Cell cell : {Cell::kDt,
                          Cell::kCommon,
                          Cell::kAway,
                          Cell::kTarget,
                          Cell::kBound,
                          Cell::kPace,
                          Cell::kChanged,
                          Cell::kError}) {
    if (program.Uses(cell) || cell == Cell::kError) {
      locals.push_back({.name = language.VariableOf(cell)});
    }
  }
  if (language.is_single() && program.has_memory()) {
    for (const char* name : {"Added", "Sum"}) locals.push_back({.name = name});
  }
  if (!program.readings.empty()) {
    locals.push_back({.name = "I", .type = Type::kInt});
  }
  locals.push_back({.name = "Total"});
  for (const char* name : {"Running", "Started", "ZeroTaken"}) {
    locals.push_back({.name = name, .type = Type::kBool});
  }
  return locals;
}

std::vector<TextVariable> Retained(const MapProgram& program,
                                   const StructuredTextLanguage& language) {
  std::vector<TextVariable> retained{{.name = "OfMap"}, {.name = "Check"}};
  AddArray("S", program.size(Space::kState), &retained);
  if (language.is_single()) {
    AddArray("Lost", program.size(Space::kState), &retained);
  }
  for (const CellInfo& cell : KeptCells(program)) {
    if (IsInput(cell.cell)) continue;
    retained.push_back(
        {.name = language.VariableOf(cell.cell),
         .size = cell.is_array ? program.size(Space::kReading) : 0});
  }
  return retained;
}

// The sum of what is retained, in Total: a changed number is found by it.
std::string AddUp(const MapProgram& program,
                  const StructuredTextLanguage& language) {
  const std::string total = language.Local("Total");
  const std::string index = language.Local("I");
  std::string text = total + " := 0.0;\n";
  std::vector<std::string> of_readings;
  for (const CellInfo& cell : KeptCells(program)) {
    if (IsInput(cell.cell)) continue;
    const std::string name = language.CellName(cell.cell);
    if (cell.is_array) {
      of_readings.push_back(name);
    } else {
      text += fmt::format("{0} := {0} + {1};\n", total, name);
    }
  }
  const auto loop = [&](int size, const std::vector<std::string>& arrays) {
    if (size == 0 || arrays.empty()) return;
    text += fmt::format("FOR {} := 0 TO {} DO\n", index, size - 1);
    for (const std::string& array : arrays) {
      text += fmt::format("  {0} := {0} + {1}[{2}];\n", total, array, index);
    }
    text += "END_FOR;\n";
  };
  loop(program.size(Space::kReading), of_readings);
  loop(program.size(Space::kState),
       language.is_single()
           ? std::vector{language.Local("S"), language.Local("Lost")}
           : std::vector{language.Local("S")});
  return text;
}

// What stands before the routines.
std::string Prelude(const MapProgram& program,
                    const std::vector<std::string>& inputs,
                    const StructuredTextLanguage& language) {
  const auto local = [&](const char* name) { return language.Local(name); };
  std::string text;
  std::string anew;
  std::string session;
  for (const CellInfo& cell : KeptCells(program)) {
    if (IsInput(cell.cell) || cell.is_array) continue;
    const std::string name = language.CellName(cell.cell);
    anew += fmt::format("    {} := {};\n",
                        name,
                        language.Number(InitialValue(program, cell.cell)));
    if (IsOfSession(cell.cell)) session += fmt::format("  {} := 0.0;\n", name);
  }
  text += fmt::format(
      R"(IF NOT {running} THEN
{add_up}  {running} := TRUE;
  IF {of_map} = {fingerprint} AND {total} - {check} = 0.0 AND
     {away} >= 0.0 AND {away} <= {longest} THEN
    {waited} := {waited} + {away};
    {missed} := {missed} + {away};
    {room} := {room} + {rate} * {away};
{forgive}  ELSE
    {of_map} := {fingerprint};
{anew}  END_IF;
END_IF;
)",
      fmt::arg("running", local("Running")),
      fmt::arg("add_up", Indented(AddUp(program, language))),
      fmt::arg("total", local("Total")),
      fmt::arg("check", local("Check")),
      fmt::arg("of_map", local("OfMap")),
      fmt::arg("fingerprint", language.Number(Fingerprint(program))),
      fmt::arg("away", local("AwaySeconds")),
      fmt::arg("longest", language.Number(LongestAge(program))),
      fmt::arg("waited", local("Waited")),
      fmt::arg("missed", local("Missed")),
      fmt::arg("room", local("Room")),
      fmt::arg("rate", language.Number(program.limits.max_rate)),
      fmt::arg("forgive",
               program.Uses(Cell::kLeapt)
                   ? fmt::format("    {} := 0.0;\n", local("Leapt"))
                   : ""),
      fmt::arg("anew", anew));
  for (const StatusBit& bit : StatusBits()) {
    text += language.Local(BitName(bit)) + " := FALSE;\n";
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    text += fmt::format(
        "{}[{}] := {};\n", local("X"), i, language.Local(inputs[i]));
  }
  text += fmt::format("{} := {};\n", local("Passed"), local("DtSeconds"));
  const auto on_edge = [&](const char* input,
                           const char* before,
                           const std::string& body) {
    text += fmt::format("IF {0} AND NOT {1} THEN\n{2}END_IF;\n{1} := {0};\n",
                        local(input),
                        local(before),
                        body);
  };
  on_edge("Start", "Started", session);
  if (!program.zero.empty()) {
    on_edge("TakeZero",
            "ZeroTaken",
            fmt::format("  {} := 1.0;\n", local("ZeroDue")));
  }
  return text;
}

std::string Body(const MapProgram& program,
                 const std::vector<std::string>& inputs,
                 const StructuredTextLanguage& language) {
  const auto assign = [&](const char* to, const std::string& value) {
    return language.Local(to) + " := " + value + ";\n";
  };
  const std::string given = language.Local("Given");
  return Prelude(program, inputs, language) +
         Joined(language.Write(program, program.read), "") +
         Joined(language.Write(program, program.move), "") +
         assign("Error", given) + assign("Compensation", "-" + given) +
         assign("Valid", "NOT (" + language.HasAny(kMapNotTaken) + ")") +
         assign("Healthy", "NOT " + language.HasAny(kMapUnhealthy)) +
         AddUp(program, language) + assign("Check", language.Local("Total")) +
         (program.Uses(Cell::kSettling)
              ? assign("Settles", language.Local("SettlesIn"))
              : "");
}

Lines About(const MapProgram& program,
            const std::string& name,
            Precision precision,
            TextForm form) {
  Lines about = AboutMap(program, name, Precision::kDouble);
  if (form == TextForm::kScl) {
    about.push_back(
        "The same text as NAME.st; TIA Portal itself has not compiled it.");
  }
  if (precision == Precision::kSingle) {
    about.insert(
        about.end(),
        {"Single precision; what a slow filter would lose of a step is "
         "kept beside it.",
         "Call it at most a hundred times each second."});
  }
  return about;
}

}  // namespace

ExportedFile StructuredText(const MapProgram& program,
                            const std::string& name,
                            Precision precision,
                            TextForm form) {
  using Kind = TextSection::Kind;
  const std::vector<std::string> inputs = InputNames(program);
  const StructuredTextLanguage language(name, precision, form);
  return TextFile({.name = name + "_map",
                   .precision = precision,
                   .about = About(program, name, precision, form),
                   .functions = Functions(program, language),
                   .sections = {{Kind::kInput, Inputs(program, inputs)},
                                {Kind::kOutput, Outputs(program)},
                                {Kind::kLocal, Locals(program, language)},
                                {Kind::kRetained, Retained(program, language)}},
                   .body = Body(program, inputs, language)},
                  name,
                  form);
}

}  // namespace errmap::models
