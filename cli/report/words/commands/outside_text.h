#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "models/error_model.h"
#include "models/sensors/applicability.h"

namespace errmap::report {

/// Which inputs leave their trained range, in how many rows and how far, a line
/// each; `values` (m x p) in the map's units. Nothing where none does.
std::vector<std::string> OutsideLines(
    const std::vector<models::TrainedInput>& inputs,
    const Eigen::MatrixXd& values);

/// How many rows are unlike training though each input may lie within its
/// range, and the worst of all; `rows` (m) are the data rows of the file.
std::vector<std::string> UnlikeLines(const std::vector<models::RowFlag>& flags,
                                     const std::vector<Eigen::Index>& rows);

}  // namespace errmap::report
