#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/desk/given_error.h"
#include "cli/desk/study_options.h"
#include "cli/shell/command_options.h"
#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/history/map_log.h"

namespace CLI {
class App;
}

namespace errmap::cli {

/// What a command is told about the data files.
struct DataArguments {
  std::vector<std::string> files;  // or folders
  data::DatasetSelection selection;
  bool quiet = false;

  /// What the command reads: these files and `others`.
  std::vector<std::string> PathsWith(std::vector<std::string> others) const;
};

/// "--keep-dead" of "keep_dead".
std::string FlagOf(std::string_view key);

/// Visitor of a list of cli/desk/study_options.h: adds the flag of each option
/// to a command. The members must outlive it.
class FlagAdder {
 public:
  explicit FlagAdder(CLI::App* command) : command_(command) {}

  void operator()(const desk::StudyOption& option, std::string& text) const;
  /// Separated by commas.
  void operator()(const desk::StudyOption& option,
                  std::vector<std::string>& names) const;
  void operator()(const desk::StudyOption& option, bool& flag) const;
  void operator()(const desk::StudyOption& option,
                  desk::GivenError& error) const;
  template <typename Value>
  void operator()(const desk::StudyOption& option,
                  Value& chosen,
                  const std::vector<Value>& values) const {
    AddChoice(command_, FlagOf(option.key), option.help, values, &chosen);
    Finish(option);
  }

 private:
  void Finish(const desk::StudyOption& option) const;

  CLI::App* command_;
};

/// Adds DATA.csv and its options to a command.
void AddDataArguments(CLI::App* command, DataArguments* arguments);

/// Reads the files and picks their columns; remarks go to stderr unless quiet.
data::PreparedDataset ReadData(const DataArguments& arguments);

/// --missing and --faults, as commands that read measurements have them.
void AddRowOptions(CLI::App* command,
                   data::MissingPolicy* missing,
                   data::FaultPolicy* faults);

/// Adds --after, --time and --session to a command.
void AddMapLogArguments(CLI::App* command, models::MapLogArguments* arguments);
/// --from-rest, where rows are predicted.
void AddFromRest(CLI::App* command, models::MapLogArguments* arguments);

/// "2um" or "0.002" of a flag that was given; throws UsageError naming `flag`.
desk::GivenError ErrorOfFlag(const char* flag,
                             const std::optional<std::string>& text,
                             bool may_be_zero);

/// --goal in the target's unit, NaN where none is given. Throws UsageError.
double GoalOrNone(const std::optional<std::string>& goal,
                  const data::Unit& target);

/// --jobs, or where it is 0 the processors of the machine.
int JobsOf(int jobs);

/// Recipe of a SPEC; throws UsageError where it is wrong.
std::unique_ptr<models::ModelRecipe> RecipeFromArgument(
    const std::string& spec);

/// Says something about the run on stderr: "errmap: ...".
void Say(const std::string& line);
/// Each of `lines`, unless `quiet`.
void SayUnless(bool quiet, const std::vector<std::string>& lines);
/// Say, or nothing where `quiet`.
std::function<void(const std::string&)> Sayer(bool quiet);

/// --keep-paths, which the program looks for before any command does.
void AddKeepPathsFlag(CLI::App* command);

/// --no-cache: `cache` is models::DefaultCacheFolder() without it, else "".
void AddCacheFlag(CLI::App* command, std::string* cache);

/// --force, which lets a command replace files that errmap did not write.
void AddForceFlag(CLI::App* command, bool* force);

/// --seed N, a whole number from 0.
void AddSeedOption(CLI::App* command,
                   std::uint64_t* seed,
                   const std::string& what = "Seed of all random choices");

}  // namespace errmap::cli
