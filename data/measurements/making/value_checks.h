#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// A remark where a target is of a size that no machine errs by: a machine that
/// errs by millimetres, or by less than most can measure, is one whose numbers
/// are in another unit, more often than not.
std::optional<std::string> UnlikelySize(const ColumnInfo& target,
                                        const Eigen::VectorXd& values);

/// Throws OpenQuestion where nobody stated the unit of a target and its values
/// (RMS above 1) or columns in inches and degF speak against the mm assumed, or
/// where none is assumed ("Abweichung") and nobody `named` the target.
void AskForUnit(const CsvTable& table,
                const std::string& target,
                const Eigen::VectorXd& values,
                bool named);

/// The weights of these rows, of mean 1, since only their ratios mean something
/// and equal ones are none. Throws InputError where one is not above 0, or less
/// than 1e-30 of the largest.
Eigen::VectorXd WeightsOf(const CsvTable& table,
                          const CsvColumn& column,
                          const std::vector<Eigen::Index>& rows);

/// Throws InputError where the squares of `values` cannot be summed, as every
/// figure of a target or an input is such a sum. `what`: "target", "input" that
/// is called `column`, of these `rows` of the table.
void RequireSquares(const CsvTable& table,
                    const std::vector<Eigen::Index>& rows,
                    const std::string& what,
                    const std::string& column,
                    const Eigen::Ref<const Eigen::VectorXd>& values);

}  // namespace errmap::data
