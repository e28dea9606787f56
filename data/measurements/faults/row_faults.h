#pragma once

#include <vector>

#include "data/csv.h"
#include "data/measurements/column_faults.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// Rows that pass (one flag per row of the table) and are no measurements but
/// totals or remarks: text where nearly all other rows have a number or a time;
/// in columns that number the rows (`numbering`, one flag per column) any word,
/// elsewhere one such as "Mean". With kDropRows they pass no longer; else
/// throws InputError where there is one.
std::vector<Eigen::Index> LeaveOutRowsOfWords(
    const CsvTable& table,
    const std::vector<bool>& numbering,
    MissingPolicy missing_policy,
    std::vector<bool>* passing);

/// Rows that pass and repeat an earlier one value for value in all named
/// columns, as the row beside them repeats that beside it, ascending; none
/// where the target's values are so few that rows may be alike by chance.
std::vector<Eigen::Index> RepeatedRows(const CsvTable& table,
                                       std::size_t target,
                                       const std::vector<bool>& passes);

/// Targets that are no measurement though each looks like one: zeros where all
/// other rows say that there is an error (kZero, a lost beam), and runs of rows
/// in another unit (kOtherUnit, a fault each). Rows count from 0.
std::vector<ColumnFault> FindTargetFaults(const MeasuredColumns& measured);

/// Single targets ten times as large as what a linear map of the other columns
/// makes of their rows (kOutlying): a point that slipped. Rows count from 0.
std::vector<ColumnFault> FindSlippedPoints(const MeasuredColumns& measured);

}  // namespace errmap::data
