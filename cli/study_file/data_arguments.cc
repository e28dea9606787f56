#include "cli/study_file/data_arguments.h"

#include <charconv>
#include <cstdint>
#include <stdexcept>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/shell/shown_path.h"
#include "cli/shell/standard_streams.h"
#include "cli/study_file/fault_text.h"
#include "models/comparison/compare.h"
#include "models/model_spec.h"
#include "models/recipe_catalog.h"
#include "models/report/number_text.h"

namespace errmap::cli {

void AddDataArguments(CLI::App* command, DataArguments* arguments) {
  command->add_option("DATA", arguments->file, "CSV file, one row per sample")
      ->required()
      ->type_name("FILE.csv");
  command
      ->add_option("--target",
                   arguments->target,
                   "Column to be mapped (default: the only one named error*)")
      ->type_name("COL");
  command
      ->add_option("--inputs",
                   arguments->inputs,
                   "Columns to map from (default: every other numeric column)")
      ->type_name("A,B,...");
  command
      ->add_option("--exclude", arguments->exclude, "Columns never to map from")
      ->type_name("A,B,...");
  command
      ->add_option("--group",
                   arguments->group,
                   "Column that tells warm-up cycles, days or segments apart "
                   "(default: cycle)")
      ->type_name("COL");
  command
      ->add_option("--time",
                   arguments->time,
                   "Column of times or dates (default: the only time*; none: "
                   "the number of the row)")
      ->type_name("COL");
  command
      ->add_option("--session",
                   arguments->session,
                   "Column that tells uninterrupted runs apart (default: "
                   "session, day or run; none: cut where time breaks off)")
      ->type_name("COL");
  command
      ->add_option("--align",
                   arguments->align,
                   "first: take each session's first value off the target")
      ->check(CLI::IsMember({"first", "none"}))
      ->type_name("first|none")
      ->capture_default_str();
  command
      ->add_option("--weight", arguments->weight, "Column of row weights > 0")
      ->type_name("COL");
  AddRowOptions(command, &arguments->missing, &arguments->faults);
  command->add_flag("--keep-dead",
                    arguments->keep_dead,
                    "Keep inputs that hold one value only (failed sensors)");
  command->add_flag(
      "--quiet", arguments->quiet, "No remarks and no progress on stderr");
}

void AddRowOptions(CLI::App* command,
                   std::string* missing,
                   std::string* faults) {
  command
      ->add_option("--missing",
                   *missing,
                   "What empty, NA and NaN cells do: error or drop-rows")
      ->check(CLI::IsMember({"error", "drop-rows"}))
      ->type_name("error|drop-rows")
      ->capture_default_str();
  command
      ->add_option("--faults",
                   *faults,
                   "What becomes of rows with failed readings (9999, jumps of "
                   "a thermometer), which are named: keep or drop-rows")
      ->check(CLI::IsMember({"keep", "drop-rows"}))
      ->type_name("keep|drop-rows")
      ->capture_default_str();
}

data::MissingPolicy MissingPolicyOf(const std::string& missing) {
  return missing == "error" ? data::MissingPolicy::kError
                            : data::MissingPolicy::kDropRows;
}

data::FaultPolicy FaultPolicyOf(const std::string& faults) {
  return faults == "keep" ? data::FaultPolicy::kKeep
                          : data::FaultPolicy::kDropRows;
}

std::vector<std::string> SplitNames(const std::string& list, const char* flag) {
  if (list.empty()) return {};
  std::vector<std::string> names;
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

data::PreparedDataset ReadData(const DataArguments& arguments) {
  const data::DatasetSelection selection{
      .target = arguments.target,
      .inputs = SplitNames(arguments.inputs, "--inputs"),
      .exclude = SplitNames(arguments.exclude, "--exclude"),
      .group = arguments.group,
      .time = arguments.time,
      .session = arguments.session,
      .weight = arguments.weight,
      .align = AlignOf(arguments.align),
      .missing = MissingPolicyOf(arguments.missing),
      .faults = FaultPolicyOf(arguments.faults),
      .keep_dead = arguments.keep_dead};
  data::PreparedDataset prepared =
      data::MakeDataset(data::ReadCsv(arguments.file), selection);
  if (!arguments.quiet) {
    for (const std::string& remark : prepared.remarks) Say(remark);
    for (const std::string& line :
         FaultLines(prepared, selection.faults, FaultUse::kFit)) {
      Say(line);
    }
  }
  return prepared;
}

std::string UnitsText(const data::Dataset& dataset) {
  std::string text = ", no groups";
  if (dataset.has_groups()) {
    text = fmt::format(
        ", {} ({})",
        report::Count(static_cast<long long>(dataset.groups().labels.size()),
                      "group"),
        dataset.groups().column);
  }
  if (!dataset.has_sessions()) return text + ", one run";
  const std::string& column = dataset.log()->sessions.column;
  return text + ", " + report::Count(dataset.num_sessions(), "session") +
         (column.empty() ? "" : " (" + column + ")");
}

std::string TargetText(const data::Dataset& dataset) {
  return dataset.target().name + (dataset.align() == data::Alignment::kFirst
                                      ? " less each session's first value"
                                      : "");
}

data::Alignment AlignOf(const std::string& text) {
  return text == "first" ? data::Alignment::kFirst : data::Alignment::kNone;
}

data::DatasetSelection SelectionOf(const ComponentConfig& component) {
  return {.target = component.target,
          .inputs = component.inputs,
          .exclude = component.exclude,
          .group = component.group,
          .time = component.time,
          .session = component.session,
          .weight = component.weight,
          .align = component.align,
          .missing = component.missing,
          .faults = component.faults,
          .keep_dead = component.keep_dead,
          .where = component.where};
}

data::PreparedDataset MakeDataLike(const data::CsvTable& table,
                                   const data::PreparedDataset& like,
                                   const ComponentConfig& component) {
  return data::MakeDataset(
      table, models::SelectionLike(like.dataset, SelectionOf(component)));
}

GivenError ErrorOfFlag(const char* flag,
                       const std::optional<std::string>& text,
                       bool may_be_zero) {
  if (!text) return {};
  try {
    return ParseGivenError(*text, may_be_zero);
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("{} {}", flag, error.what()));
  }
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

void AddKeepPathsFlag(CLI::App* command) {
  command->add_flag_callback(
      "--keep-paths",
      [] { KeepPaths(); },
      "Write absolute paths into reports, maps and journals; without it, the "
      "files' names only");
}

void AddForceFlag(CLI::App* command, bool* force) {
  command->add_flag("--force",
                    *force,
                    "Replace files in the folder that errmap did not write, or "
                    "that were changed since; never one that is read");
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
