#pragma once

#include <vector>

#include "data/csv.h"
#include "data/measurements/column_faults.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// Finds rows that pass (one flag per row of the table) but are totals or
/// remarks, not measurements. They have text where nearly all other rows have a
/// number or a time. In columns that number the rows (`numbering`, one flag per
/// column), any word counts; elsewhere, only words such as "Mean". With
/// kDropRows their flags are cleared; otherwise throws InputError if there is
/// one.
std::vector<Eigen::Index> LeaveOutRowsOfWords(
    const CsvTable& table,
    const std::vector<bool>& numbering,
    MissingPolicy missing_policy,
    std::vector<bool>* passing);

/// Returns, in ascending order, the rows that pass and repeat an earlier row in
/// all named columns. This is not chance if as many rows, `times_again`, have
/// the time of an earlier one (-1: not known). Else a neighbour must also
/// repeat that row's neighbour, and none are returned if the target has so few
/// distinct values that rows may be equal.
std::vector<Eigen::Index> RepeatedRows(const CsvTable& table,
                                       std::size_t target,
                                       const std::vector<bool>& passes,
                                       Eigen::Index times_again = -1);

/// Finds targets that look like measurements but are not. These are zeros while
/// all other rows have an error (kZero, a lost beam), and runs of rows in
/// another unit (kOtherUnit, one fault each). Rows count from 0; those without
/// a reading (ascending) do not count as rows in a larger unit.
std::vector<ColumnFault> FindTargetFaults(
    const MeasuredColumns& measured,
    const std::vector<Eigen::Index>& no_readings);

/// Finds single targets ten times as large as a linear map of the other columns
/// predicts (kOutlying): a decimal point in the wrong place. Rows count from 0.
std::vector<ColumnFault> FindSlippedPoints(const MeasuredColumns& measured);

}  // namespace errmap::data
