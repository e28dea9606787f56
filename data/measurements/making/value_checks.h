#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// Returns a remark if no machine has errors of the target's size. If a machine
/// seems to err by millimetres, or by less than can be measured, its unit is
/// probably another.
std::optional<std::string> UnlikelySize(const ColumnInfo& target,
                                        const Eigen::VectorXd& values);

/// Returns a remark on thermometers that nobody gave a unit, if they read as a
/// shop and a warm machine do in degF.
std::optional<std::string> LikelyFahrenheit(
    const std::vector<ColumnInfo>& inputs, const Eigen::MatrixXd& values);

/// Throws OpenQuestion if nobody stated the target's unit and the values (RMS
/// above 1), or columns in inches and degF, contradict the assumed mm. Also if
/// no unit can be assumed ("Abweichung") and the target was not `named`.
void AskForUnit(const CsvTable& table,
                const std::string& target,
                const Eigen::VectorXd& values,
                bool named);

/// Returns the weights of these rows, scaled to mean 1, since only their ratios
/// matter. Equal weights count as none. Throws InputError if one is not above
/// 0, or less than 1e-30 of the largest.
Eigen::VectorXd WeightsOf(const CsvTable& table,
                          const CsvColumn& column,
                          const std::vector<Eigen::Index>& rows);

/// Throws InputError if the squares of `values` cannot be summed, since every
/// statistic of a target or an input is such a sum. `what` is "target" or
/// "input"; the input is `column`, in these `rows` of the table.
void RequireSquares(const CsvTable& table,
                    const std::vector<Eigen::Index>& rows,
                    const std::string& what,
                    const std::string& column,
                    const Eigen::Ref<const Eigen::VectorXd>& values);

}  // namespace errmap::data
