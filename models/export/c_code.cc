#include "models/export/c_code.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "models/export/safe_names.h"
#include "models/history/lag.h"

namespace errmap::models {
namespace {

using Eigen::Index;

// Local arrays, and the parameters s (state) and x (readings).
class CLanguage final : public Language {
 public:
  CLanguage(std::string name, Precision precision)
      : Language(precision), name_(std::move(name)) {}

  std::string Number(double value, bool single) const override {
    return RealText(value, single) + (single ? "F" : "");
  }

 private:
  std::string Assign(const std::string& to,
                     const std::string& value,
                     bool narrows) const override {
    return narrows ? fmt::format("{} = (float)({});", to, value)
                   : fmt::format("{} = {};", to, value);
  }

  std::string Call(Function function,
                   const std::string& argument,
                   bool single) const override {
    const char* end = single ? "f" : "";
    switch (function) {
      case Function::kMeanDecay:
        return fmt::format("{}_mean_decay({})", name_, argument);
      case Function::kSine:
        return fmt::format("sin{}({})", end, argument);
      case Function::kCosine:
        return fmt::format("cos{}({})", end, argument);
      case Function::kSigmoid:
        return fmt::format("{}_sigmoid({})", name_, argument);
    }
    return "";
  }

  Lines Bound(const std::string& condition,
              const std::string& to,
              const std::string& value,
              bool guards) const override {
    Lines lines{fmt::format("if ({}) {{", condition),
                fmt::format("  {} = {};", to, value)};
    if (guards) lines.push_back(fmt::format("  status |= {}_CLIPPED;", name_));
    lines.push_back("}");
    return lines;
  }

  // Input by input, a few outputs side by side: as many sums as registers hold
  // go on at once, each still in the order of the inputs.
  Lines Affine(const Instruction& it,
               const Eigen::MatrixXd& table) const override {
    constexpr int kAtOnce = 8;
    const std::string from = ArrayAt(it.a, "i");
    Lines lines{fmt::format("for (j = 0; j < {}; ++j) {} = {}_bias{}[j];",
                            it.count,
                            ArrayAt(it.to, "j"),
                            name_,
                            it.table)};
    for (int first = 0; first < it.count; first += kAtOnce) {
      lines.push_back(
          fmt::format("for (i = 0; i < {}; ++i) {{", table.cols() - 1));
      for (int row = first; row < std::min(first + kAtOnce, it.count); ++row) {
        lines.push_back(fmt::format("  {} += {}_weights{}[i][{}] * {};",
                                    Place({it.to.space, it.to.index + row}),
                                    name_,
                                    it.table,
                                    row,
                                    from));
      }
      lines.push_back("}");
    }
    return lines;
  }

  Lines Sigmoids(const Instruction& it) const override {
    const std::string to = ArrayAt(it.to, "j");
    return {fmt::format("for (j = 0; j < {}; ++j) {} = {}_sigmoid({});",
                        it.count,
                        to,
                        name_,
                        to)};
  }

  std::string name_;
};

class CWriter {
 public:
  CWriter(const MapProgram& program,
          const std::string& name,
          Precision precision)
      : program_(program),
        name_(name),
        precision_(precision),
        language_(name, precision) {}

  std::string Header() const;
  std::string Source(const std::vector<SelfTestRow>& rows,
                     double tolerance) const;
  std::string Fragment() const;

 private:
  std::string Comment() const;
  std::string Declarations() const;
  std::string Functions() const;
  std::string Real() const { return name_ + "_real"; }
  std::string Number(double value) const {
    return language_.Number(value, precision_ == Precision::kSingle);
  }
  std::string Table(const std::string& declaration,
                    const std::vector<double>& values) const;
  std::string RangeTable(const char* which,
                         double ProgramReading::*bound) const;
  std::string Tables() const;
  std::string Helpers() const;
  std::string CheckFunction() const;
  std::string Locals(const Instructions& part) const;
  std::string EvaluateFunction() const;
  std::string StateFunction(const char* verb, const Instructions& part) const;
  std::string StepFunction() const;
  std::string MemorylessFunction() const;
  std::string SelfTest(const std::vector<SelfTestRow>& rows,
                       double tolerance) const;

  bool Reads(const Instructions& part, Space space) const {
    return std::ranges::any_of(part, [space](const Instruction& it) {
      return it.a.space == space || it.b.space == space;
    });
  }

