#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "models/error_model.h"

namespace errmap::models {

/// Powers of each input in a term, at least one of them above 0.
using TermPowers = std::vector<int>;

/// Number of terms of order 1 .. degree in `num_inputs` inputs, without the
/// intercept: C(num_inputs + degree, degree) - 1; empty where that overflows.
std::optional<Eigen::Index> CountTerms(Eigen::Index num_inputs, int degree);

/// All terms of order 1 .. degree, by order, then with earlier inputs first
/// (for two inputs and degree 2: x, y, x^2, xy, y^2).
std::vector<TermPowers> AllTerms(Eigen::Index num_inputs, int degree);

/// Values of the terms (m x terms) at scaled inputs (m x p).
Eigen::MatrixXd TermMatrix(const Eigen::MatrixXd& scaled_inputs,
                           const std::vector<TermPowers>& terms);

/// "position_mm^2*t12_degC".
std::string TermName(const TermPowers& term,
                     const std::vector<std::string>& input_names);

/// Coefficients of the same polynomial in the inputs' own units: terms with
/// their coefficients, by order; the intercept has all powers 0. Multiplied
/// out in extended precision: for reading, not for computing, since high
/// powers of raw millimetres cancel.
std::vector<PolynomialTerm> ExpandToPhysicalUnits(const PolynomialForm& form);

/// "error_mm = 3.79060810e-03 + 1.81768672e-04*position_mm + ..." in the
/// inputs' own units. Nine digits or as many more, up to 17, as it takes for
/// the text to give the predictions over the trained range to a millionth of
/// `rmse` (0: 17 digits): the powers cancel, so that some fits need them.
std::string EquationText(const PolynomialForm& form,
                         const data::ColumnInfo& target,
                         const std::vector<TrainedInput>& inputs,
                         double rmse);

}  // namespace errmap::models
