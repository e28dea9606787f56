#include "models/export/python_code.h"

#include <algorithm>

#include <fmt/format.h>

#include "models/export/safe_names.h"
#include "models/history/lag.h"

namespace errmap::models {
namespace {

using Eigen::Index;

// Lists, named as in C.
class PythonLanguage final : public Language {
 public:
  PythonLanguage() : Language(Precision::kDouble) {}

 private:
  std::string Assign(const std::string& to,
                     const std::string& value,
                     bool /*narrows*/) const override {
    return to + " = " + value;
  }

  std::string Call(Function function,
                   const std::string& argument,
                   bool /*single*/) const override {
    switch (function) {
      case Function::kMeanDecay:
        return "_mean_decay(" + argument + ")";
      case Function::kSine:
        return "math.sin(" + argument + ")";
      case Function::kCosine:
        return "math.cos(" + argument + ")";
      case Function::kSigmoid:
        return "_sigmoid(" + argument + ")";
    }
    return "";
  }

  Lines Bound(const std::string& condition,
              const std::string& to,
              const std::string& value,
              bool guards) const override {
    Lines lines{"if " + condition + ":", "    " + to + " = " + value};
    if (guards) lines.push_back("    status |= CLIPPED");
    return lines;
  }

  Lines Affine(const Instruction& it,
               const Eigen::MatrixXd& table) const override {
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

class PythonWriter {
 public:
  PythonWriter(const MapProgram& program, const std::string& name)
      : program_(program), name_(name) {}

  std::string Module(const std::vector<SelfTestRow>& rows,
                     double tolerance) const;

 private:
  std::string Body(const Instructions& part) const;
  std::string Tables() const;
  std::string Helpers() const;
  std::string Functions() const;
  std::string SelfTest(const std::vector<SelfTestRow>& rows,
                       double tolerance) const;

  const MapProgram& program_;
  const std::string& name_;
  PythonLanguage language_;
};

std::string ListText(const std::vector<double>& values,
                     const std::string& indent) {
  std::vector<std::string> numbers;
  for (const double value : values) numbers.push_back(RealText(value));
  return "[\n" + Joined(Wrapped(numbers, indent + "    "), "") + indent + "]";
}

std::string PythonWriter::Tables() const {
  std::string text = "# Trained range of each input, and where it is far.\n";
  text += "_RANGES = [\n";
  for (const ProgramReading& reading : program_.readings) {
    text += fmt::format("    ({}, {}, {}, {}),\n",
                        RealText(reading.trained_min),
                        RealText(reading.trained_max),
                        RealText(reading.far_min),
                        RealText(reading.far_max));
  }
  text += "]\n";
  for (std::size_t k = 0; k < program_.tables.size(); ++k) {
    const Eigen::MatrixXd& table = program_.tables[k];
    const Index num_inputs = table.cols() - 1;
    const Eigen::VectorXd bias = table.col(num_inputs);
    text += fmt::format(
        "_BIAS{} = {}\n", k, ListText({bias.begin(), bias.end()}, ""));
    text += fmt::format("_WEIGHTS{} = [\n", k);
    for (Index i = 0; i < num_inputs; ++i) {
      const Eigen::VectorXd weights = table.col(i);
      text +=
          "    " + ListText({weights.begin(), weights.end()}, "    ") + ",\n";
    }
    text += "]\n";
  }
  return text;
}

std::string PythonWriter::Helpers() const {
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

// What a part writes, and its instructions.
std::string PythonWriter::Body(const Instructions& part) const {
  struct List {
    Space space;
    char name;
  };
  std::string text;
  for (const List list : {List{Space::kGain, 'g'},
                          List{Space::kDerived, 'v'},
                          List{Space::kForm, 'u'},
                          List{Space::kScaled, 'z'},
                          List{Space::kHidden, 'h'},
                          List{Space::kTerm, 't'}}) {
    if (!std::ranges::any_of(part, [&](const Instruction& it) {
          return it.to.space == list.space;
        })) {
      continue;
    }
    text += fmt::format(
        "    {} = [0.0] * {}\n", list.name, program_.size(list.space));
  }
  return text + Joined(language_.Write(program_, part), "    ");
}

constexpr const char* kCheck = R"(

def check(inputs):
    """The status of these inputs: of the bits all but CLIPPED."""
    if len(inputs) != len(INPUTS):
        raise ValueError("expected %d inputs" % len(INPUTS))
    status = 0
    for value, (low, high, far_low, far_high) in zip(inputs, _RANGES):
        if not math.isfinite(value):
            return INVALID
        if value < low or value > high:
            status |= OUTSIDE
        if value < far_low or value > far_high:
            status |= FAR
    return status
)";

std::string PythonWriter::Functions() const {
  std::string text = kCheck;
  const bool memory = program_.has_memory();
  text += fmt::format("\n\ndef _evaluate({}x, status):\n{}",
                      memory ? "s, " : "",
                      Body(program_.evaluate));
  text +=
      "    if not math.isfinite(e):\n"
      "        return None, status | INVALID\n"
      "    return e, status\n";
  if (!memory) {
    return text + R"(

def error(inputs):
    """(error, status) at these inputs; None for an error where INVALID."""
    status = check(inputs)
    if status & INVALID:
        return None, status
    return _evaluate(inputs, status)
)";
  }
  text += fmt::format(R"(

def init(x):
    """(state, status) of a session that begins with these inputs: filters in
    their steady state, the zero taken here; no state where INVALID."""
    status = check(x)
    if status & INVALID:
        return None, status
    s = [0.0] * {}
{}    return s, status


def step(s, dt_s, x):
    """Goes on by dt_s seconds to these inputs: (error, status). Where INVALID
    the error is None and the state stays as it was."""
    status = check(x)
    if status & INVALID or not dt_s >= 0.0:
        return None, status | INVALID
{}    return _evaluate(s, x, status)


def zero(s, x):
    """Takes the zero anew, at these inputs: status."""
    status = check(x)
    if status & INVALID:
        return status
{}    return status
)",
                      program_.size(Space::kState),
                      Body(program_.begin),
                      Body(program_.advance),
                      Body(program_.zero));
  return text;
}

std::string PythonWriter::SelfTest(const std::vector<SelfTestRow>& rows,
                                   double tolerance) const {
  std::string text =
      "\n\n# Seconds since the row before, error and status expected, "
      "inputs.\n_SESSION = [\n";
  for (const SelfTestRow& row : rows) {
    std::vector<std::string> numbers{
        RealText(row.dt), RealText(row.error), fmt::format("{}", row.status)};
    for (const double reading : row.readings) {
      numbers.push_back(RealText(reading));
    }
    text += "    [\n" + Joined(Wrapped(numbers, "        "), "") + "    ],\n";
  }
  return text + fmt::format(R"(]


def _self_test():
    worst = 0.0
    wrong = False
{0}    for dt_s, expected, expected_status, *inputs in _SESSION:
{1}        deviation = math.inf if found is None else abs(found - expected)
        worst = max(worst, deviation)
        wrong = wrong or deviation > {2} or status != expected_status
    print("{3}: %d rows, worst deviation %.2g (%.2g allowed): %s"
          % (len(_SESSION), worst, {2}, "WRONG" if wrong else "right"))
    return wrong


if __name__ == "__main__":
    raise SystemExit(_self_test())
)",
                            program_.has_memory() ? "    state = None\n" : "",
                            program_.has_memory()
                                ? "        if state is None:\n"
                                  "            state, status = init(inputs)\n"
                                  "        found, status = step(state, dt_s, "
                                  "inputs)\n"
                                : "        found, status = error(inputs)\n",
                            RealText(tolerance),
                            name_);
}

std::string PythonWriter::Module(const std::vector<SelfTestRow>& rows,
                                 double tolerance) const {
  std::string text = "\"\"\"" +
                     Joined(AboutMap(program_, name_, Precision::kDouble), "") +
                     "\"\"\"\n\nimport math\n\n";
  text += fmt::format(
      "# Bits of a status; 0: all is well.\n"
      "OUTSIDE = {}  # an input left its trained range: extrapolated\n"
      "FAR = {}  # ... so far that its sensor is to be doubted\n"
      "CLIPPED = {}  # a guard clipped an input or the error\n"
      "INVALID = {}  # an input, a step or the error is no number\n\n",
      static_cast<int>(kMapOutside),
      static_cast<int>(kMapFar),
      static_cast<int>(kMapClipped),
      static_cast<int>(kMapInvalid));
  text += "INPUTS = [\n";
  for (const ProgramReading& reading : program_.readings) {
    text += "    \"" + CommentText(reading.column.name) + "\",\n";
  }
  text += "]\n" + Tables() + Helpers() + Functions();
  return text + SelfTest(rows, tolerance);
}

}  // namespace

std::vector<ExportedFile> PythonCode(const MapProgram& program,
                                     const std::string& name,
                                     const std::vector<SelfTestRow>& rows,
                                     double tolerance) {
  return {{name + ".py", PythonWriter(program, name).Module(rows, tolerance)}};
}

}  // namespace errmap::models
