#pragma once

#include <string>
#include <vector>

#include "cli/report/screen.h"
#include "models/study/record/study_record.h"

namespace errmap::report {

struct StudyTableOptions {
  bool all = false;         // every row of tables
  bool details = false;     // p values, gaps, times, every sentence
  std::string folder = {};  // for the maps; "" if none
  std::string page = {};    // if written alone; "" if none
  /// Arguments with which `fit` reads the same measurements; empty if there are
  /// none.
  std::vector<std::string> data = {};
  Terminal terminal = {};
  bool next_steps = true;  // the commands to continue with
};

/// Returns a study for a terminal: the answer in at most 12 lines, the table,
/// next steps; with several components one row each.
Screen StudyTable(const models::StudyRecord& record,
                  const StudyTableOptions& options);

}  // namespace errmap::report
