#include "models/polynomial/term_set.h"

#include <algorithm>

namespace errmap::models {

const std::vector<std::string>& TermSetWords() {
  static const std::vector<std::string> words = {
      "linear", "squares", "axis", "full"};
  return words;
}

std::string_view ToString(TermSet set) {
  return TermSetWords()[static_cast<std::size_t>(set)];
}

int DefaultDegreeOf(TermSet set, Index num_inputs) {
  constexpr int kSquare = 2;
  constexpr int kCube = 3;
  switch (set) {
    case TermSet::kLinear:
      return 1;
    case TermSet::kSquares:
      return kSquare;
    case TermSet::kAxis:
      return kCube;
    case TermSet::kFull:
      break;
  }
  constexpr Index kFewInputs = 8;
  return num_inputs <= kFewInputs ? kCube : kSquare;
}

std::optional<Index> CountTerms(TermSet set,
                                const std::vector<bool>& is_position,
                                int degree) {
  const auto inputs = std::ssize(is_position);
  const auto positions =
      static_cast<Index>(std::ranges::count(is_position, true));
  const Index others = inputs - positions;
  switch (set) {
    case TermSet::kLinear:
      return inputs;
    case TermSet::kSquares:
      return degree * inputs;
    case TermSet::kAxis:
      return others + positions * degree * (1 + others);
    case TermSet::kFull:
      break;
  }
  return CountTerms(inputs, degree);
}

std::vector<TermPowers> MakeTerms(TermSet set,
                                  const std::vector<bool>& is_position,
                                  int degree) {
  const std::size_t inputs = is_position.size();
  if (set == TermSet::kFull) {
    return AllTerms(static_cast<Index>(inputs), degree);
  }
  std::vector<TermPowers> terms;
  const auto power_of = [&](std::size_t input, int power) {
    TermPowers powers(inputs, 0);
    powers[input] = power;
    return powers;
  };
  for (std::size_t i = 0; i < inputs; ++i) terms.push_back(power_of(i, 1));
  if (set == TermSet::kLinear) return terms;
  if (set == TermSet::kSquares) {
    for (int power = 2; power <= degree; ++power) {
      for (std::size_t i = 0; i < inputs; ++i) {
        terms.push_back(power_of(i, power));
      }
    }
    return terms;
  }
  for (std::size_t position = 0; position < inputs; ++position) {
    if (!is_position[position]) continue;
    for (int power = 1; power <= degree; ++power) {
      if (power > 1) terms.push_back(power_of(position, power));
      for (std::size_t other = 0; other < inputs; ++other) {
        if (is_position[other]) continue;
        TermPowers powers = power_of(position, power);
        powers[other] = 1;
        terms.push_back(std::move(powers));
      }
    }
  }
  return terms;
}

}  // namespace errmap::models
