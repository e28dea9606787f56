#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/progress.h"
#include "cli/commands/studies/compare_arguments.h"
#include "cli/output/claimed_folder.h"
#include "cli/output/report_files.h"
#include "cli/report/documents/study_table.h"
#include "cli/report/report.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "cli/study_setup/plan/run_files.h"
#include "cli/study_setup/plan/study_forecast.h"
#include "cli/study_setup/plan/study_run.h"
#include "data/files/atomic_file.h"
#include "data/text.h"
#include "models/study/journal/kept_fits.h"
#include "models/study/split_file.h"

namespace errmap::cli {
namespace {

// Whether a model that was asked for could be judged.
bool AnyJudged(const models::ComponentStudy& component) {
  const auto& models = component.study.models;
  for (std::size_t i = 0; i < models.size(); ++i) {
    const bool added = i >= component.first_added &&
                       i < component.first_added + component.num_added;
    if (!added &&
        std::ranges::any_of(models[i].holdouts, &models::HoldoutResult::ok)) {
      return true;
    }
  }
  return false;
}

int StatusOf(const study_setup::StudyRun& run) {
  if (run.interrupted) {
    Warn("interrupted; finished results are shown");
    return kInterrupted;
  }
  bool any = false;
  for (const models::ComponentStudy& component : run.components) {
    if (AnyJudged(component)) {
      any = true;
    } else if (run.has_several()) {
      Warn(
          fmt::format("{}: every fit failed", data::Printable(component.name)));
    }
  }
  if (any) return kDone;
  Warn("every fit failed; the reasons are in the table");
  return kEveryFitFailed;
}

void SayShortOfMemory(const study_setup::StudyRun& run) {
  int fits = 0;
  for (const models::ComponentStudy& component : run.components) {
    fits += component.study.short_of_memory;
  }
  if (fits == 0) return;
  Warn(
      fmt::format("{} of the fits ran out of memory; use fewer --jobs. With "
                  "--out, the same command with --resume repeats only these",
                  fits));
}

void SaveSplit(const models::ComponentStudy& comparison,
               const study_setup::ComponentConfig& config) {
  if (config.save_split.empty()) return;
  data::WriteFileAtomically(
      config.save_split,
      models::SplitFileText(comparison.holdouts, comparison.data.dataset));
}

// Fits are kept in the output folder of a run that has one.
std::unique_ptr<models::KeptFits> OpenJournal(
    const CompareArguments& arguments) {
  using models::KeptFits;
  if (arguments.out.empty()) return nullptr;
  auto journal = std::make_unique<KeptFits>(
      arguments.out,
      arguments.resume ? KeptFits::Opening::kResume : KeptFits::Opening::kAnew);
  // The folder is ours alone now, and so is what a killed run had begun.
  RemoveAbandoned(arguments.out);
  return journal;
}

// The files, where fit can read the same rows of them.
std::vector<std::string> DataForFit(const study_setup::StudyRun& run) {
  const study_setup::ComponentConfig& component = run.config.components.front();
  return component.selection.where.empty() && component.later.empty()
             ? component.AllData()
             : std::vector<std::string>();
}

report::Screen Formatted(const study_setup::StudyRun& run,
                         const models::StudyRecord& record,
                         const CompareArguments& arguments) {
  const std::string& format = arguments.format;
  if (format == "json") return {models::ToJsonText(record), {}};
  if (auto text = report::TableText(record, format)) return {*text, {}};
  report::Screen screen = report::StudyTable(record,
                                             {.all = arguments.all,
                                              .details = arguments.details,
                                              .folder = arguments.out,
                                              .page = arguments.page,
                                              .data = DataForFit(run),
                                              .terminal = OutputTerminal()});
  return screen;
}

// Refuses places for single files that cannot be written to: better now than
// after minutes of fitting.
void CheckPlaces(const study_setup::StudyPlan& plan,
                 const CompareArguments& arguments,
                 const std::vector<std::string>& inputs) {
  for (const study_setup::ComponentConfig& component : plan.config.components) {
    CheckOutputName("--save-split", component.save_split, inputs);
    RequirePlaceFor(component.save_split);
  }
  CheckOutputName("-o", arguments.page, inputs);
  // Without it a browser shows the source; and --out may have been meant.
  if (const std::filesystem::path page = arguments.page;
      page.has_filename() && !page.has_extension()) {
    throw UsageError(
        fmt::format("-o writes only a page: {0}.html; --out {0} writes a "
                    "folder with the page, all maps and figures",
                    data::PrintablePath(arguments.page)));
  }
  RequirePlaceFor(arguments.page);
}

study_setup::StudyRun RunShowingProgress(study_setup::StudyPlan plan,
                                         const CompareArguments& arguments,
                                         int jobs,
                                         bool keep_fold_maps,
                                         models::KeptFits* journal) {
  study_setup::StudyRun run;
  {
    SayUnless(arguments.data.quiet,
              LongRunLines(plan, jobs, arguments.ChoosesModels()));
    Progress progress(!arguments.data.quiet);
    study_setup::StudyForecast forecast(plan, jobs);
    run = study_setup::RunPlan(
        std::move(plan),
        arguments.command_line,
        {.jobs = jobs,
         .stop = &InstallInterruptFlag(),
         .journal = journal,
         .cache = arguments.cache,
         .journal_has = Sayer(!arguments.resume || arguments.data.quiet),
         .keep_fold_maps = keep_fold_maps,
         .progress = [&](std::size_t component,
                         const models::FitProgress& fit) {
           forecast.Note(component, fit);
           const study_setup::StudyForecast::Best best = forecast.BestSoFar();
           progress.Show({.done = fit.done,
                          .all = fit.all,
                          .left = forecast.SecondsLeft(),
                          .best = best.map,
                          .holdout = best.holdout});
         }});
  }
  if (journal != nullptr) {
    SayUnless(arguments.data.quiet, journal->Remarks());
  }
  return run;
}

int RunCompare(const CompareArguments& arguments) {
  if (arguments.resume && arguments.out.empty()) {
    throw UsageError("--resume needs the folder of the earlier run: --out DIR");
  }
  for (const auto& mode : arguments.modes) {
    if (const auto status = mode->Begin(arguments)) return *status;
  }
  study_setup::StudyPlan plan = PlanOf(arguments);
  const auto judge = std::ranges::find_if(
      arguments.modes,
      &CompareMode::Judges,
      [](const auto& mode) -> const CompareMode& { return *mode; });
  const bool is_judged = judge != arguments.modes.end();
  const int jobs = JobsOf(arguments.jobs);
  if (arguments.dry_run) {
    PrintFitted(PlanText(plan, jobs, arguments.out));
    return kDone;
  }
  const std::vector<std::string> inputs = plan.InputPaths();
  CheckPlaces(plan, arguments, inputs);
  std::optional<ClaimedFolder> folder;
  if (!arguments.out.empty()) {
    folder.emplace(arguments.out, OutputNames(plan), inputs, arguments.force);
    models::KeptFits::RequireNoOther(arguments.out, arguments.force);
  }
  for (std::size_t i = 0; i < plan.components.size(); ++i) {
    SaveSplit(plan.components[i].comparison, plan.config.components[i]);
  }
  // Open, and so the folder taken, until all is written.
  const std::unique_ptr<models::KeptFits> journal = OpenJournal(arguments);
  const study_setup::StudyRun run = RunShowingProgress(
      std::move(plan), arguments, jobs, is_judged, journal.get());
  SayShortOfMemory(run);
  models::StudyRecord record = study_setup::RecordOf(run, jobs);
  if (is_judged && !run.interrupted) (*judge)->Judge(run, &record);
  if (folder) study_setup::NameMaps(run, &record);
  // Before the files: a full disk must not cost the answer.
  PrintScreen(Formatted(run, record, arguments));
  if (!arguments.page.empty()) {
    data::WriteFileAtomically(arguments.page, report::ReportHtml(record));
  }
  if (folder) WriteOutputs(run, record, &*folder);
  return StatusOf(run);
}

}  // namespace

void AddCompareCommand(CLI::App* app, Run* run) {
  const Command<CompareArguments> command(
      app,
      run,
      "compare",
      "Fit several maps to the same rows and judge them on others");
  AddCompareOptions(command, &*command);
  SetFooter(
      command,
      R"(Exit status: 0 done, 2 wrong command line, 3 unusable input, 4 every fit failed, 130 interrupted.
Example: errmap compare data/sets/turning_centre/six_days.csv --out study)");
  command.Runs(
      [command](CompareArguments& arguments, const std::string& command_line) {
        arguments.given = GivenOptions(*command.app());
        arguments.command_line = command_line;
        return RunCompare(arguments);
      });
}

}  // namespace errmap::cli
