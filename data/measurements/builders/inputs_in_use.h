#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/builders/dataset_remarks.h"
#include "data/measurements/column_roles.h"
#include "data/measurements/dataset.h"
#include "data/measurements/reading/read_table.h"
#include "data/measurements/sessions.h"

namespace errmap::data {

struct ChosenInputs {
  std::vector<std::size_t> inputs;     // (p) as named, else ascending
  std::vector<DroppedColumn> dropped;  // would-be inputs left out, and why
  std::vector<std::string> remarks;    // one line each, for people
  std::vector<std::size_t> words;      // columns that name things, not amounts
  std::vector<std::size_t> records;    // of numbers that only tell rows apart
};

/// Returns the inputs that `selection` names, else the defaults of MakeDataset
/// without the columns in `roles` and `found`. Throws InputError for a column
/// that is unknown, without numbers, named twice, named and excluded, or the
/// target. Also if no input is left although there were candidates.
ChosenInputs ChooseInputs(const CsvTable& table,
                          const DatasetSelection& selection,
                          const ColumnRoles& roles,
                          const FoundSessions& found);

/// Throws InputError with the first few reasons why no input is left.
[[noreturn]] void ThrowNoInputs(const CsvTable& table,
                                const std::vector<DroppedColumn>& dropped);

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
