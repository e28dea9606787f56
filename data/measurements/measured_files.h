#pragma once

#include <string>
#include <vector>

#include "data/measurements/dataset.h"

namespace errmap::data {

/// Files of one component, as somebody names them, in order of time.
struct MeasuredFiles {
  std::vector<std::string> paths;    // files, at least one
  std::vector<std::string> remarks;  // what was left out, one line each
};

/// The files that `given` (at least one) names; a folder stands for the tables
/// in it. They are put in the order of the dates in their names where all have
/// one, else those in alphabetical order by the numbers in them (day2 before
/// day10). Throws InputError of a study file, of a comparison's residuals, and
/// where a folder has no tables, or tables of several components by their
/// names; `command` is then what the message goes on with ("compare").
MeasuredFiles FindFiles(const std::vector<std::string>& given,
                        const std::string& command = "compare");

/// Whether a table is one that `compare --out` wrote beside its results.json:
/// residuals.csv, or one in residuals/.
bool IsOfComparison(const std::string& table);

/// The date in a file's name ("2024-03-01", also 20240301 and 2024_03_01), else
/// its name without its ending.
std::string FileLabel(const std::string& path);

/// A label of the session that each file is of: its date where the names differ
/// in numbers alone and all have a date, else what stands before a number that
/// begins anew with each session (SessionsOfCounted: "day1" of "day1_run2"),
/// else FileLabel.
std::vector<std::string> SessionsOfFiles(const std::vector<std::string>& paths);

/// "a.csv", "a.csv, b.csv", "a.csv and 3 more": what messages call the files.
std::string NamesOfFiles(const std::vector<std::string>& paths);

}  // namespace errmap::data
