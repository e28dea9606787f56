#include "cli/commands/data_arguments.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <initializer_list>
#include <stdexcept>
#include <system_error>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/command.h"
#include "cli/commands/choice_option.h"
#include "cli/report/words/fault_text.h"
#include "cli/shell/command_reference.h"
#include "cli/shell/standard_streams.h"
#include "data/shown_path.h"
#include "models/model_spec.h"
#include "models/recipe_catalog.h"

namespace errmap::cli {

namespace {

// Splits "A,B" at commas outside double quotes and takes the quotes off.
std::vector<std::string> SplitNames(const std::string& flag,
                                    const std::string& list) {
  std::vector<std::string> names;
  if (list.empty()) return names;
  try {
    names = models::SplitList(list);
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("{}: {}", flag, error.what()));
  }
  for (std::string& name : names) {
    if (name.size() >= 2 && name.front() == '"' && name.back() == '"') {
      name = name.substr(1, name.size() - 2);
      for (std::size_t at = 0; (at = name.find("\"\"", at)) != name.npos;
           ++at) {
        name.erase(at, 1);  // RFC 4180: two quotes stand for one
      }
    }
  }
  return names;
}

void AddNames(CLI::App* command,
              const std::string& flag,
              const std::string& what,
              std::vector<std::string>* names) {
  command
      ->add_option_function<std::string>(
          flag,
          [flag, names](const std::string& list) {
            *names = SplitNames(flag, list);
          },
          what)
      ->type_name("A,B,...");
}

}  // namespace

void AddDataArguments(CLI::App* command, DataArguments* arguments) {
  data::DatasetSelection& selection = arguments->selection;
  command->add_option("DATA", arguments->file, "CSV file, one row per sample")
      ->required()
      ->type_name("FILE.csv");
  command
      ->add_option("--target",
                   selection.target,
                   "Column to be mapped (default: the only one named error*)")
      ->type_name("COL");
  AddNames(command,
           "--inputs",
           "Columns to map from (default: all other numeric)",
           &selection.inputs);
  AddNames(
      command, "--exclude", "Columns never to map from", &selection.exclude);
  command
      ->add_option("--group",
                   selection.group,
                   "Column of warm-up cycles (default: cycle)\nor of days or "
                   "segments: what tells groups of rows apart")
      ->type_name("COL");
  command
      ->add_option("--time",
                   selection.time,
                   "Column of times (default: the only time*)\nor of dates; "
                   "none: the number of the row counts")
      ->type_name("COL");
  command
      ->add_option("--session",
                   selection.session,
                   "Column of sessions (default: session, day or run)\nthat "
                   "is, uninterrupted runs; none: cut where time breaks off")
      ->type_name("COL");
  AddChoice(command,
            "--align",
            "first: take each session's first value off the target",
            {data::Alignment::kFirst, data::Alignment::kNone},
            &selection.align);
  command->add_option("--weight", selection.weight, "Column of row weights > 0")
      ->type_name("COL");
  AddRowOptions(command, &selection.missing, &selection.faults);
  command->add_flag("--keep-dead",
                    selection.keep_dead,
                    "Keep inputs that hold one value only (failed sensors)");
  MarkSeldom(command, {"--align", "--weight", "--keep-dead"});
  command->add_flag(
      "--quiet", arguments->quiet, "No remarks and no progress on stderr");
}

void AddRowOptions(CLI::App* command,
                   data::MissingPolicy* missing,
                   data::FaultPolicy* faults) {
  AddChoice(command,
            "--missing",
            "What cells without a number do (empty, NA, #N/A, -): error or "
            "drop-rows",
            {data::MissingPolicy::kError, data::MissingPolicy::kDropRows},
            missing);
  AddChoice(command,
            "--faults",
            "What becomes of rows with failed readings (9999, jumps of a "
            "thermometer, zeros of a lost beam) or that stand twice, which "
            "are named: keep or drop-rows",
            {data::FaultPolicy::kKeep, data::FaultPolicy::kDropRows},
            faults);
  MarkSeldom(command, {"--missing", "--faults"});
}

void AddMapLogArguments(CLI::App* command, models::MapLogArguments* arguments) {
  command
      ->add_option("--after",
                   arguments->after,
                   "Rows before these: the filters of a map with a memory run "
                   "through them first")
      ->type_name("EARLIER.csv");
  command
      ->add_option("--time",
                   arguments->time,
                   "Column of times (default: the only time*)\nor of dates")
      ->type_name("COL");
  command
      ->add_option("--session",
                   arguments->session,
                   "Column of sessions (default: that of the map)\nthat is, "
                   "uninterrupted runs")
      ->type_name("COL");
}

data::PreparedDataset ReadData(const DataArguments& arguments) {
  data::PreparedDataset prepared =
      data::MakeDataset(data::ReadCsv(arguments.file), arguments.selection);
  SayUnless(arguments.quiet, prepared.remarks);
  SayUnless(arguments.quiet,
            report::FaultLines(
                prepared, arguments.selection.faults, report::FaultUse::kFit));
  return prepared;
}

desk::GivenError ErrorOfFlag(const char* flag,
                             const std::optional<std::string>& text,
                             bool may_be_zero) {
  if (!text) return {};
  try {
    return desk::ParseGivenError(*text, may_be_zero);
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("{} {}", flag, error.what()));
  }
}

int JobsOf(int jobs) {
  if (jobs > 0) return jobs;
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

std::unique_ptr<models::ModelRecipe> RecipeFromArgument(
    const std::string& spec) {
  try {
    return models::MakeRecipe(spec);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

void Say(const std::string& line) { WriteMessage(line); }

void SayUnless(bool quiet, const std::vector<std::string>& lines) {
  if (quiet) return;
  for (const std::string& line : lines) Say(line);
}

std::function<void(const std::string&)> Sayer(bool quiet) {
  if (quiet) return {};
  return Say;
}

void AddKeepPathsFlag(CLI::App* command) {
  command->add_flag_callback(
      "--keep-paths",
      [] { data::KeepPaths(); },
      "Write absolute paths into reports, maps and journals; without it, the "
      "files' names only");
  MarkSeldom(command, {"--keep-paths"});
}

void AddForceFlag(CLI::App* command, bool* force) {
  command->add_flag("--force",
                    *force,
                    "Replace files in the folder that errmap did not write, or "
                    "that were changed since; never one that is read");
  MarkSeldom(command, {"--force"});
}

void MarkSeldom(CLI::App* command, const std::vector<const char*>& names) {
  for (const char* name : names) command->get_option(name)->group(kSeldom);
}

void AddSeedOption(CLI::App* command,
                   std::uint64_t* seed,
                   const std::string& what) {
  command->add_option("--seed", *seed, what)
      ->check([](const std::string& text) {
        // CLI11 would take -1 and 2^64 for the largest number there is.
        std::uint64_t number = 0;
        const char* const end = text.data() + text.size();
        const auto [rest, error] = std::from_chars(text.data(), end, number);
        return error == std::errc() && rest == end
                   ? ""
                   : "give a whole number from 0 to 18446744073709551615";
      })
      ->capture_default_str()
      ->type_name("N");
}

}  // namespace errmap::cli
