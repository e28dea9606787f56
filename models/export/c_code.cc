#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "models/export/program/controller.h"
#include "models/export/program/run_program.h"
#include "models/export/program/safe_names.h"
#include "models/export/program_text.h"
#include "models/history/lag.h"

namespace errmap::models {
namespace {

constexpr Syntax kC{.conjunction = "&&",
                    .disjunction = "||",
                    .negation = "!",
                    .equal = "==",
                    .absolute = "fabs",
                    .when = "if ({}) {{",
                    .otherwise = "} else {",
                    .end_when = "}",
                    .loop = "for (i = 0; i < {0}; ++i) {{",
                    .end_loop = "}",
                    .index = "i",
                    .indent = "  ",
                    .sine = "sin",
                    .cosine = "cos",
                    .of_single = "f"};

// Local arrays, a pointer to the state, and tables and functions whose names
// begin with that of the map.
class CLanguage final : public Language {
 public:
  CLanguage(std::string name, Precision precision)
      : Language(precision, kC), name_(std::move(name)) {}

  std::string CellName(Cell cell) const override {
    const CellInfo& info = InfoOf(cell);
    const std::string before = info.kind == CellKind::kKept    ? "state->"
                               : info.kind == CellKind::kTable ? name_ + "_"
                                                               : "";
    return before + info.name;
  }

  std::string Number(double value, bool single) const override {
    return RealText(value, single) + (single ? "F" : "");
  }

  std::string TrainedState(int form, int coordinate) const override {
    return fmt::format("{}_states{}[{}][i]", name_, form, coordinate);
  }

  std::string HasAny(int mask) const override {
    return fmt::format("status & {}",
                       mask == kMapNotTaken
                           ? name_ + "_NOT_TAKEN"
                           : "(" + StatusNames(mask, name_ + "_", " | ") + ")");
  }

 private:
  std::string Flag(int bit) const override {
    return fmt::format("status |= {};", StatusNames(bit, name_ + "_", ""));
  }

  std::string Assign(const std::string& to,
                     const std::string& value,
                     bool narrows) const override {
    return narrows ? fmt::format("{} = (float)({});", to, value)
                   : fmt::format("{} = {};", to, value);
  }

  std::string Call(const Helper& helper,
                   const std::string& argument) const override {
    return fmt::format("{}_{}({})", name_, helper.name, argument);
  }

  // Input by input, a few outputs side by side: as many sums as registers hold
  // go on at once, each still in the order of the inputs.
  Lines Affine(const Instruction& it, const MatrixXd& table) const override {
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

constexpr const char* kHeaderHead = R"(#ifndef ERRMAP_{0}_H
#define ERRMAP_{0}_H

#ifdef __cplusplus
extern "C" {{
#endif
)";

constexpr const char* kDeclarations = R"(
/* Which export this is. */
#define {0}_EXPORT {9:.0f}

typedef {1} {0}_real;

enum {{
  {0}_INPUTS = {2},
  {0}_SAVED = {6}, /* numbers of a saved state */
  /* Bits of a status; 0: all is well. */
{3}  {0}_NOT_TAKEN = {4} /* those of a step that is not taken */
}};

/* All that is kept from step to step; without a pointer, so that it may be
 * copied. The limits may be changed after {0}_init; one that is not above 0,
 * or an error above ten times the map's own, is not heeded: PARAMETER. */
typedef struct {{
{5}}} {0}_state;

/* Before all else. The error given begins at 0. */
void {0}_init({0}_state *state);

/* A session begins with the next step taken: filters in the steady state of its
 * inputs, the zero taken there.{8} */
void {0}_begin({0}_state *state);

/* What a restart needs, and how to go on from it age_s seconds after: 0. Of
 * another map, older than {7:g} s or damaged: -1, and nothing is changed. */
void {0}_get_state(const {0}_state *state, double saved[]);
int {0}_set_state({0}_state *state, const double saved[], double age_s);

/* The next step taken takes the zero again. */
void {0}_zero({0}_state *state);

/* dt_s seconds after the call before: the error at these inputs, within the
 * limits, and the status. Time must go on while inputs fail. */
int {0}_step({0}_state *state, double dt_s, const {0}_real inputs[],
    {0}_real *error);

/* The same in two, for inputs that come more slowly than the control's cycle:
 * reads, with the seconds since the call of {0}_read before; moves the error
 * given, with those since the call of {0}_move before. */
int {0}_read({0}_state *state, double dt_s, const {0}_real inputs[]);
int {0}_move({0}_state *state, double dt_s, {0}_real *error);
)";

constexpr const char* kHeaderTail = R"(
#ifdef __cplusplus
}
#endif

#endif
)";

constexpr const char* kSelfTestMain = R"(
int main(void) {{
  double worst = 0.0;
  int wrong = 0;
  int row;
  {0}_state state;
  {0}_init(&state);
  for (row = 0; row < {1}; ++row) {{
    const double *expected = {0}_session[row];
    {0}_real inputs[{0}_INPUTS + 1];
    {0}_real error = 0;
    double deviation;
    int status;
    int i;
    for (i = 0; i < {0}_INPUTS; ++i) inputs[i] = ({0}_real)expected[3 + i];
    status = {0}_step(&state, expected[0], inputs, &error);
    deviation = fabs((double)error - expected[1]);
    if (!(deviation <= worst)) worst = deviation;
    if (!(deviation <= {2}) || status != (int)expected[2]) {{
      printf("row %d: error %.17g, expected %.17g; status %d, expected %d\n",
             row, (double)error, expected[1], status, (int)expected[2]);
      wrong = 1;
    }}
  }}
  printf("{0}: {1} rows, worst deviation %.2g (%.2g allowed): %s\n", worst,
         {2}, wrong ? "WRONG" : "right");
  return wrong;
}}
#endif
)";

// In a self-test, which has readings that are not numbers.
std::string AnyNumber(double value) {
  if (std::isnan(value)) return "NAN";
  if (std::isinf(value)) return value > 0.0 ? "INFINITY" : "-INFINITY";
  return RealText(value);
}

class CWriter {
 public:
  CWriter(const MapProgram& program,
          const std::string& name,
          Precision precision)
      : program_(program),
        name_(name),
        precision_(precision),
        language_(name, precision) {}

