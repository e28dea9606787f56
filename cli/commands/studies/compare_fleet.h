#pragma once

#include <optional>
#include <string>

#include "cli/desk/toml/study_file.h"

namespace errmap::cli {

struct CompareFleetArguments {
  desk::StudyFile study;
  std::string out;
  /// None: all, and put together at the end.
  std::optional<std::string> shard;
  std::string command_line;
  std::string format = "table";
  int jobs = 1;
  bool dry_run = false;
  bool force = false;
  bool quiet = false;
};

/// compare of a study of many components, each by itself; its exit status.
int RunCompareFleet(CompareFleetArguments arguments);

}  // namespace errmap::cli
