#pragma once

#include <string>
#include <vector>

#include "data/csv.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// The column that joined tables get where nothing in them tells the files
/// apart; a map that knows its sessions by it takes a file for one.
inline constexpr const char* kFileColumn = "file";

struct JoinedTable {
  CsvTable table;
  std::vector<std::string> remarks;  // how the files differ, one line each
};

/// Tables (at least one) of one component below one another, with the columns
/// that all have, in the names and units of the first: letters may be in
/// another case, units in one that can be converted. One table stays as it is.
///
/// Sessions are those of the column that FindSessions finds in each file; where
/// it finds none, a file is one, whatever the leaps of its time. Where two
/// files give the same name to theirs, the names get the file's label
/// (FileLabel); where no column has them, a column kFileColumn does, by which
/// files that are counted in a day are one (SessionsOfFiles). Where it is that
/// column that `selection` names, nothing else parts a file.
///
/// Throws InputError where units contradict, or where a column `error*` or one
/// that `selection` names is not in all; and as FindSessions does.
JoinedTable JoinTables(std::vector<CsvTable> tables,
                       const DatasetSelection& selection);

/// JoinTables of the files that `given` names (FindFiles), and the log of
/// `selection.with` (MergeLog).
JoinedTable ReadTables(const std::vector<std::string>& given,
                       const DatasetSelection& selection);

/// Rows of another length are left out where rows with missing cells are.
OddRows OddRowsFor(const DatasetSelection& selection);

/// Gives every row of the table `label` in a column kFileColumn, in place of
/// one that is there.
void AddFileColumn(const std::string& label, CsvTable* table);

}  // namespace errmap::data
