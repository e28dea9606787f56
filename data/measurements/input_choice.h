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

/// The inputs that `selection` names, else the defaults of MakeDataset, which
/// are not what `roles` and `found` have taken. Throws InputError: unknown
/// column, one without numbers, named twice, named and excluded, the target; or
/// no input left where there were candidates.
ChosenInputs ChooseInputs(const CsvTable& table,
                          const DatasetSelection& selection,
                          const ColumnRoles& roles,
                          const FoundSessions& found);

/// Throws InputError with the first reasons why no input is left.
[[noreturn]] void ThrowNoInputs(const CsvTable& table,
                                const std::vector<DroppedColumn>& dropped);

}  // namespace errmap::data
