#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/shell/command_options.h"
#include "cli/study_setup/given_error.h"
#include "cli/study_setup/study_options.h"
#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/history/map_log.h"

namespace CLI {
class App;
}

namespace errmap::cli {

/// Arguments of a command about its data files.
struct DataArguments {
  std::vector<std::string> files;  // or folders of files
  data::DatasetSelection selection;
  bool quiet = false;

  /// Returns all paths that the command reads: these files and `others`.
  std::vector<std::string> PathsWith(std::vector<std::string> others) const;
};

/// Returns the flag of a study file's key: "--keep-dead" for "keep_dead".
std::string FlagOf(std::string_view key);

/// Visits a list of cli/study_setup/study_options.h and adds the flag of each
/// option to a command. The visited members must outlive the command.
class FlagAdder {
 public:
  explicit FlagAdder(CLI::App* command, std::string_view heading = {})
      : command_(command), heading_(heading) {}

  void operator()(const study_setup::StudyOption& option,
                  std::string& text) const;
  /// The flag's value is a list of names separated by commas.
  void operator()(const study_setup::StudyOption& option,
                  std::vector<std::string>& names) const;
  void operator()(const study_setup::StudyOption& option, bool& flag) const;
  void operator()(const study_setup::StudyOption& option,
                  study_setup::GivenError& error) const;
  template <typename Value>
  void operator()(const study_setup::StudyOption& option,
                  Value& chosen,
                  const std::vector<Value>& values) const {
    AddChoice(command_, FlagOf(option.key), option.help, values, &chosen);
    Finish(option);
  }

 private:
  void Finish(const study_setup::StudyOption& option) const;

  CLI::App* command_;
  std::string_view heading_;
};

/// Adds DATA.csv and its options to a command.
void AddDataArguments(CLI::App* command, DataArguments* arguments);

/// Reads the files and selects their columns. Remarks go to stderr unless
/// quiet.
data::PreparedDataset ReadData(const DataArguments& arguments);

/// Adds --missing and --faults to a command that reads measurements.
void AddRowOptions(CLI::App* command,
                   data::MissingPolicy* missing,
                   data::FaultPolicy* faults);

/// Adds --after, --time and --session to a command.
void AddMapDataArguments(CLI::App* command,
                         models::MapDataArguments* arguments);
/// Adds --with and --clock-offset to a command.
void AddJoinedLogArguments(CLI::App* command,
                           models::MapDataArguments* arguments);
/// Adds --target to a command that reads measured errors.
void AddTargetOfMap(CLI::App* command, models::MapDataArguments* arguments);
/// Adds --from-rest to a command that predicts rows.
void AddFromRest(CLI::App* command, models::MapDataArguments* arguments);

/// Parses the value of `flag`, such as "2um" or "0.002". Throws UsageError
/// naming `flag`.
study_setup::GivenError ErrorOfFlag(const char* flag,
                                    const std::optional<std::string>& text,
                                    bool may_be_zero);

/// Returns --goal in the target's unit, or NaN if it is not given. Unless
/// `quiet`, prints a remark if a bare number is too large for errors of `size`
/// (RMS, target's unit). Throws UsageError.
double GoalOrNone(const std::optional<std::string>& goal,
                  const data::ColumnInfo& target,
                  double size,
                  bool quiet);

/// Returns models::SplitList of a flag's value. Throws UsageError naming
/// `flag`.
std::vector<std::string> SplitFlag(const std::string& flag,
                                   const std::string& list);

/// Returns --jobs, or the number of the machine's processors if it is 0.
int JobsOf(int jobs);

/// Returns the recipe of a SPEC. Throws UsageError if the SPEC is wrong.
std::unique_ptr<models::ModelRecipe> RecipeFromArgument(
    const std::string& spec);

/// Writes a message about the run to stderr: "errmap: ...".
void Warn(const std::string& line);
/// Writes each of `lines` as a message, unless `quiet`.
void SayUnless(bool quiet, const std::vector<std::string>& lines);
/// Returns the function Warn, or an empty one if `quiet`.
std::function<void(const std::string&)> Sayer(bool quiet);

/// Adds --keep-paths to the help. The program reads it before any command runs.
void AddKeepPathsFlag(CLI::App* command);

/// Adds --no-cache. `cache` is models::DefaultCacheFolder() without the flag,
/// and "" with it.
void AddCacheFlag(CLI::App* command, std::string* cache);

/// Adds --quiet to a command without progress.
void AddQuietFlag(CLI::App* command, bool* quiet);

/// Adds --force, which lets a command replace files that errmap did not write.
void AddForceFlag(CLI::App* command, bool* force);

/// Adds --seed N, a whole number from 0.
void AddSeedOption(CLI::App* command,
                   std::uint64_t* seed,
                   const std::string& what = "Seed of all random choices");

/// Copies a reading from a file (`errmap read --format json`) to `selection`:
/// columns, sign, units and the pause that separates sessions. Throws
/// data::InputError if the file is not a reading.
void TakeReading(const std::string& path, data::DatasetSelection* selection);

/// Adds --format table|json, for commands without more formats.
void AddFormatOption(CLI::App* command, std::string* format);

/// Adds --format with table, json and the formats of report/table.h. `words`
/// explain the option in the help.
void AddTableFormatOption(CLI::App* command,
                          const std::string& words,
                          std::string* format);

}  // namespace errmap::cli
