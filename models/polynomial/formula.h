#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "models/polynomial/polynomial_basis.h"

namespace errmap::models {

/// A term as written: factors with their powers.
struct NamedTerm {
  struct Factor {
    std::string input;
    int power = 1;

    bool operator==(const Factor&) const = default;
  };
  std::vector<Factor> factors;
  std::size_t position = 0;  // 1-based, of its first character

  /// Compares terms without their positions in the text.
  bool operator==(const NamedTerm& other) const {
    return factors == other.factors;
  }
};

/// Terms as parsed by ParseTerms.
std::string TermsText(const std::vector<NamedTerm>& terms);

/// Parses a sum of products of powers, "position_mm+t1_degC^2*t2_degC", as
/// ordinary arithmetic (`^` is a power, not R's crossing). Names with
/// characters other than letters, digits, `_` and `.` must be in double quotes.
/// Throws std::invalid_argument with the position (1-based, in characters) of
/// the first error, naming `what` ("formula").
std::vector<NamedTerm> ParseTerms(std::string_view text,
                                  const std::string& what);

/// Returns the powers of the inputs `names` in each term. Throws
/// std::invalid_argument if a term is given twice or an input does not exist;
/// the message names it and lists the inputs.
std::vector<TermPowers> ResolveTerms(const std::vector<NamedTerm>& terms,
                                     const std::vector<std::string>& names,
                                     const std::string& what);

}  // namespace errmap::models