  std::string Header() const {
    return Comment() + fmt::format(kHeaderHead, name_) + Declarations() +
           kHeaderTail;
  }

  std::string Source(const std::vector<SelfTestRow>& rows,
                     double tolerance) const {
    const std::string header = fmt::format("\n#include \"{}.h\"\n", name_);
    std::string text = Comment() + header +
                       fmt::format(R"(
#if {0}_EXPORT != {1:.0f}
#error "{0}.h and {0}.c are from two exports: export both again"
#endif

#include <math.h>

/* x inputs, s filters and zeros, g gains, v derived inputs, u clipped and z
 * scaled inputs, h hidden nodes, t terms, e error; p sensors less their means,
 * q scores, r doubts. Test: cc -D{0}_SELF_TEST {0}.c -lm */
)",
                                   name_,
                                   program_.export_id);
    return text + Functions() + SelfTest(rows, tolerance);
  }

  std::string Fragment() const {
    return Comment() + Declarations() + Functions();
  }

 private:
  std::string Comment() const {
    Lines lines = AboutMap(program_, name_, precision_);
    std::string text = "/* " + lines.front() + "\n";
    lines.erase(lines.begin());
    for (const std::string& line : lines) {
      text += line.empty() ? " *\n" : " * " + line + "\n";
    }
    return text + " */\n";
  }

  std::string Declarations() const {
    std::string bits;
    for (const StatusBit& bit : StatusBits()) {
      bits += fmt::format(
          "  {}_{} = {}, /* {} */\n", name_, bit.name, bit.bit, bit.what);
    }
    std::string kept;
    if (program_.has_memory()) {
      kept += fmt::format("  double s[{}];\n", program_.size(Space::kState));
    }
    for (const CellInfo& cell : KeptCells(program_)) {
      kept += cell.is_array
                  ? fmt::format("  double {}[{}_INPUTS];\n", cell.name, name_)
                  : fmt::format("  double {};\n", cell.name);
    }
    return fmt::format(
        kDeclarations,
        name_,
        precision_ == Precision::kSingle ? "float" : "double",
        program_.readings.size(),
        bits,
        kMapNotTaken,
        kept,
        NumSaved(program_),
        LongestAge(program_),
        program_.settles_after > 0.0
            ? " Without it, and without a saved\n * state, one may "
              "have begun before: SETTLING, for\n * "
              "state->settles_in seconds."
            : "",
        program_.export_id);
  }

  std::string Functions() const {
    return Tables() + CellTables() + Helpers() + StateFunctions() +
           ReadFunction() + MoveFunction();
  }

