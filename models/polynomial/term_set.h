#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "models/polynomial/polynomial_basis.h"

namespace errmap::models {

/// Which terms a basis has: the words of terms=.
enum class TermSet {
  kLinear,   // every input
  kSquares,  // powers of every input, no products
  kAxis,     // powers of each position times (1 and every other input), and
             // every other input: how a slide's error depends on temperature
  kFull,     // all products up to the degree
};
std::string_view ToString(TermSet set);
const std::vector<std::string>& TermSetWords();

/// Which inputs are moved to the middle of their range before products and
/// powers are formed.
enum class Centring {
  kStandardised,  // each to its mean, and scaled to sd 1
  kAll,           // each
  kNone,          // none: products of the inputs as they are
  kHarmless,      // those where it does not change what the terms can express
};

/// Highest power that a set takes where no degree is given: 1, 2, 3, and for
/// full by the number of inputs (DefaultDegree).
int DefaultDegreeOf(TermSet set, Eigen::Index num_inputs);

/// Number of terms; empty where it overflows.
std::optional<Eigen::Index> CountTerms(TermSet set,
                                       const std::vector<bool>& is_position,
                                       int degree);

/// The terms over inputs of which these are positions. An axis set without
/// positions is linear.
std::vector<TermPowers> MakeTerms(TermSet set,
                                  const std::vector<bool>& is_position,
                                  int degree);

}  // namespace errmap::models
