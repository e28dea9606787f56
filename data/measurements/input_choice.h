#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "data/csv.h"
#include "data/measurements/column_roles.h"
#include "data/measurements/dataset.h"
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

}  // namespace errmap::data
