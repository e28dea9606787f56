#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// Returns a remark if the target's size is implausible for a machine. Errors
/// of millimetres, or too small to be measured, suggest a wrong unit.
std::optional<std::string> UnlikelySize(const ColumnInfo& target,
                                        const Eigen::VectorXd& values);

/// Returns a remark on thermometers without a unit whose readings are those of
/// a shop and a warm machine in degF.
std::optional<std::string> LikelyFahrenheit(
    const std::vector<ColumnInfo>& inputs, const Eigen::MatrixXd& values);

/// Returns a remark if positions or temperatures of one session would be like
/// those of the one beside it in another unit. `starts`: the first row of each.
std::optional<std::string> OtherUnitInSession(
    const ColumnInfo& input,
    const Eigen::Ref<const Eigen::VectorXd>& values,
    const std::vector<Eigen::Index>& starts);

/// Throws OpenQuestion if the target's unit is not stated, and the values (RMS
/// above 1), or columns in inches and degF, contradict the assumed mm. Also
/// throws if no unit can be assumed ("Abweichung") and the target was not
/// `named`.
void AskForUnit(const CsvTable& table,
                const std::string& target,
                const Eigen::VectorXd& values,
                bool named);

/// Returns the weights of these rows, scaled to mean 1, since only their ratios
/// matter. Equal weights count as no weights. Throws InputError if one is not
/// above 0, or less than 1e-30 of the largest.
Eigen::VectorXd WeightsOf(const CsvTable& table,
                          const CsvColumn& column,
                          const std::vector<Eigen::Index>& rows);

/// Throws InputError if the sum of squares of `values` overflows, since every
/// statistic needs it. `what` is "target" or "input"; the input is `column`, in
/// these `rows` of the table.
void RequireSquares(const CsvTable& table,
                    const std::vector<Eigen::Index>& rows,
                    const std::string& what,
                    const std::string& column,
                    const Eigen::Ref<const Eigen::VectorXd>& values);

}  // namespace errmap::data