  const MapProgram& program_;
  const std::string& name_;
  Precision precision_;
  CLanguage language_;
};

std::string CWriter::Comment() const {
  Lines lines = AboutMap(program_, name_, precision_);
  std::string text = "/* " + lines.front() + "\n";
  lines.erase(lines.begin());
  for (const std::string& line : lines) {
    text += line.empty() ? " *\n" : " * " + line + "\n";
  }
  return text + " */\n";
}

constexpr const char* kHeaderHead = R"(#ifndef ERRMAP_{0}_H
#define ERRMAP_{0}_H

#ifdef __cplusplus
extern "C" {{
#endif
)";

constexpr const char* kDeclarations = R"(
typedef {1} {0}_real;

enum {{
  {0}_INPUTS = {2},
  /* Bits of a status; 0: all is well. */
  {0}_OUTSIDE = {3}, /* an input left its trained range: extrapolated */
  {0}_FAR = {4},     /* ... so far that its sensor is to be doubted */
  {0}_CLIPPED = {5}, /* a guard clipped an input or the error */
  {0}_INVALID = {6}  /* an input, a step or the error is no number: no error
                    is given, and the state stays as it was */
}};

/* The status of these inputs; of the bits above all but CLIPPED. */
int {0}_check(const {0}_real inputs[]);
)";

constexpr const char* kHeaderWithMemory = R"(
/* What a session keeps; private. */
typedef struct {{
  double s[{1}];
}} {0}_state;

/* Begins a session: filters in the steady state of these inputs, the zero
 * taken here. The error of this moment is that of a step of 0 s. */
int {0}_init({0}_state *state, const {0}_real inputs[]);

/* Goes on by dt_s seconds to these inputs. Of inputs that failed for a while,
 * leave the steps out and give the time since the last one that was made. */
int {0}_step({0}_state *state, double dt_s, const {0}_real inputs[],
    {0}_real *error);

/* Takes the zero anew, at these inputs. */
int {0}_zero({0}_state *state, const {0}_real inputs[]);
)";

constexpr const char* kHeaderWithoutMemory = R"(
/* The error at these inputs. */
int {0}_error(const {0}_real inputs[], {0}_real *error);
)";

constexpr const char* kHeaderTail = R"(
#ifdef __cplusplus
}
#endif

#endif
)";

std::string CWriter::Declarations() const {
  return fmt::format(kDeclarations,
                     name_,
                     precision_ == Precision::kSingle ? "float" : "double",
                     program_.readings.size(),
                     static_cast<int>(kMapOutside),
                     static_cast<int>(kMapFar),
                     static_cast<int>(kMapClipped),
                     static_cast<int>(kMapInvalid)) +
         (program_.has_memory()
              ? fmt::format(
                    kHeaderWithMemory, name_, program_.size(Space::kState))
              : fmt::format(kHeaderWithoutMemory, name_));
}

std::string CWriter::Header() const {
  return Comment() + fmt::format(kHeaderHead, name_) + Declarations() +
         kHeaderTail;
}

std::string CWriter::Table(const std::string& declaration,
                           const std::vector<double>& values) const {
  std::vector<std::string> numbers;
  for (const double value : values) numbers.push_back(Number(value));
  return declaration + " = {\n" + Joined(Wrapped(numbers, "  "), "") + "};\n";
}

std::string CWriter::RangeTable(const char* which,
                                double ProgramReading::*bound) const {
  std::vector<double> values;
  for (const ProgramReading& reading : program_.readings) {
    values.push_back(reading.*bound);
  }
  return Table(
      fmt::format(
          "static const {} {}_{}[{}_INPUTS]", Real(), name_, which, name_),
      values);
}

// A net's weights by input, then by node.
std::string CWriter::Tables() const {
  std::string text;
  for (std::size_t k = 0; k < program_.tables.size(); ++k) {
    const Eigen::MatrixXd& table = program_.tables[k];
    const Index num_inputs = table.cols() - 1;
    const Eigen::VectorXd bias = table.col(num_inputs);
    text += "\n" + Table(fmt::format("static const {} {}_bias{}[{}]",
                                     Real(),
                                     name_,
                                     k,
                                     table.rows()),
                         {bias.begin(), bias.end()});
    text += fmt::format("static const {} {}_weights{}[{}][{}] = {{\n",
                        Real(),
                        name_,
                        k,
                        num_inputs,
                        table.rows());
    for (Index i = 0; i < num_inputs; ++i) {
      std::vector<std::string> numbers;
      for (const double weight : table.col(i)) {
        numbers.push_back(Number(weight));
      }
      text += "  {\n" + Joined(Wrapped(numbers, "    "), "") +
              (i + 1 < num_inputs ? "  },\n" : "  }\n");
    }
    text += "};\n";
  }
  return text;
}

std::string CWriter::Helpers() const {
  std::string text;
  if (program_.Uses(Op::kMeanDecay)) {
    text += fmt::format(R"(
/* (1 - exp(-u)) / u; of a short step by its series, since the difference would
 * keep no digits. */
static double {0}_mean_decay(double u) {{
  if (u >= {1}) return (1.0 - exp(-u)) / u;
  return {2};
}}
)",
                        name_,
                        RealText(kMeanDecaySeriesBelow),
                        MeanDecaySeries("u"));
  }
  if (program_.Uses(Op::kSigmoid)) {
    const bool single = precision_ == Precision::kSingle;
    text += fmt::format(R"(
static {0}_real {0}_sigmoid({0}_real a) {{
  return {1} / ({1} + {2}(-a));
}}
)",
                        name_,
                        Number(1.0),
                        single ? "expf" : "exp");
  }
  return text;
}

