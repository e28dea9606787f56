#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "models/export/program/map_program.h"

namespace errmap::models {
namespace {

// A term by the inputs that it has: of hundreds of inputs it has few.
struct SparseTerm {
  std::vector<std::pair<std::size_t, int>> powers;  // above 0, by input
  double coefficient = 0.0;

  int PowerOf(std::size_t input) const {
    const auto at =
        std::ranges::find(powers, input, &std::pair<std::size_t, int>::first);
    return at == powers.end() ? 0 : at->second;
  }
  void Divide(std::size_t input, int power) {
    const auto at =
        std::ranges::find(powers, input, &std::pair<std::size_t, int>::first);
    at->second -= power;
    if (at->second == 0) powers.erase(at);
  }
};

using Terms = std::span<SparseTerm>;

SparseTerm SparseOf(const PolynomialTerm& term) {
  SparseTerm sparse{.powers = {}, .coefficient = term.coefficient};
  for (std::size_t i = 0; i < term.powers.size(); ++i) {
    if (term.powers[i] > 0) sparse.powers.emplace_back(i, term.powers[i]);
  }
  return sparse;
}

bool IsConstant(Terms terms) {
  return std::ranges::all_of(
      terms, [](const SparseTerm& term) { return term.powers.empty(); });
}

double ConstantOf(Terms terms) {
  double sum = 0.0;
  for (const SparseTerm& term : terms) sum += term.coefficient;
  return sum;
}

class Nesting {
 public:
  explicit Nesting(std::size_t num_inputs) : counts_(num_inputs, 0) {}

  // The sum of `terms`, which are used up, in kTerm `depth`; what lies deeper
  // is scratch.
  void Sum(Terms terms, int depth) {
    const Operand to{Space::kTerm, depth};
    if (IsConstant(terms)) {
      Add({.op = Op::kSet, .to = to, .c = ConstantOf(terms)});
      return;
    }
    const std::size_t input = CommonestInput(terms);
    // Not that of std::ranges, which clang 14 does not compile.
    const auto rest = std::stable_partition(
        terms.begin(), terms.end(), [&](const SparseTerm& term) {
          return term.PowerOf(input) > 0;
        });
    const Terms with(terms.begin(), rest);
    const Terms without(rest, terms.end());
    int power = with.front().PowerOf(input);
    for (const SparseTerm& term : with) {
      power = std::min(power, term.PowerOf(input));
    }
    for (SparseTerm& term : with) term.Divide(input, power);
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
  // The input that most terms have; the first of several.
  std::size_t CommonestInput(Terms terms) {
    std::size_t commonest = counts_.size();
    for (const SparseTerm& term : terms) {
      for (const auto& [input, power] : term.powers) ++counts_[input];
    }
    for (const SparseTerm& term : terms) {
      for (const auto& [input, power] : term.powers) {
        if (commonest == counts_.size() ||
            counts_[input] > counts_[commonest] ||
            (counts_[input] == counts_[commonest] && input < commonest)) {
          commonest = input;
        }
      }
    }
    for (const SparseTerm& term : terms) {
      for (const auto& [input, power] : term.powers) counts_[input] = 0;
    }
    return commonest;
  }

  void Add(const Instruction& instruction) {
    instructions_.push_back(instruction);
  }

  std::vector<int> counts_;  // (inputs) all 0 between uses
  Instructions instructions_;
};

}  // namespace

Instructions NestedPolynomial(const PolynomialForm& form) {
  std::vector<SparseTerm> terms;
  if (form.intercept != 0.0 || form.terms.empty()) {
    terms.push_back({.powers = {}, .coefficient = form.intercept});
  }
  for (const PolynomialTerm& term : form.terms) terms.push_back(SparseOf(term));
  Nesting nesting(form.terms.empty() ? 0 : form.terms.front().powers.size());
  nesting.Sum(terms, 0);
  return nesting.Take();
}

}  // namespace errmap::models
