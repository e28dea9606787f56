#pragma once

#include <memory>

#include "data/formats/strd_problem.h"
#include "fitting/nonlinear/nonlinear_regression.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Returns the regression of a nonlinear NIST problem, with data in 106 bits
/// from their decimal text. Throws std::invalid_argument if `problem` is of
/// another kind, or has an unknown model or another number of parameters.
std::unique_ptr<fitting::RegressionFunction> MakeStrdFunction(
    const data::StrdProblem& problem);

/// Returns column `column` of the data (n) in 106 bits.
fitting::ExtendedVector StrdColumn(const data::StrdProblem& problem,
                                   std::size_t column);

/// Return the certified parameters (p), and their standard deviations (p).
VectorXd CertifiedParameters(const data::StrdProblem& problem);
VectorXd CertifiedDeviations(const data::StrdProblem& problem);

/// Returns start 1 or 2 (p) of a nonlinear problem. Throws
/// std::invalid_argument for any other number.
VectorXd StrdStart(const data::StrdProblem& problem, int start);

}  // namespace errmap::models
