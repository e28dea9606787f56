#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "models/error_model.h"
#include "models/sensors/applicability.h"

namespace errmap::report {

/// Returns a line that names the inputs that leave their trained range: by how
/// much and in how many rows. `values` (m x p) are in the map's units. Empty if
/// none does.
std::vector<std::string> OutsideLines(
    const std::vector<models::TrainedInput>& inputs,
    const Eigen::MatrixXd& values);

/// Returns how many other rows are unlike training, and names the worst. `rows`
/// (m) are the numbers of the data rows in the file.
std::vector<std::string> UnlikeLines(
    const std::vector<models::TrainedInput>& inputs,
    const Eigen::MatrixXd& values,
    const std::vector<models::RowFlag>& flags,
    const std::vector<Eigen::Index>& rows);

}  // namespace errmap::report
