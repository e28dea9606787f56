#pragma once

#include <string>
#include <vector>

#include "data/csv.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// Column that joined tables get if no other column distinguishes the files. If
/// a map takes its sessions from it, each file is a session.
inline constexpr const char* kFileColumn = "file";

struct JoinedTable {
  CsvTable table;
  std::vector<std::string> remarks;  // how the files differ, one line each
};

/// Stacks tables (at least one) of one component. Keeps the columns that all
/// have, in the names and units of the first. Upper and lower case may differ,
/// and units are converted. A single table is unchanged. Sessions come from the
/// column that FindSessions finds in each file. If it finds none, a file is a
/// session, even with gaps in its time. If sessions of two files have the same
/// name, the file's label (FileLabel) is added. If no column has sessions,
/// kFileColumn gets them, and files numbered within a day are one session
/// (SessionsOfFiles). If `selection` names that column, no file is divided.
/// Throws InputError if units contradict, or if a column `error*` or one that
/// `selection` names is missing in a file. Otherwise throws as FindSessions
/// does.
JoinedTable JoinTables(std::vector<CsvTable> tables,
                       const DatasetSelection& selection);

/// Returns JoinTables of the files that `given` names (FindFiles), with the log
/// of `selection.with` (MergeLog).
JoinedTable ReadTables(const std::vector<std::string>& given,
                       const DatasetSelection& selection);

/// Leaves out rows of the wrong length if rows with missing cells are left out.
OddRows OddRowsFor(const DatasetSelection& selection);

/// Sets kFileColumn to `label` in every row of the table, replacing a column of
/// that name.
void AddFileColumn(const std::string& label, CsvTable* table);

}  // namespace errmap::data
