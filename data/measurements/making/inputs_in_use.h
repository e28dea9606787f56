#pragma once

#include <cstddef>
#include <vector>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "data/measurements/input_choice.h"
#include "data/measurements/making/dataset_remarks.h"
#include "data/measurements/reading/read_table.h"

namespace errmap::data {

/// Returns the inputs of ChooseInputs, less those that the reading knows to
/// measure nothing: readings and numbers of the position, axes that stand,
/// counters, parts of dates. What is left out, and every remark, goes to `said`
/// instead. Throws as ChooseInputs.
ChosenInputs ChooseInputsAsRead(const CsvTable& table,
                                const DatasetSelection& selection,
                                const ReadTable& read,
                                DatasetRemarks* said);

/// Leaves out inputs (columns of the table) that nobody named, whose empty
/// cells would cost rows and give nothing in return: with a number in less than
/// a tenth of the rows that pass, or one number throughout. Only if rows with
/// missing cells are dropped.
void LeaveOutInputsThatCostRows(const CsvTable& table,
                                const DatasetSelection& selection,
                                const std::vector<bool>& passes,
                                std::vector<std::size_t>* inputs,
                                DatasetRemarks* said);

/// Sets the role of each input that the axis has not set, by name and values.
void SetRoles(Dataset::Parts* parts);

/// Adds to a reading what the values added: the inputs by role, and what was
/// left out, `records` (columns of the table) among it.
void DescribeInputs(const CsvTable& table,
                    const Dataset::Parts& parts,
                    const std::vector<std::size_t>& records,
                    const DatasetRemarks& said,
                    Reading* reading);

}  // namespace errmap::data
