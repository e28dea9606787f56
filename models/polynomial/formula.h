#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "models/polynomial/polynomial_basis.h"

namespace errmap::models {

/// A term as it is written: factors with their powers.
struct NamedTerm {
  struct Factor {
    std::string input;
    int power = 1;

    bool operator==(const Factor&) const = default;
  };
  std::vector<Factor> factors;
  std::size_t position = 0;  // 1-based, of its first character

  /// The same term, wherever it stands.
  bool operator==(const NamedTerm& other) const {
    return factors == other.factors;
  }
};

/// Terms as ParseTerms reads them.
std::string TermsText(const std::vector<NamedTerm>& terms);

/// Reads a sum of products of powers, "position_mm+t1_degC^2*t2_degC", in
/// ordinary arithmetic (`^` is a power; there is no crossing as in R). Names
/// other than letters, digits, `_` and `.` stand in double quotes. Throws
/// std::invalid_argument with the position (1-based, in characters) of what
/// cannot be read, naming `what` ("formula").
std::vector<NamedTerm> ParseTerms(std::string_view text,
                                  const std::string& what);

/// Powers of the inputs `names` in each term. Throws std::invalid_argument
/// naming an input that is not there and those that are, or a term given
/// twice.
std::vector<TermPowers> ResolveTerms(const std::vector<NamedTerm>& terms,
                                     const std::vector<std::string>& names,
                                     const std::string& what);

}  // namespace errmap::models
