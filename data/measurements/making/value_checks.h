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

/// Throws InputError where the squares of `values` cannot be summed, as every
/// figure of a target or an input is such a sum. `what`: "target", "input" that
/// is called `column`, of these `rows` of the table.
void RequireSquares(const CsvTable& table,
                    const std::vector<Eigen::Index>& rows,
                    const std::string& what,
                    const std::string& column,
                    const Eigen::Ref<const Eigen::VectorXd>& values);

}  // namespace errmap::data
