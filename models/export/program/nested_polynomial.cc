#include "models/export/program/nested_polynomial.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace errmap::models {
namespace {

using Terms = std::vector<PolynomialTerm>;

bool IsConstant(const Terms& terms) {
  return std::ranges::all_of(terms, [](const PolynomialTerm& term) {
    return std::ranges::all_of(term.powers, [](int p) { return p == 0; });
  });
}

double ConstantOf(const Terms& terms) {
  double sum = 0.0;
  for (const PolynomialTerm& term : terms) sum += term.coefficient;
  return sum;
}

// The input that most terms have; the first of several.
std::size_t CommonestInput(const Terms& terms) {
  std::vector<int> counts(terms.front().powers.size(), 0);
  for (const PolynomialTerm& term : terms) {
    for (std::size_t i = 0; i < counts.size(); ++i) {
      counts[i] += term.powers[i] > 0 ? 1 : 0;
    }
  }
  return static_cast<std::size_t>(std::ranges::max_element(counts) -
                                  counts.begin());
}

class Nesting {
 public:
  // The sum of `terms` in kTerm `depth`; what lies deeper is scratch.
  void Sum(const Terms& terms, int depth) {
    const Operand to{Space::kTerm, depth};
    if (IsConstant(terms)) {
      Add({.op = Op::kSet, .to = to, .c = ConstantOf(terms)});
      return;
    }
    const std::size_t input = CommonestInput(terms);
    Terms with;
    Terms without;
    for (const PolynomialTerm& term : terms) {
      (term.powers[input] > 0 ? with : without).push_back(term);
    }
    int power = with.front().powers[input];
    for (const PolynomialTerm& term : with) {
      power = std::min(power, term.powers[input]);
    }
    for (PolynomialTerm& term : with) term.powers[input] -= power;
    Sum(with, depth);
    const Operand factor{Space::kScaled, static_cast<int>(input)};
    for (; power > 1; --power) {
      Add({.op = Op::kTimes, .to = to, .a = to, .b = factor});
    }
    if (IsConstant(without)) {
      Add({.op = without.empty() ? Op::kTimes : Op::kTimesPlus,
           .to = to,
           .a = to,
           .b = factor,
           .c = ConstantOf(without)});
      return;
    }
    Sum(without, depth + 1);
    Add({.op = Op::kTimesPlusTerm, .to = to, .a = to, .b = factor});
  }

  Instructions Take() { return std::move(instructions_); }

 private:
  void Add(const Instruction& instruction) {
    instructions_.push_back(instruction);
  }

  Instructions instructions_;
};

}  // namespace

Instructions NestedPolynomial(const PolynomialForm& form) {
  Terms terms;
  if (form.intercept != 0.0 || form.terms.empty()) {
    const std::size_t num_inputs =
        form.terms.empty() ? 0 : form.terms.front().powers.size();
    terms.push_back({std::vector<int>(num_inputs, 0), form.intercept});
  }
  for (const PolynomialTerm& term : form.terms) terms.push_back(term);
  Nesting nesting;
  nesting.Sum(terms, 0);
  return nesting.Take();
}

}  // namespace errmap::models
