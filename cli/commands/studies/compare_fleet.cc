#include "cli/commands/studies/compare_fleet.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/commands/fleet/claim_store.h"
#include "cli/commands/fleet/fleet_plan_text.h"
#include "cli/commands/fleet/launcher.h"
#include "cli/commands/progress.h"
#include "cli/fleet/run/fleet_plan.h"
#include "cli/fleet/run/fleet_run.h"
#include "cli/fleet/store/fleet_table.h"
#include "cli/fleet/store/merge.h"
#include "cli/report/number_text.h"
#include "cli/shell/interrupt.h"
#include "cli/shell/standard_streams.h"
#include "cli/shell/terminal.h"

namespace errmap::cli {
namespace {

void CheckWords(const CompareFleetArguments& arguments) {
  if (arguments.out.empty() && !arguments.dry_run) {
    throw UsageError(
        "a study of files by pattern, or a share of one, needs --out STORE");
  }
  for (const desk::ComponentConfig& component :
       arguments.study.config.components) {
    if (component.save_split.empty() && component.split.empty() &&
        component.predictions.empty()) {
      continue;
    }
    throw UsageError(
        "--split, --save-split and --predictions are for one component, and "
        "here are many");
  }
}

int StatusOfFleet(const fleet::FleetSummaries& found) {
  const bool any = std::ranges::any_of(
      found.summaries, [](const models::ComponentSummary& summary) {
        return summary.status == models::ModelStatus::kOk;
      });
  if (any) return kDone;
  Say("every component failed");
  return kEveryFitFailed;
}

}  // namespace

int RunCompareFleet(CompareFleetArguments arguments) {
  CheckWords(arguments);
  models::Share share;
  if (arguments.shard) {
    share = ShareOf(*arguments.shard,
                    [](const char* name) { return std::getenv(name); });
  }
  const desk::StudyFile study = fleet::ExpandFleet(std::move(arguments.study));
  if (arguments.dry_run) {
    PrintFitted(FleetPlanText(fleet::PlanFleet(study.config),
                              share.count,
                              arguments.jobs,
                              arguments.out));
    return kDone;
  }
  const fleet::StorePaths store{arguments.out};
  ClaimStore(store, arguments.force);
  fleet::WriteFleet(store, fleet::FleetOf(study, arguments.command_line));
  fleet::FleetRunResult result;
  {
    Progress progress(!arguments.quiet);
    result = fleet::RunFleet(
        study,
        store,
        {.jobs = arguments.jobs,
         .stop = &InstallInterruptFlag(),
         .share = share,
         .command_line = arguments.command_line,
         .remark = Sayer(arguments.quiet),
         .progress = [&](int done, int all) {
           progress.Show({.done = done, .all = all, .what = "components"});
         }});
  }
  if (!arguments.quiet || result.interrupted) {
    Say(fmt::format(
        "{}{}: {} fitted, {} unchanged, {} failed{}",
        arguments.shard
            ? fmt::format("share {} of 0 to {}, ", share.index, share.count - 1)
            : std::string(),
        report::Count(result.components, "component"),
        result.fitted,
        result.kept,
        result.failed,
        result.interrupted ? "; interrupted, the same command goes on" : ""));
  }
  if (result.interrupted) return kInterrupted;
  if (arguments.shard) return kDone;
  const fleet::FleetSummaries found = fleet::MergeStore(store);
  if (!found.missing.empty()) Say(fleet::MissingWords(found));
  PrintResult(fleet::FormattedFleet(
      found.summaries, arguments.format, OutputTerminal().columns));
  return StatusOfFleet(found);
}

}  // namespace errmap::cli
