#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "models/polynomial/polynomial_basis.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Terms of a basis: the values of terms=.
enum class TermSet {
  kLinear,   // every input
  kSquares,  // powers of every input, no products
  kAxis,     // powers of each position times (1 and every other input), and
             // every other input: how a slide's error depends on temperature
  kFull,     // all products up to the degree
};
std::string_view ToString(TermSet set);
const std::vector<std::string>& TermSetWords();

/// Inputs that are centred on their range before products and powers are
/// formed.
enum class Centring {
  kStandardised,  // each on its mean, and scaled to sd 1
  kAll,           // each
  kNone,          // none: products of the raw inputs
  kHarmless,      // those for which it does not change the space of the terms
};

/// Returns the highest power of a set if no degree is given: 1, 2, 3, and for
/// full 3 up to 8 inputs, else 2.
int DefaultDegreeOf(TermSet set, Index num_inputs);

/// Returns the number of terms; empty on overflow.
std::optional<Index> CountTerms(TermSet set,
                                const std::vector<bool>& is_position,
                                int degree);

/// Returns the terms over inputs, given which are positions. An axis set
/// without positions is linear.
std::vector<TermPowers> MakeTerms(TermSet set,
                                  const std::vector<bool>& is_position,
                                  int degree);

}  // namespace errmap::models
