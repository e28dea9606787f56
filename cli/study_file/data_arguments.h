#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/study_file/given_error.h"
#include "cli/study_file/study_config.h"
#include "data/measurements/dataset.h"
#include "models/error_model.h"

namespace CLI {
class App;
}

namespace errmap::cli {

/// What a command is told about the data file.
struct DataArguments {
  std::string file;
  std::string target;
  std::string inputs;   // comma-separated
  std::string exclude;  // comma-separated
  std::string group;
  std::string time;
  std::string session;
  std::string align = "none";
  std::string weight;
  std::string missing = "error";
  std::string faults = "keep";
  bool keep_dead = false;
  bool quiet = false;
};

/// Adds DATA.csv and its options to a command.
void AddDataArguments(CLI::App* command, DataArguments* arguments);

/// Reads the file and picks its columns; remarks go to stderr unless quiet.
data::PreparedDataset ReadData(const DataArguments& arguments);

/// --missing and --faults, as commands that read measurements have them.
void AddRowOptions(CLI::App* command,
                   std::string* missing,
                   std::string* faults);
data::MissingPolicy MissingPolicyOf(const std::string& missing);
data::FaultPolicy FaultPolicyOf(const std::string& faults);

/// ", 70 groups (cycle), 2 sessions (day)" or ", ... one run", to follow a
/// number of rows.
std::string UnitsText(const data::Dataset& dataset);

/// The target's name, and what was taken off it.
std::string TargetText(const data::Dataset& dataset);

/// Of "none" or "first".
data::Alignment AlignOf(const std::string& text);

/// What a component says of its columns and rows.
data::DatasetSelection SelectionOf(const ComponentConfig& component);

/// Rows of another table with the columns of `like` (target, inputs, groups,
/// time and sessions) and of `component` (weight, missing, faults, where).
data::PreparedDataset MakeDataLike(const data::CsvTable& table,
                                   const data::PreparedDataset& like,
                                   const ComponentConfig& component);

/// Splits "A,B" at commas outside double quotes and takes the quotes off.
/// Throws UsageError naming `flag`.
std::vector<std::string> SplitNames(const std::string& list, const char* flag);

/// "2um" or "0.002" of a flag that was given; throws UsageError naming `flag`.
GivenError ErrorOfFlag(const char* flag,
                       const std::optional<std::string>& text,
                       bool may_be_zero);

/// Recipe of a SPEC; throws UsageError where it is wrong.
std::unique_ptr<models::ModelRecipe> RecipeFromArgument(
    const std::string& spec);

/// Says something about the run on stderr: "errmap: ...".
void Say(const std::string& line);
/// Each of `lines`, unless `quiet`.
void SayUnless(bool quiet, const std::vector<std::string>& lines);

/// --keep-paths, which the program looks for before any command does.
void AddKeepPathsFlag(CLI::App* command);

/// --force, which lets a command replace files that errmap did not write.
void AddForceFlag(CLI::App* command, bool* force);

/// --seed N, a whole number from 0.
void AddSeedOption(CLI::App* command,
                   std::uint64_t* seed,
                   const std::string& what = "Seed of all random choices");

}  // namespace errmap::cli
