#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "models/error_model.h"
#include "models/sensors/applicability.h"

namespace errmap::report {

/// Returns one line for each input that leaves its trained range: in how many
/// rows and by how much; of several inputs, a line of all rows first. `values`
/// (m x p) are in the map's units. Empty if none does.
std::vector<std::string> OutsideLines(
    const std::vector<models::TrainedInput>& inputs,
    const Eigen::MatrixXd& values);

/// Returns how many rows are unlike training, even if each input is within its
/// range, and names the worst. `rows` (m) are the numbers of the data rows in
/// the file.
std::vector<std::string> UnlikeLines(const std::vector<models::RowFlag>& flags,
                                     const std::vector<Eigen::Index>& rows);

}  // namespace errmap::report
