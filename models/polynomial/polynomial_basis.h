#pragma once

#include <optional>
#include <string>
#include <vector>

#include "models/error_model.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Powers of each input in a term, at least one of them above 0.
using TermPowers = std::vector<int>;

/// Returns the number of terms of order 1 .. degree, without the intercept:
/// C(num_inputs + degree, degree) - 1; empty if it overflows.
std::optional<Index> CountTerms(Index num_inputs, int degree);

/// Returns all terms of order 1 .. degree, by order, then earlier inputs first
/// (for two inputs and degree 2: x, y, x^2, xy, y^2).
std::vector<TermPowers> AllTerms(Index num_inputs, int degree);

/// Returns the values of the terms (m x terms) at scaled inputs (m x p).
MatrixXd TermMatrix(const MatrixXd& scaled_inputs,
                    const std::vector<TermPowers>& terms);

/// Returns the name of a term: "position_mm^2*t12_degC".
std::string TermName(const TermPowers& term,
                     const std::vector<std::string>& input_names);

/// Returns the coefficients of the same polynomial in the inputs' own units:
/// terms with coefficients, by order; the intercept has all powers 0. Expanded
/// in extended precision. For display only: computing with high powers of raw
/// millimetres loses digits by cancellation.
std::vector<PolynomialTerm> ExpandToPhysicalUnits(const PolynomialForm& form);

/// Returns "error_mm = 3.79060810e-03 + 1.81768672e-04*position_mm + ..." in
/// the inputs' own units. Uses 9 to 17 digits, so that the text predicts to a
/// millionth of `rmse` over the trained range (0: 17 digits). Powers cancel, so
/// some fits need more digits than others.
std::string EquationText(const PolynomialForm& form,
                         const data::ColumnInfo& target,
                         const std::vector<TrainedInput>& inputs,
                         double rmse);

}  // namespace errmap::models