std::string CWriter::CheckFunction() const {
  if (program_.readings.empty()) {
    return fmt::format(R"(
int {0}_check(const {0}_real inputs[]) {{
  (void)inputs;
  return 0;
}}
)",
                       name_);
  }
  return "\n" + RangeTable("trained_min", &ProgramReading::trained_min) +
         RangeTable("trained_max", &ProgramReading::trained_max) +
         RangeTable("far_min", &ProgramReading::far_min) +
         RangeTable("far_max", &ProgramReading::far_max) +
         fmt::format(R"(
int {0}_check(const {0}_real inputs[]) {{
  int status = 0;
  int i;
  for (i = 0; i < {0}_INPUTS; ++i) {{
    const {0}_real x = inputs[i];
    if (!isfinite(x)) return {0}_INVALID;
    if (x < {0}_trained_min[i] || x > {0}_trained_max[i]) {{
      status |= {0}_OUTSIDE;
    }}
    if (x < {0}_far_min[i] || x > {0}_far_max[i]) status |= {0}_FAR;
  }}
  return status;
}}
)",
                     name_);
}

// Declarations of what a part writes.
std::string CWriter::Locals(const Instructions& part) const {
  struct Array {
    Space space;
    const char* name;
  };
  std::string text;
  for (const Array array : {Array{Space::kGain, "g"},
                            Array{Space::kDerived, "v"},
                            Array{Space::kForm, "u"},
                            Array{Space::kScaled, "z"},
                            Array{Space::kHidden, "h"},
                            Array{Space::kTerm, "t"}}) {
    const bool is_written = std::ranges::any_of(
        part,
        [&](const Instruction& it) { return it.to.space == array.space; });
    if (!is_written) continue;
    text += fmt::format("  {} {}[{}];\n",
                        IsAlwaysDouble(array.space) ? "double" : Real(),
                        array.name,
                        program_.size(array.space));
  }
  const auto has = [&](auto is) { return std::ranges::any_of(part, is); };
  if (has([](const Instruction& it) { return it.op == Op::kAffine; })) {
    text += "  int i;\n";
  }
  if (has([](const Instruction& it) {
        return it.op == Op::kAffine || (it.op == Op::kSigmoid && it.count > 1);
      })) {
    text += "  int j;\n";
  }
  return text;
}

std::string CWriter::EvaluateFunction() const {
  std::string text = fmt::format(
      "\nstatic int {0}_evaluate({1}const {0}_real x[],\n"
      "    int status, {0}_real *error) {{\n",
      name_,
      program_.has_memory() ? "const double s[], " : "");
  text += Locals(program_.evaluate) + fmt::format("  {} e;\n", Real());
  if (!Reads(program_.evaluate, Space::kReading)) text += "  (void)x;\n";
  if (program_.has_memory() && !Reads(program_.evaluate, Space::kState)) {
    text += "  (void)s;\n";
  }
  text += Joined(language_.Write(program_, program_.evaluate), "  ");
  return text + fmt::format(
                    "  if (!isfinite(e)) return status | {}_INVALID;\n"
                    "  *error = e;\n"
                    "  return status;\n"
                    "}}\n",
                    name_);
}

// init and zero.
std::string CWriter::StateFunction(const char* verb,
                                   const Instructions& part) const {
  std::string text = fmt::format(
      "\nint {0}_{1}({0}_state *state, const {0}_real inputs[]) {{\n",
      name_,
      verb);
  const bool reads = Reads(part, Space::kReading);
  if (!part.empty()) {
    text += "  double *s = state->s;\n";
    if (reads) text += fmt::format("  const {} *x = inputs;\n", Real());
  }
  text += fmt::format("  const int status = {}_check(inputs);\n", name_);
  text += Locals(part);
  if (part.empty()) text += "  (void)state; /* it has no zero */\n";
  text +=
      fmt::format("  if ((status & {}_INVALID) != 0) return status;\n", name_);
  return text + Joined(language_.Write(program_, part), "  ") +
         "  return status;\n}\n";
}

