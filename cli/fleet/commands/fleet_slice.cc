#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "cli/fleet/commands/compare_fleet.h"
#include "cli/fleet/run/fleet_run.h"
#include "cli/fleet/store/merge.h"
#include "cli/report/number_text.h"
#include "cli/report/report.h"
#include "cli/shell/standard_streams.h"
#include "cli/slice.h"
#include "data/files/atomic_file.h"
#include "data/measurements/column_checks.h"
#include "data/text.h"

namespace errmap::cli {

void AddDeployCommand(CLI::App* app, Run* run);
void AddMergeCommand(CLI::App* app, Run* run);
void AddSubmitCommand(CLI::App* app, Run* run);
void AddWatchCommand(CLI::App* app, Run* run);

namespace {

// The page of one component of a store, or of all of them together.
std::optional<int> ReportStore(const ReportArguments& arguments) {
  if (!fleet::IsStore(arguments.folder)) return std::nullopt;
  const fleet::StorePaths store{arguments.folder};
  if (arguments.component.empty()) {
    if (!arguments.figures.empty() || !arguments.format.empty()) {
      throw UsageError(
          "the report of a store is report.html; --format and --figures go "
          "with --component");
    }
    fleet::DrawFleetReport(store, fleet::ReadSummaries(store));
    return kDone;
  }
  const fleet::FleetRecord fleet = fleet::ReadFleet(store);
  const auto summary = fleet::FindSummary(store, arguments.component);
  // A direction of a component has what was asked of the component.
  if (std::ranges::none_of(fleet.components, [&](const auto& component) {
        return component.name == arguments.component ||
               (summary && summary->asked == component.asked);
      })) {
    throw UsageError(
        fmt::format("no component {} in {}; errmap merge STORE lists them",
                    data::QuotedName(arguments.component),
                    data::PrintablePath(arguments.folder)));
  }
  const models::StudyRecord results =
      fleet::ReadResultsOf(store, arguments.component);
  if (arguments.format == "md") {
    PrintResult(report::ReportMarkdown(results));
  } else if (arguments.format == "html") {
    PrintResult(report::ReportHtml(results));
  } else {
    const std::string page =
        store.InFolder(arguments.component, fleet::kPageFile);
    data::WriteFileAtomically(page, report::ReportHtml(results));
    PrintResult(page + "\n");
  }
  return kDone;
}

// Patterns of the files below the folder.
void InitFleet(const InitFolder& arguments) {
  const fleet::FleetProposal proposal =
      fleet::ProposeFleet(arguments.folder,
                          arguments.beside,
                          arguments.target,
                          "errmap compare --config THIS_FILE --out STORE");
  data::WriteFileAtomically(arguments.out, proposal.text);
  const std::string path = data::PrintablePath(arguments.out);
  PrintFitted(fmt::format(
      "{}: {}{}; check it, then\n"
      "errmap compare --config {} --out STORE\n",
      path,
      report::Count(proposal.files, "file"),
      proposal.left_out.empty()
          ? std::string()
          : fmt::format("; left out, since they cannot be mapped: {}",
                        data::ListOfNames({proposal.left_out.begin(),
                                           proposal.left_out.end()})),
      path));
}

}  // namespace
}  // namespace errmap::cli

namespace errmap::fleet {

cli::Slice AsSlice() {
  constexpr const char* kPurpose = "A fleet of machines";
  return {.commands = {{cli::AddSubmitCommand, kPurpose},
                       {cli::AddMergeCommand, kPurpose},
                       {cli::AddDeployCommand, kPurpose},
                       {cli::AddWatchCommand, kPurpose}},
          .compare = cli::CompareFleet,
          .report = cli::ReportStore,
          .init = cli::InitFleet};
}

}  // namespace errmap::fleet
