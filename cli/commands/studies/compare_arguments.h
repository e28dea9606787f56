#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cli/commands/data_arguments.h"
#include "cli/desk/study_config.h"

namespace CLI {
class App;
}

namespace errmap::cli {

/// What `errmap compare` is told.
struct CompareArguments {
  DataArguments data;
  std::vector<std::string> holdouts;
  std::string model_list;
  std::vector<std::string> models;
  desk::StudyConfig study;  // what desk::ForStudyOptions lists, and the seed
  std::string split;
  std::string save_split;
  std::vector<desk::PredictionsFile> predictions;
  bool resume = false;
  std::string cache;  // folder of the last fits, or ""
  bool force = false;
  std::string config;
  std::vector<std::string> changes;  // KEY=VALUE of --set
  bool dry_run = false;
  bool all = false;
  bool details = false;
  std::string page;
  std::set<std::string> given;  // flags that stand on the command line
  int jobs = 0;
  std::string out;
  std::optional<std::string> shard;
  std::string format = "table";
  std::string command_line;
  std::string machine;
  int later = 1;  // sessions that judge the machine
};

/// Adds all options of the command and DATA.
void AddCompareOptions(CLI::App* command, CompareArguments* arguments);

/// What words after "compare" say. Throws UsageError.
CompareArguments ReadCompareArguments(std::vector<std::string> words);

}  // namespace errmap::cli
