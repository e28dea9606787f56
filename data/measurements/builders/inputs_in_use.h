#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/builders/dataset_remarks.h"
#include "data/measurements/dataset.h"
#include "data/measurements/input_choice.h"
#include "data/measurements/reading/read_table.h"

namespace errmap::data {

/// Returns the inputs of ChooseInputs, without those that measure nothing
/// according to the reading: measured positions and their numbers, axes at
/// rest, counters, parts of dates. Those left out, and every remark, go to
/// `said`. Throws as ChooseInputs.
ChosenInputs ChooseInputsAsRead(const CsvTable& table,
                                const DatasetSelection& selection,
                                const ReadTable& read,
                                DatasetRemarks* said);

/// Leaves out inputs (columns of the table) whose empty cells would cost more
/// rows than they are worth: those with a number in less than a tenth of the
/// rows that pass, or with one number throughout. Only for inputs that the user
/// has not named, and if rows with missing cells are dropped.
void LeaveOutInputsThatCostRows(const CsvTable& table,
                                const DatasetSelection& selection,
                                const std::vector<bool>& passes,
                                std::size_t target,
                                std::vector<std::size_t>* inputs,
                                DatasetRemarks* said);

/// Sets the role of each input that the axis has not set, by name and values.
void SetRoles(Dataset::Parts* parts);

/// Adds to a reading the inputs by role, and the columns left out, including
/// `records` (columns of the table).
void DescribeInputs(const CsvTable& table,
                    const Dataset::Parts& parts,
                    const std::vector<std::size_t>& records,
                    const DatasetRemarks& said,
                    Reading* reading);

/// Keeps these rows of target, inputs and weights; `kept` are indices into
/// parts->rows, ascending.
void KeepRows(const std::vector<Eigen::Index>& kept, Dataset::Parts* parts);

/// Leaves out the marked inputs (p). Returns the new index of each input, -1
/// for those left out.
std::vector<Eigen::Index> LeaveOutInputs(const std::vector<bool>& left_out,
                                         Dataset::Parts* parts);

}  // namespace errmap::data
