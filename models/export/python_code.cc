#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "models/export/program/run_program.h"
#include "models/export/program/safe_names.h"
#include "models/export/program_text.h"
#include "models/history/lag.h"

namespace errmap::models {
namespace {

constexpr Syntax kPython{.conjunction = "and",
                         .disjunction = "or",
                         .negation = "not ",
                         .equal = "==",
                         .absolute = "abs",
                         .when = "if {}:",
                         .otherwise = "else:",
                         .end_when = "",
                         .loop = "for i in range({0}):",
                         .end_loop = "",
                         .index = "i",
                         .indent = "    ",
                         .sine = "math.sin",
                         .cosine = "math.cos",
                         .of_single = ""};

// Lists, named as in C.
class PythonLanguage final : public Language {
 public:
  PythonLanguage() : Language(Precision::kDouble, kPython) {}

  std::string CellName(Cell cell) const override {
    const CellInfo& info = InfoOf(cell);
    switch (info.kind) {
      case CellKind::kKept:
        return fmt::format("self.{}", info.name);
      case CellKind::kTable: {
        std::string name = info.name;
        std::ranges::transform(name, name.begin(), [](char c) {
          return c == '_' ? c : static_cast<char>(c - 'a' + 'A');
        });
        return "_" + name;
      }
      case CellKind::kLocal:
        break;
    }
    return info.name;
  }

  std::string TrainedState(int form, int coordinate) const override {
    return fmt::format("_STATES{}[{}][i]", form, coordinate);
  }

  std::string HasAny(int mask) const override {
    return "status & " + (mask == kMapNotTaken
                              ? std::string("NOT_TAKEN")
                              : "(" + StatusNames(mask, "", " | ") + ")");
  }

 private:
  std::string Flag(int bit) const override {
    return "status |= " + StatusNames(bit, "", "");
  }

  std::string Assign(const std::string& to,
                     const std::string& value,
                     bool /*narrows*/) const override {
    return to + " = " + value;
  }

  std::string Call(const Helper& helper,
                   const std::string& argument) const override {
    return fmt::format("_{}({})", helper.name, argument);
  }

  Lines Affine(const Instruction& it, const MatrixXd& table) const override {
    const std::string to = ArrayAt(it.to, "j");
    return {
        fmt::format("for j in range({}):", it.count),
        fmt::format("    {} = _BIAS{}[j]", to, it.table),
        fmt::format("    for i in range({}):", table.cols() - 1),
        fmt::format("        {} += _WEIGHTS{}[i][j] * {}",
                    to,
                    it.table,
                    ArrayAt(it.a, "i")),
    };
  }

  Lines Sigmoids(const Instruction& it) const override {
    const std::string to = ArrayAt(it.to, "j");
    return {fmt::format("for j in range({}):", it.count),
            fmt::format("    {} = _sigmoid({})", to, to)};
  }
};

constexpr const char* kClass = R"(

def _total(saved):
    """Of all numbers of a saved state, so that a changed one is refused."""
    total = 0.0
    for value in saved.values():
        for number in value if isinstance(value, list) else [value]:
            total += number
    return total


class Map:
    """A session of the map: step() gives the error, within the limits. The
    limits, max_error and max_rate, may be changed; one that is not above
    0, or an error above ten times the map's own, is not heeded: PARAMETER."""

    def __init__(self):
        self.s = [0.0] * {states}
{kept}
    def begin(self):
        """A session begins with the next step taken: filters in the steady
        state of its inputs, the zero taken there. The error goes on from where
        it is. Without it, and without a saved state, SETTLING where the map
        has a memory: for self.settles_in seconds."""
{begin}
    def get_state(self):
        """What a restart needs, as plain lists and numbers."""
        saved = {{name: list(value) if isinstance(value, list) else value
                 for name, value in vars(self).items()}}
        return {{**saved, "map": {fingerprint}, "total": _total(saved)}}