  std::string Real() const { return name_ + "_real"; }
  // Constants of the readings, always double.
  std::string CellTables() const {
    std::string text;
    for (const ReadingTable& table : kTables) {
      if (!program_.Uses(table.cell)) continue;
      text += fmt::format("\nstatic const double {}[{}_INPUTS] = {{\n{}}};\n",
                          language_.CellName(table.cell),
                          name_,
                          language_.List(TableValues(program_, table), "  "));
    }
    return text;
  }

  // A net's weights by input, then by node.
  std::string Tables() const {
    std::string text;
    for (std::size_t form = 0; form < program_.forms.size(); ++form) {
      const MatrixXd& states = program_.forms[form].states;
      if (states.size() == 0) continue;
      text += fmt::format("\nstatic const double {}_states{}[{}][{}] = {{\n",
                          name_,
                          form,
                          states.cols(),
                          states.rows());
      for (const auto coordinate : states.colwise()) {
        text += "  {\n" +
                language_.List({coordinate.begin(), coordinate.end()}, "    ") +
                "  },\n";
      }
      text += "};\n";
    }
    for (std::size_t k = 0; k < program_.tables.size(); ++k) {
      const MatrixXd& table = program_.tables[k];
      const bool single =
          precision_ == Precision::kSingle && !program_.IsTableDouble(k);
      const auto list = [&](Index column, const std::string& indent) {
        const auto values = table.col(column);
        return language_.List({values.begin(), values.end()}, indent, single);
      };
      const Index num_inputs = table.cols() - 1;
      text += fmt::format(
          "\nstatic const {0} {1}_bias{2}[{3}] = {{\n{4}}};\n"
          "static const {0} {1}_weights{2}[{5}][{3}] = {{\n",
          single ? "float" : "double",
          name_,
          k,
          table.rows(),
          list(num_inputs, "  "),
          num_inputs);
      for (Index i = 0; i < num_inputs; ++i) {
        text += "  {\n" + list(i, "    ") +
                (i + 1 < num_inputs ? "  },\n" : "  }\n");
      }
      text += "};\n";
    }
    return text;
  }

