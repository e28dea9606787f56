#pragma once

#include <string>
#include <vector>

#include "cli/report/screen.h"
#include "models/study/record/study_record.h"

namespace errmap::report {

struct StudyTableOptions {
  bool all = false;         // every row of tables
  bool details = false;     // p values, gaps, times, every sentence
  std::string folder = {};  // that the maps are written to; "" none
  std::string page = {};    // written alone; "" none
  /// The measurements as fit can open them, empty where it cannot have the same
  /// rows.
  std::vector<std::string> data = {};
  Terminal terminal = {};
  bool next_steps = true;  // the commands to go on with
};

/// A study as a terminal shows it: the verdict in at most eight lines, the
/// table, what to do next; of several components a row each.
Screen StudyTable(const models::StudyRecord& record,
                  const StudyTableOptions& options);

}  // namespace errmap::report