    def set_state(self, saved, age_s):
        """Goes on from it, age_s seconds after: True. Of another map, older
        than {age:g} s or damaged: False, and nothing is changed."""
        mine = vars(self)
        if (set(saved) != {{*mine, "map", "total"}}
                or saved["map"] != {fingerprint}
                or not 0.0 <= age_s <= {age:.1f}):
            return False
        kept = {{name: saved[name] for name in mine}}
        if (any(isinstance(kept[name], list) != isinstance(value, list)
                or isinstance(value, list) and len(kept[name]) != len(value)
                for name, value in mine.items())
                or not math.isfinite(_total(kept))
                or _total(kept) != saved["total"]):
            return False
        limits = self.max_error, self.max_rate
        for name, value in kept.items():
            mine[name] = list(value) if isinstance(value, list) else value
        self.max_error, self.max_rate = limits
        self.waited += age_s
        self.missed += age_s
        self.room += {rate} * age_s
{forgive}        return True

    def zero(self):
        """The next step taken takes the zero again."""
        self.zero_due = 1.0

    def step(self, dt_s, inputs):
        """(error, status), dt_s seconds after the call before, at these
        inputs. Time must go on while inputs fail."""
        status = self.read(dt_s, inputs)
        error, more = self.move(dt_s)
        return error, status | more

    def read(self, dt_s, inputs):
        """Reads inputs that come more slowly than the control's cycle: status.
        dt_s are the seconds since the call of read before."""
        if len(inputs) != len(INPUTS):
            raise ValueError("expected %d inputs" % len(INPUTS))
        x = list(inputs)
        s = self.s
        e = math.nan
        passed = dt_s
        status = 0
{locals}{read}        return status

    def move(self, dt_s):
        """Moves the error, dt_s seconds after the call of move before:
        (error, status)."""
        passed = dt_s
        status = 0
{move}        return self.given, status
)";

// In a self-test, which has readings that are not numbers.
std::string NumberText(double value) {
  if (std::isnan(value)) return "math.nan";
  if (std::isinf(value)) return value > 0.0 ? "math.inf" : "-math.inf";
  return RealText(value);
}

class PythonWriter {
 public:
  PythonWriter(const MapProgram& program, const std::string& name)
      : program_(program), name_(name) {}

  std::string Module(const std::vector<SelfTestRow>& rows,
                     double tolerance) const {
    std::string text =
        "\"\"\"" + Joined(AboutMap(program_, name_, Precision::kDouble), "") +
        "\"\"\"\n\nimport math\n\n";
    text += fmt::format("EXPORT = {:.0f}  # which one this is\n\n",
                        program_.export_id);
    text += "# Bits of a status; 0: all is well.\n";
    for (const StatusBit& bit : StatusBits()) {
      text += fmt::format("{} = {}  # {}\n", bit.name, bit.bit, bit.what);
    }
    text +=
        fmt::format("NOT_TAKEN = {}  # those of a step that is not taken\n\n",
                    kMapNotTaken);
    text += "INPUTS = [\n";
    for (const ProgramReading& reading : program_.readings) {
      text += "    \"" + CommentText(reading.column.name) + "\",\n";
    }
    text += "]\n" + Tables() + Helpers() + MapClass();
    return text + SelfTest(rows, tolerance);
  }

 private:
  std::string List(const std::vector<double>& values,
                   const std::string& indent) const {
    return "[\n" + language_.List(values, indent + "    ") + indent + "]";
  }

  // A list of its columns.
  std::string List(const MatrixXd& matrix) const {
    std::string text = "[\n";
    for (const auto column : matrix.colwise()) {
      text += "    " + List({column.begin(), column.end()}, "    ") + ",\n";
    }
    return text + "]\n";
  }

  std::string Tables() const {
    std::string text;
    for (const ReadingTable& table : kTables) {
      if (!program_.Uses(table.cell)) continue;
      text += fmt::format("{} = {}\n",
                          language_.CellName(table.cell),
                          List(TableValues(program_, table), ""));
    }
    for (std::size_t form = 0; form < program_.forms.size(); ++form) {
      const MatrixXd& states = program_.forms[form].states;
      if (states.size() == 0) continue;
      text += fmt::format("_STATES{} = {}", form, List(states));
    }
    for (std::size_t k = 0; k < program_.tables.size(); ++k) {
      const MatrixXd& table = program_.tables[k];
      const Index num_inputs = table.cols() - 1;
      const VectorXd bias = table.col(num_inputs);
      text += fmt::format("_BIAS{0} = {1}\n_WEIGHTS{0} = {2}",
                          k,
                          List({bias.begin(), bias.end()}, ""),
                          List(table.leftCols(num_inputs)));
    }
    return text;
  }

