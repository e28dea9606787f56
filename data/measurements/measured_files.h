#pragma once

#include <string>
#include <vector>

#include "data/measurements/dataset.h"

namespace errmap::data {

/// Files of one component as named by the user, in order of time.
struct MeasuredFiles {
  std::vector<std::string> paths;    // files, at least one
  std::vector<std::string> remarks;  // what was left out, one line each
};

/// Returns the files that `given` (at least one) names; a folder stands for the
/// tables in it. If all names have dates, the files are sorted by date.
/// Otherwise those of a folder are sorted alphabetically, with numbers by value
/// (day2 before day10). Throws InputError for a study file, a comparison's
/// residuals, and a folder without tables or with tables of several components
/// by their names.
MeasuredFiles FindFiles(const std::vector<std::string>& given);

/// True if a table was written by `compare --out` beside its results.json:
/// residuals.csv, or one in residuals/.
bool IsOfComparison(const std::string& table);

/// Returns the date in a file's name ("2024-03-01", also 20240301 and
/// 2024_03_01), else its name without extension.
std::string FileLabel(const std::string& path);

/// Returns a label for the session of each file. It is the date if the names
/// differ only in numbers and all have a date. Otherwise it is the text before
/// a number that starts again in each session (SessionsOfCounted: "day1" of
/// "day1_run2"), or else FileLabel.
std::vector<std::string> SessionsOfFiles(const std::vector<std::string>& paths);

/// Returns the name of the files in messages: "a.csv", "a.csv, b.csv", "a.csv
/// and 3 more".
std::string NamesOfFiles(const std::vector<std::string>& paths);

}  // namespace errmap::data
