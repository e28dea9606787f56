#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/output/claimed_folder.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "cli/slice.h"
#include "cli/study_setup/plan/study_plan.h"
#include "cli/study_setup/toml/study_file.h"
#include "data/files/atomic_file.h"
#include "data/text.h"

namespace errmap::cli {
namespace {

struct InitArguments {
  std::string data;
  std::string target;
  std::string out = "study.toml";
  bool force = false;
};

// The data file as seen from the study file's folder.
std::string PathFrom(const std::string& study_file, const std::string& data) {
  const std::filesystem::path folder =
      std::filesystem::path(study_file).parent_path();
  if (folder.empty() || std::filesystem::path(data).is_absolute()) return data;
  return std::filesystem::path(data).lexically_relative(folder).empty()
             ? std::filesystem::absolute(data).string()
             : std::filesystem::proximate(data, folder).string();
}

int RunInit(const InitArguments& arguments) {
  CheckOutputName("-o", arguments.out, {arguments.data});
  if (!arguments.force && std::filesystem::exists(arguments.out)) {
    throw UsageError(
        fmt::format("{} exists; write another with -o, or replace it with "
                    "--force",
                    data::PrintablePath(arguments.out)));
  }
  if (std::filesystem::is_directory(arguments.data)) {
    for (const Slice& slice : Slices()) {
      if (slice.init == nullptr) continue;
      slice.init({.folder = arguments.data,
                  .beside = PathFrom(arguments.out, arguments.data),
                  .target = arguments.target,
                  .out = arguments.out});
      return kDone;
    }
  }
  study_setup::StudyConfig config =
      study_setup::ProposeStudy(data::ReadCsv(arguments.data));
  for (study_setup::ComponentConfig& component : config.components) {
    component.selection.target = arguments.target;
  }
  const study_setup::StudyPlan plan = study_setup::PlanStudy(config);
  data::WriteFileAtomically(
      arguments.out,
      study_setup::StudyFileText(
          plan,
          PathFrom(arguments.out, arguments.data),
          "errmap compare --config THIS_FILE [--out DIR]"));
  PrintFitted(fmt::format(
      "{}: {} component{}; check it, then\nerrmap compare --config {}\n",
      data::PrintablePath(arguments.out),
      plan.components.size(),
      plan.components.size() == 1 ? "" : "s",
      data::PrintablePath(arguments.out)));
  return kDone;
}

}  // namespace

void AddInitCommand(CLI::App* app, Run* run) {
  const Command<InitArguments> command(
      app,
      run,
      "init",
      "Write a commented study file for a data file or a folder");
  AddOption(command, "DATA FILE.csv|DIR", command->data)
      .About(
          "CSV file, one row per reading; or a folder of such files, for many "
          "machines and components")
      .Required();
  AddOption(command, "--target COL", command->target)
      .About("Column of the error to map (default: by its name)");
  AddOption(command, "-o,--output study.toml", command->out)
      .About("Study file to write")
      .ShowDefault();
  AddFlag(command, "--force", command->force).About("Replace an existing file");
  SetFooter(
      command,
      R"(A column of few values, such as direction, becomes one component per value.
Example: errmap init data/sets/turning_centre/six_days.csv -o study.toml)");
  command.Runs(RunInit);
}

}  // namespace errmap::cli
