#include "models/export/c_language.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "models/export/program/controller.h"
#include "models/export/program/safe_names.h"

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
                    .indent = "  "};

}  // namespace

CLanguage::CLanguage(std::string name, Precision precision)
    : Language(precision, kC), name_(std::move(name)) {}

std::string CLanguage::CellName(Cell cell) const {
  const CellInfo& info = InfoOf(cell);
  switch (info.kind) {
    case CellKind::kKept:
      return fmt::format("state->{}", info.name);
    case CellKind::kTable:
      return fmt::format("{}_{}", name_, info.name);
    case CellKind::kLocal:
      break;
  }
  return info.name;
}

std::string CLanguage::Number(double value, bool single) const {
  return RealText(value, single) + (single ? "F" : "");
}

std::string CLanguage::TrainedState(int form, int coordinate) const {
  return fmt::format("{}_states{}[{}][i]", name_, form, coordinate);
}

std::string CLanguage::HasAny(int mask) const {
  return fmt::format("status & {}",
                     mask == kMapNotTaken
                         ? name_ + "_NOT_TAKEN"
                         : "(" + StatusNames(mask, name_ + "_", " | ") + ")");
}

std::string CLanguage::Flag(int bit) const {
  return fmt::format("status |= {};", StatusNames(bit, name_ + "_", ""));
}

std::string CLanguage::Assign(const std::string& to,
                              const std::string& value,
                              bool narrows) const {
  return narrows ? fmt::format("{} = (float)({});", to, value)
                 : fmt::format("{} = {};", to, value);
}

std::string CLanguage::Call(Function function,
                            const std::string& argument,
                            bool single) const {
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

// Input by input, a few outputs side by side: as many sums as registers hold
// go on at once, each still in the order of the inputs.
Lines CLanguage::Affine(const Instruction& it, const MatrixXd& table) const {
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

Lines CLanguage::Sigmoids(const Instruction& it) const {
  const std::string to = ArrayAt(it.to, "j");
  return {fmt::format("for (j = 0; j < {}; ++j) {} = {}_sigmoid({});",
                      it.count,
                      to,
                      name_,
                      to)};
}

}  // namespace errmap::models
