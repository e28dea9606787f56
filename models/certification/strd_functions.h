#pragma once

#include <memory>

#include <Eigen/Core>

#include "data/formats/strd_problem.h"
#include "fitting/nonlinear/nonlinear_regression.h"

namespace errmap::models {

/// The regression of a nonlinear NIST problem, data in 106 bits from their
/// decimal text. Throws std::invalid_argument where `problem` is of another
/// kind, has a model unknown here or another number of parameters.
std::unique_ptr<fitting::RegressionFunction> MakeStrdFunction(
    const data::StrdProblem& problem);

/// Column `column` of the data (n) in 106 bits.
fitting::ExtendedVector StrdColumn(const data::StrdProblem& problem,
                                   std::size_t column);

/// Certified parameters and their standard deviations (p).
Eigen::VectorXd CertifiedParameters(const data::StrdProblem& problem);
Eigen::VectorXd CertifiedDeviations(const data::StrdProblem& problem);

/// Start 1 or 2 (p) of a nonlinear problem; throws std::invalid_argument for
/// any other number.
Eigen::VectorXd StrdStart(const data::StrdProblem& problem, int start);

}  // namespace errmap::models