std::string CWriter::StepFunction() const {
  const Instructions& part = program_.advance;
  std::string text = fmt::format(
      "\nint {0}_step({0}_state *state, double dt_s, const {0}_real inputs[],\n"
      "    {0}_real *error) {{\n",
      name_);
  if (!part.empty()) text += "  double *s = state->s;\n";
  if (Reads(part, Space::kReading)) {
    text += fmt::format("  const {} *x = inputs;\n", Real());
  }
  text += fmt::format("  const int status = {}_check(inputs);\n", name_);
  text += Locals(part);
  text += fmt::format(
      "  if ((status & {0}_INVALID) != 0 || !(dt_s >= 0.0)) {{\n"
      "    return status | {0}_INVALID;\n"
      "  }}\n",
      name_);
  text += Joined(language_.Write(program_, part), "  ");
  return text +
         fmt::format(
             "  return {}_evaluate(state->s, inputs, status, error);\n}}\n",
             name_);
}

std::string CWriter::MemorylessFunction() const {
  return fmt::format(R"(
int {0}_error(const {0}_real inputs[], {0}_real *error) {{
  const int status = {0}_check(inputs);
  if ((status & {0}_INVALID) != 0) return status;
  return {0}_evaluate(inputs, status, error);
}}
)",
                     name_);
}

constexpr const char* kSelfTestMain = R"(
int main(void) {{
  double worst = 0.0;
  int wrong = 0;
  int row;
{2}  for (row = 0; row < {3}; ++row) {{
    const double *expected = {0}_session[row];
    {0}_real inputs[{0}_INPUTS + 1];
    {0}_real error = 0;
    double deviation;
    int status;
    int i;
    for (i = 0; i < {0}_INPUTS; ++i) inputs[i] = ({0}_real)expected[3 + i];
{1}    deviation = fabs((double)error - expected[1]);
    if (!(deviation <= worst)) worst = deviation;
    if (!(deviation <= {4}) || status != (int)expected[2]) {{
      printf("row %d: error %.17g, expected %.17g; status %d, expected %d\n",
             row, (double)error, expected[1], status, (int)expected[2]);
      wrong = 1;
    }}
  }}
  printf("{0}: {3} rows, worst deviation %.2g (%.2g allowed): %s\n", worst,
         {4}, wrong ? "WRONG" : "right");
  return wrong;
}}
#endif
)";

std::string CWriter::SelfTest(const std::vector<SelfTestRow>& rows,
                              double tolerance) const {
  const auto width = program_.readings.size() + 3;
  std::string text = fmt::format(R"(
#ifdef {0}_SELF_TEST
#include <stdio.h>

/* Seconds since the row before, error and status expected, inputs. */
static const double {0}_session[{1}][{2}] = {{
)",
                                 name_,
                                 rows.size(),
                                 width);
  for (const SelfTestRow& row : rows) {
    std::vector<std::string> numbers{RealText(row.dt),
                                     RealText(row.error),
                                     RealText(static_cast<double>(row.status))};
    for (const double reading : row.readings) {
      numbers.push_back(RealText(reading));
    }
    text += "  {\n" + Joined(Wrapped(numbers, "    "), "") + "  },\n";
  }
  text += "};\n";
  const std::string step =
      program_.has_memory()
          ? fmt::format(
                "    if (row == 0) (void){0}_init(&state, inputs);\n"
                "    status = {0}_step(&state, expected[0], inputs, "
                "&error);\n",
                name_)
          : fmt::format("    status = {}_error(inputs, &error);\n", name_);
  return text + fmt::format(kSelfTestMain,
                            name_,
                            step,
                            program_.has_memory()
                                ? fmt::format("  {}_state state;\n", name_)
                                : "",
                            rows.size(),
                            RealText(tolerance));
}

std::string CWriter::Source(const std::vector<SelfTestRow>& rows,
                            double tolerance) const {
  const std::string header = fmt::format("\n#include \"{}.h\"\n", name_);
  std::string text = Comment() + header +
                     fmt::format(R"(
#include <math.h>

/* x inputs, s state, g gains, v derived inputs, u clipped and z scaled inputs,
 * h hidden nodes, t terms, e error. Test: cc -D{0}_SELF_TEST {0}.c -lm */
)",
                                 name_);
  return text + Functions() + SelfTest(rows, tolerance);
}

std::string CWriter::Functions() const {
  const std::string text =
      Tables() + Helpers() + CheckFunction() + EvaluateFunction();
  if (!program_.has_memory()) return text + MemorylessFunction();
  return text + StateFunction("init", program_.begin) + StepFunction() +
         StateFunction("zero", program_.zero);
}

std::string CWriter::Fragment() const {
  return Comment() + Declarations() + Functions();
}

}  // namespace

std::vector<ExportedFile> CCode(const MapProgram& program,
                                const std::string& name,
                                Precision precision,
                                const std::vector<SelfTestRow>& rows,
                                double tolerance) {
  const CWriter writer(program, name, precision);
  return {{name + ".h", writer.Header()},
          {name + ".c", writer.Source(rows, tolerance)}};
}

std::string CFragment(const MapProgram& program, const std::string& name) {
  return CWriter(program, name, Precision::kDouble).Fragment();
}

}  // namespace errmap::models