  std::string Helpers() const {
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
                          language_.Number(1.0, single),
                          single ? "expf" : "exp");
    }
    return text;
  }

  // Declarations of what the parts write.
  std::string Locals(const std::vector<const Instructions*>& parts) const {
    const auto has = [&](auto is) {
      return std::ranges::any_of(parts, [is](const Instructions* part) {
        return std::ranges::any_of(*part, is);
      });
    };
    std::string text;
    for (const LocalArray array : kLocalArrays) {
      if (!has([&](const Instruction& it) {
            return it.to.space == array.space;
          })) {
        continue;
      }
      // Written and read in blocks of one condition, which compilers do not
      // see.
      const bool in_blocks = array.space == Space::kStanding;
      text += fmt::format("  {} {}[{}]{};\n",
                          IsAlwaysDouble(array.space) ? "double" : Real(),
                          array.name,
                          program_.size(array.space),
                          in_blocks ? " = {0.0}" : "");
    }
    if (has([](const Instruction& it) {
          return it.op == Op::kAffine ||
                 (it.op == Op::kSigmoid && it.count > 1);
        })) {
      text += "  int j;\n";
    }
    return text;
  }

  std::string StateFunctions() const {
    std::string text = fmt::format(
        R"(
void {0}_init({0}_state *state) {{
  const {0}_state empty = {{0}};
  *state = empty;
{1}}}

void {0}_begin({0}_state *state) {{
{2}}}

/* Of what is kept; volatile, so that every machine rounds it alike. */
static double {0}_total(const double saved[]) {{
  volatile double total = 0.0;
  int i;
  for (i = 1; i < {0}_SAVED - 1; ++i) total += saved[i];
  return total;
}}

void {0}_get_state(const {0}_state *state, double saved[]) {{
  const double *from = (const double *)state; /* it has nothing but doubles */
  int i;
  saved[0] = {3};
  for (i = 1; i < {0}_SAVED - 1; ++i) saved[i] = from[i - 1];
  saved[{0}_SAVED - 1] = {0}_total(saved);
}}

int {0}_set_state({0}_state *state, const double saved[], double age_s) {{
  double *to = (double *)state;
  const double max_error = state->max_error;
  const double max_rate = state->max_rate;
  int i;
  if (saved[0] != {3} || !(age_s >= 0.0 && age_s <= {4})) return -1;
  /* The sum of what is not a number is none, too. */
  if (!({0}_total(saved) - saved[{0}_SAVED - 1] == 0.0)) return -1;
  for (i = 1; i < {0}_SAVED - 1; ++i) to[i - 1] = saved[i];
  state->max_error = max_error;
  state->max_rate = max_rate;
  state->waited += age_s;
  state->missed += age_s;
  state->room += {5} * age_s;
{6}  return 0;
}}
)",
        name_,
        SetCells(false),
        SetCells(true),
        RealText(Fingerprint(program_)),
        RealText(LongestAge(program_)),
        RealText(program_.limits.max_rate),
        program_.Uses(Cell::kLeapt) ? "  state->leapt = 0.0;\n" : "");
    return text + fmt::format(R"(
void {0}_zero({0}_state *state) {{
  {1}
}}
)",
                              name_,
                              program_.zero.empty()
                                  ? "(void)state; /* it has no zero */"
                                  : "state->zero_due = 1.0;");
  }

  // Those of the cells that a session begins with, or that do not begin as 0.
  std::string SetCells(bool of_session) const {
    std::string text;
    for (const CellInfo& cell : KeptCells(program_)) {
      const double value = of_session ? 0.0 : InitialValue(program_, cell.cell);
      if (of_session ? !IsOfSession(cell.cell) : value == 0.0) continue;
      text += fmt::format("  state->{} = {};\n", cell.name, RealText(value));
    }
    return text;
  }

  std::string ReadFunction() const {
    const bool reads = !program_.readings.empty();
    std::string text = fmt::format(
        "\nint {0}_read({0}_state *state, double dt_s, const {0}_real "
        "inputs[]) "
        "{{\n",
        name_);
    if (program_.has_memory()) text += "  double *s = state->s;\n";
    if (reads) text += fmt::format("  {} x[{}_INPUTS];\n", Real(), name_);
    const auto parts = program_.parts();
    text += Locals({parts.begin(), parts.end()}) +
            fmt::format("  {} e;\n  double passed = dt_s;\n", Real());
    for (const Cell cell : {Cell::kCommon, Cell::kAway, Cell::kChanged}) {
      if (!program_.Uses(cell)) continue;
      text += fmt::format("  double {};\n", InfoOf(cell).name);
    }
    text += "  int status = 0;\n";
    text += reads ? fmt::format(
                        "  int i;\n  for (i = 0; i < {}_INPUTS; ++i) "
                        "x[i] = inputs[i];\n",
                        name_)
                  : "  (void)inputs;\n";
    return text + Joined(language_.Write(program_, program_.read), "  ") +
           "  return status;\n}\n";
  }

  std::string MoveFunction() const {
    return fmt::format(R"(
int {0}_move({0}_state *state, double dt_s, {0}_real *error) {{
  double passed = dt_s;
  double target;
  double bound;
  double pace;
  int status = 0;
{1}  *error = {2}state->given;
  return status;
}}

int {0}_step({0}_state *state, double dt_s, const {0}_real inputs[],
    {0}_real *error) {{
  const int status = {0}_read(state, dt_s, inputs);
  return status | {0}_move(state, dt_s, error);
}}
)",
                       name_,
                       Joined(language_.Write(program_, program_.move), "  "),
                       precision_ == Precision::kSingle ? "(float)" : "");
  }

  std::string SelfTest(const std::vector<SelfTestRow>& rows,
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
      std::vector<std::string> numbers{
          AnyNumber(row.dt),
          RealText(row.error),
          RealText(static_cast<double>(row.status))};
      for (const double reading : row.readings) {
        numbers.push_back(AnyNumber(reading));
      }
      text += "  {\n" + Joined(Wrapped(numbers, "    "), "") + "  },\n";
    }
    text += "};\n";
    return text +
           fmt::format(kSelfTestMain, name_, rows.size(), RealText(tolerance));
  }

  const MapProgram& program_;
  const std::string& name_;
  Precision precision_;
  CLanguage language_;
};

}  // namespace

std::vector<ExportedFile> CCode(const MapProgram& program,
                                const std::string& name,
                                Precision precision,
                                const std::vector<SelfTestRow>& rows,
                                double tolerance) {
  const CWriter writer(program, name, precision);
  // A source that is newer than its header does not compile, also where the
  // older one is of a version that did not look.
  return {{name + ".c", writer.Source(rows, tolerance)},
          {name + ".h", writer.Header()}};
}

std::string CFragment(const MapProgram& program, const std::string& name) {
  return CWriter(program, name, Precision::kDouble).Fragment();
}

}  // namespace errmap::models
