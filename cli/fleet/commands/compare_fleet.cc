#include "cli/fleet/commands/compare_fleet.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/commands/progress.h"
#include "cli/commands/studies/compare_arguments.h"
#include "cli/fleet/commands/launcher.h"
#include "cli/fleet/run/fleet_run.h"
#include "cli/fleet/store/merge.h"
#include "cli/report/number_text.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "cli/study_setup/plan/study_forecast.h"
#include "data/files/prepare_folder.h"
#include "data/text.h"

namespace errmap::cli {
namespace {

namespace fs = std::filesystem;

// Whether there is nothing in a folder but what is being written, or was when a
// task was killed: another task may be about to make it a store.
bool IsFree(const std::string& folder) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (!entry->path().filename().string().starts_with(".errmap-")) {
      return false;
    }
  }
  return true;
}

// For a terminal: on `tasks` shares of `jobs` processors.
std::string PlanText(const fleet::FleetPlan& plan,
                     std::int64_t tasks,
                     int jobs,
                     const std::string& out) {
  std::string text = fmt::format(
      "{}, of which {} were examined\nsome {:.0f} fits in all; roughly {} on "
      "{} of {}\n",
      report::Count(plan.components, "component"),
      plan.looked_at,
      plan.fits,
      study_setup::RoughTimeText(plan.seconds /
                                 static_cast<double>(tasks * jobs)),
      report::Count(tasks, "task"),
      report::Count(jobs, "job"));
  for (const std::string& line : plan.unusable) {
    text += "unusable: " + line + "\n";
  }
  text += out.empty() ? std::string("no files (give --out STORE for them)\n")
                      : fmt::format(
                            "files in {}: fleet.json, components/, "
                            "errmap.sqlite, report.html\n",
                            data::PrintablePath(out));
  return text + "Nothing was fitted or written (--dry-run).\n";
}

void CheckWords(const CompareArguments& arguments,
                const study_setup::StudyConfig& config) {
  if (!arguments.page.empty()) {
    throw UsageError(
        "-o writes the page of one component, but this study has many; leave "
        "it out: --out has a page for each, and report.html for all");
  }
  if (arguments.out.empty() && !arguments.dry_run) {
    throw UsageError(
        "a study of files by pattern, or a share of one, needs --out STORE");
  }
  for (const study_setup::ComponentConfig& component : config.components) {
    if (component.save_split.empty() && component.split.empty() &&
        component.predictions.empty()) {
      continue;
    }
    throw UsageError(
        "--split, --save-split and --predictions are for one component, but "
        "this study has many");
  }
}

int StatusOf(const fleet::FleetSummaries& found) {
  const bool any = std::ranges::any_of(
      found.summaries, [](const fleet::ComponentSummary& summary) {
        return summary.status == models::ModelStatus::kOk;
      });
  if (any) return kDone;
  Warn("every component failed");
  return kEveryFitFailed;
}

class FleetMode : public CompareMode {
 public:
  void AddOptions(std::string_view flag, CLI::App* command) override {
    if (flag != "--out") return;
    AddOption(command, "--shard I/N|env", shard_)
        .About(
            "Run only share I (0 to N-1) of a study of many components\nenv: "
            "the share that mpirun or Slurm gave this task. errmap merge STORE "
            "joins the shares");
    MarkSeldom(command, {"--shard"});
  }

  std::optional<int> Begin(const CompareArguments& arguments) override {
    if (arguments.config.empty()) {
      if (shard_) {
        throw UsageError(
            "--shard deals the components of a study file; name it "
            "with --config");
      }
      return std::nullopt;
    }
    const fleet::FleetStudy study =
        fleet::WithPatterns(ConfigOfFile(arguments));
    if (!study.has_patterns() && !shard_ &&
        (arguments.out.empty() || !fleet::IsStore(arguments.out))) {
      return std::nullopt;
    }
    CheckWords(arguments, study.config);
    return Run(arguments, study);
  }

  // Where it is not begun: every file that a pattern matches is a component.
  std::optional<study_setup::StudyPlan> Plan(
      const CompareArguments& arguments,
      const study_setup::MakeOwnRecipes& own) override {
    if (arguments.config.empty()) return std::nullopt;
    study_setup::StudyFile file = ConfigOfFile(arguments);
    const fleet::FleetStudy study = fleet::WithPatterns(file);
    if (!study.has_patterns()) return std::nullopt;
    file.config = fleet::Expanded(study).config;
    return study_setup::PlanStudy(file, Sayer(arguments.data.quiet), own);
  }

 private:
  int Run(const CompareArguments& arguments,
          const fleet::FleetStudy& patterns) const {
    const int jobs = JobsOf(arguments.jobs);
    fleet::Share share;
    if (shard_) {
      share =
          ShareOf(*shard_, [](const char* name) { return std::getenv(name); });
    }
    const fleet::FleetStudy study = fleet::Expanded(patterns);
    if (arguments.dry_run) {
      PrintFitted(PlanText(
          fleet::PlanFleet(study.config), share.count, jobs, arguments.out));
      return kDone;
    }
    const fleet::StorePaths store{arguments.out};
    ClaimStore(store, arguments.force);
    fleet::WriteFleet(store, fleet::FleetOf(study, arguments.command_line));
    const bool quiet = arguments.data.quiet;
    fleet::FleetRunResult result;
    {
      Progress progress(!quiet);
      result = fleet::RunFleet(
          study,
          store,
          {.jobs = jobs,
           .stop = &InstallInterruptFlag(),
           .share = share,
           .command_line = arguments.command_line,
           .remark = Sayer(quiet),
           .progress = [&](int done, int all) {
             progress.Show({.done = done, .all = all, .what = "components"});
           }});
    }
    if (!quiet || result.interrupted) SayResult(result, share);
    if (result.interrupted) return kInterrupted;
    if (shard_) return kDone;
    const fleet::FleetSummaries found = fleet::MergeStore(store);
    if (!found.missing.empty()) Warn(fleet::MissingWords(found));
    PrintResult(fleet::FormattedFleet(
        found.summaries, arguments.format, OutputTerminal().columns));
    return StatusOf(found);
  }

  void SayResult(const fleet::FleetRunResult& result,
                 const fleet::Share& share) const {
    Warn(fmt::format(
        "{}{}: {} fitted, {} unchanged, {} failed{}",
        shard_
            ? fmt::format("share {} of 0 to {}, ", share.index, share.count - 1)
            : std::string(),
        report::Count(result.components, "component"),
        result.fitted,
        result.kept,
        result.failed,
        result.interrupted ? "; interrupted: the same command continues" : ""));
  }

  std::optional<std::string> shard_;
};

}  // namespace

void ClaimStore(const fleet::StorePaths& paths, bool force) {
  // In this order: it may become a store meanwhile.
  if (!force && !IsFree(paths.store) && !fleet::IsStore(paths.store)) {
    throw UsageError(fmt::format(
        "{} is not a store and not empty; choose another folder with --out, or "
        "use it with --force",
        data::PrintablePath(paths.store)));
  }
  data::PrepareFolder(paths.store);
}

std::unique_ptr<CompareMode> CompareFleet() {
  return std::make_unique<FleetMode>();
}

}  // namespace errmap::cli
