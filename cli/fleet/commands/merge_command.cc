#include <string>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/fleet/store/merge.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "data/text.h"

namespace errmap::cli {
namespace {

struct MergeArguments {
  std::string store;
  std::string format = "table";
};

int RunMerge(const MergeArguments& arguments) {
  const fleet::FleetSummaries found =
      fleet::MergeStore(fleet::StorePaths{arguments.store});
  if (!found.damaged.empty()) {
    Warn(fmt::format(
        "errmap.sqlite was damaged: it is rewritten, without deployments "
        "and what was watched, and the old one is {}; errmap deploy STORE "
        "deploys maps again",
        data::PrintablePath(found.damaged)));
  }
  if (!found.missing.empty()) Warn(fleet::MissingWords(found));
  PrintResult(fleet::FormattedFleet(
      found.summaries, arguments.format, OutputTerminal().columns));
  return found.missing.empty() ? kDone : kEveryFitFailed;
}

}  // namespace

void AddMergeCommand(CLI::App* app, Run* run) {
  const Command<MergeArguments> command(
      app, run, "merge", "Join the shares of a fleet study in one database");
  AddOption(command, "STORE DIR", command->store)
      .About("Folder that errmap compare --shard wrote into")
      .Required();
  AddTableFormatOption(command,
                       "What to print; csv and md have a row per component",
                       &command->format);
  SetFooter(
      command,
      R"(Reads the summaries of the components and writes errmap.sqlite and
report.html there, completely or not at all. Others may read the database
meanwhile.
Exit status: 0 done, 3 no usable store, 4 components are missing.
Example: errmap merge fleet)");
  command.Runs(RunMerge);
}

}  // namespace errmap::cli
