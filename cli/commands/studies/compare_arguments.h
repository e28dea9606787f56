#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "cli/commands/data_arguments.h"
#include "cli/study_setup/plan/study_plan.h"
#include "cli/study_setup/plan/study_run.h"
#include "cli/study_setup/study_options.h"
#include "cli/study_setup/toml/study_file.h"

namespace CLI {
class App;
}

namespace errmap::cli {

struct CompareArguments;

/// A slice's mode of `errmap compare`, chosen by the slice's options or the
/// study file. It lives as long as the command's arguments.
class CompareMode {
 public:
  virtual ~CompareMode() = default;

  /// Adds the options that follow the option `flag` in the help.
  virtual void AddOptions(std::string_view flag, CLI::App* command) = 0;

  /// Reads its options. If the mode does the whole work, does it and returns
  /// the exit status. Throws UsageError if the options are wrong.
  virtual std::optional<int> Begin(const CompareArguments& /*arguments*/) {
    return std::nullopt;
  }

  /// Returns the plan if this mode makes one.
  virtual std::optional<study_setup::StudyPlan> Plan(
      const CompareArguments& /*arguments*/,
      const study_setup::MakeOwnRecipes& /*own*/) {
    return std::nullopt;
  }

  /// True if the mode adds something to the record of a run. It then needs the
  /// maps of all folds.
  virtual bool Judges() const { return false; }
  virtual void Judge(const study_setup::StudyRun& /*run*/,
                     models::StudyRecord* /*record*/) const {}
};

/// Arguments of `errmap compare`.
struct CompareArguments {
  DataArguments data;
  std::vector<std::string> holdouts;
  std::string model_list;
  std::vector<std::string> models;
  study_setup::StudyConfig
      study;  // what study_setup::ForStudyOptions lists, and the seed
  std::string split;
  std::string save_split;
  std::vector<study_setup::PredictionsFile> predictions;
  bool resume = false;
  std::string cache;  // folder of the last fits, or ""
  bool force = false;
  std::string config;
  std::vector<std::string> changes;  // KEY=VALUE of --set
  bool dry_run = false;
  bool all = false;
  bool details = false;
  std::string page;
  std::set<std::string> given;  // flags present on the command line
  int jobs = 0;
  std::string out;
  std::string format = "table";
  std::string command_line;
  std::vector<std::unique_ptr<CompareMode>> modes = {};  // of the slices

  bool ChoosesModels() const {
    return !model_list.empty() || !models.empty() || !config.empty();
  }
};

/// Adds DATA and all options of the command.
void AddCompareOptions(CLI::App* command, CompareArguments* arguments);

/// Parses the words after "compare". Throws UsageError.
CompareArguments ReadCompareArguments(std::vector<std::string> words);

// What the command line asks for; UsageError if it is wrong.

/// Reads the study file of --config, changed by --set and by the flags of the
/// command line.
study_setup::StudyFile ConfigOfFile(const CompareArguments& arguments);

/// Returns the study of one component that the options alone describe.
study_setup::StudyConfig ConfigOf(const CompareArguments& arguments);

/// Returns the given flags that cannot apply to as many components as `reach`.
std::vector<std::string> GivenOfFewer(const CompareArguments& arguments,
                                      study_setup::Reach reach);

/// Returns the plan from a slice's mode, the study file or DATA. `own` (may be
/// empty) adds the caller's recipes.
study_setup::StudyPlan PlanOf(const CompareArguments& arguments,
                              const study_setup::MakeOwnRecipes& own = {});

/// Returns a description of a study for a terminal: components, rows, groups,
/// hold-outs, models, number of fits, and rough time on `jobs` processors. Then
/// lists the files to be written into `out` ("": none).
std::string PlanText(const study_setup::StudyPlan& plan,
                     int jobs,
                     const std::string& out);

/// Returns a sentence on the time that a study takes; "" below half a minute.
/// Unless its models were `chosen`, also names the faster ones, which together
/// take at most a quarter of that time.
std::vector<std::string> LongRunLines(const study_setup::StudyPlan& plan,
                                      int jobs,
                                      bool chosen);

}  // namespace errmap::cli