  std::string Helpers() const {
    std::string text;
    if (program_.Uses(Op::kMeanDecay)) {
      text += fmt::format(R"(

def _mean_decay(u):
    """(1 - exp(-u)) / u; of a short step by its series."""
    if u >= {}:
        return (1.0 - math.exp(-u)) / u
    return {}
)",
                          RealText(kMeanDecaySeriesBelow),
                          MeanDecaySeries("u"));
    }
    if (program_.Uses(Op::kSigmoid)) {
      text += R"(

def _sigmoid(a):
    return 1.0 / (1.0 + math.exp(-a)) if a > -700.0 else 0.0
)";
    }
    return text;
  }

  std::string MapClass() const {
    std::string kept;
    std::string begin;
    for (const CellInfo& cell : KeptCells(program_)) {
      kept += fmt::format("        self.{} = {}\n",
                          cell.name,
                          cell.is_array
                              ? "[0.0] * len(INPUTS)"
                              : RealText(InitialValue(program_, cell.cell)));
      if (IsOfSession(cell.cell)) {
        begin += fmt::format("        self.{} = 0.0\n", cell.name);
      }
    }
    if (program_.zero.empty()) kept += "        self.zero_due = 0.0\n";
    std::string locals;
    for (const LocalArray list : kLocalArrays) {
      if (program_.size(list.space) == 0) continue;
      locals += fmt::format(
          "        {} = [0.0] * {}\n", list.name, program_.size(list.space));
    }
    const auto body = [&](const Routine& routine) {
      return Joined(language_.Write(program_, routine), "        ");
    };
    return fmt::format(
        kClass,
        fmt::arg("begin", begin),
        fmt::arg("fingerprint", RealText(Fingerprint(program_))),
        fmt::arg("age", LongestAge(program_)),
        fmt::arg("rate", RealText(program_.limits.max_rate)),
        fmt::arg(
            "forgive",
            program_.Uses(Cell::kLeapt) ? "        self.leapt = 0.0\n" : ""),
        fmt::arg("states", program_.size(Space::kState)),
        fmt::arg("kept", kept),
        fmt::arg("locals", locals),
        fmt::arg("read", body(program_.read)),
        fmt::arg("move", body(program_.move)));
  }

  std::string SelfTest(const std::vector<SelfTestRow>& rows,
                       double tolerance) const {
    std::string text =
        "\n\n# Seconds since the row before, error and status expected, "
        "inputs.\n_SESSION = [\n";
    for (const SelfTestRow& row : rows) {
      std::vector<std::string> numbers{NumberText(row.dt),
                                       RealText(row.error),
                                       fmt::format("{}", row.status)};
      for (const double reading : row.readings) {
        numbers.push_back(NumberText(reading));
      }
      text += "    [\n" + Joined(Wrapped(numbers, "        "), "") + "    ],\n";
    }
    return text + fmt::format(R"(]


def _self_test():
    worst = 0.0
    wrong = False
    session = Map()
    for dt_s, expected, expected_status, *inputs in _SESSION:
        found, status = session.step(dt_s, inputs)
        deviation = abs(found - expected)
        worst = max(worst, deviation)
        wrong = (wrong or not deviation <= {0} or status != expected_status)
    print("{1}: %d rows, worst deviation %.2g (%.2g allowed): %s"
          % (len(_SESSION), worst, {0}, "WRONG" if wrong else "right"))
    return wrong


if __name__ == "__main__":
    raise SystemExit(_self_test())
)",
                              RealText(tolerance),
                              name_);
  }

  const MapProgram& program_;
  const std::string& name_;
  PythonLanguage language_;
};

}  // namespace

std::vector<ExportedFile> PythonCode(const MapProgram& program,
                                     const std::string& name,
                                     const std::vector<SelfTestRow>& rows,
                                     double tolerance) {
  return {{name + ".py", PythonWriter(program, name).Module(rows, tolerance)}};
}

}  // namespace errmap::models
