#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/command.h"
#include "cli/commands/progress.h"
#include "cli/commands/studies/compare_fleet.h"
#include "cli/commands/studies/probe_table.h"
#include "cli/fleet/store_folder.h"
#include "cli/report/claimed_folder.h"
#include "cli/report/documents/output_folder.h"
#include "cli/report/documents/report_html.h"
#include "cli/report/documents/results_document.h"
#include "cli/report/documents/study_table.h"
#include "cli/report/figures/figures.h"
#include "cli/report/tables/result_table.h"
#include "cli/shell/interrupt.h"
#include "cli/shell/standard_streams.h"
#include "cli/shell/terminal.h"
#include "cli/study_file/data_arguments.h"
#include "cli/study_file/machine_study.h"
#include "cli/study_file/provenance.h"
#include "cli/study_file/study_config.h"
#include "cli/study_file/study_file.h"
#include "cli/study_file/study_plan.h"
#include "cli/study_file/study_plan_text.h"
#include "cli/study_file/study_run.h"
#include "data/atomic_file.h"
#include "data/text.h"
#include "models/model_spec.h"
#include "models/recipe_catalog.h"
#include "models/study/journal/fit_journal_file.h"
#include "models/study/split_file.h"
#include "stats/holdout.h"

namespace errmap::cli {
namespace {

struct CompareArguments {
  DataArguments data;
  std::vector<std::string> holdouts;
  std::string model_list;
  std::vector<std::string> models;
  double goal = std::numeric_limits<double>::quiet_NaN();
  double indifference = std::numeric_limits<double>::quiet_NaN();
  std::string split;
  std::string save_split;
  std::vector<PredictionsFile> predictions;
  bool resume = false;
  bool force = false;
  std::string config;
  std::vector<std::string> changes;  // KEY=VALUE of --set
  bool dry_run = false;
  ProbeArguments probes;
  bool all = false;
  bool details = false;
  std::string page;
  std::set<std::string> given;  // flags that stand on the command line
  std::uint64_t seed = 1;
  int jobs = 0;
  std::string out;
  std::string shard;
  std::string format = "table";
  std::string command_line;
  std::string machine;
  int later = 1;  // sessions that judge the machine
};

// The words before the colon.
std::vector<std::string> HoldoutNames() {
  std::vector<std::string> names;
  for (const stats::HoldoutForm& form : stats::HoldoutForms()) {
    const std::string text(form.form);
    names.push_back(text.substr(0, text.find_first_of(":[")));
  }
  return names;
}

// What the command line alone can get wrong is said before any file is read.
void CheckHoldouts(const std::vector<std::string>& texts) {
  std::set<std::string> seen;
  for (const std::string& text : texts) {
    if (!seen.insert(text).second) {
      throw UsageError("--holdout " + text + " is given twice");
    }
    try {
      stats::ParseHoldout(text);
    } catch (const std::invalid_argument& error) {
      const std::string nearest =
          data::NearestName(text.substr(0, text.find(':')), HoldoutNames());
      throw UsageError(
          nearest.empty() || text.starts_with(nearest)
              ? error.what()
              : fmt::format("{}; did you mean {}?", error.what(), nearest));
    }
  }
}

std::vector<std::string> ModelSpecs(const CompareArguments& arguments) {
  std::vector<std::string> specs;
  if (!arguments.model_list.empty()) {
    try {
      specs = models::SplitList(arguments.model_list);
    } catch (const std::invalid_argument& error) {
      throw UsageError(fmt::format("--models: {}", error.what()));
    }
  }
  specs.insert(specs.end(), arguments.models.begin(), arguments.models.end());
  std::set<std::string> seen;
  for (const std::string& spec : specs) {
    if (!seen.insert(spec).second) {
      throw UsageError("model " + spec + " is given twice");
    }
    RecipeFromArgument(spec);
  }
  return specs;
}

void CheckLength(const char* flag, double value, bool may_be_zero) {
  if (std::isnan(value)) return;  // not given
  if (std::isfinite(value) && (value > 0.0 || (may_be_zero && value == 0.0))) {
    return;
  }
  throw UsageError(fmt::format("{} must be {} 0, found {}",
                               flag,
                               may_be_zero ? "at least" : "above",
                               value));
}

// Without a study file the command line asks for one component.
StudyConfig ConfigOf(const CompareArguments& arguments) {
  CheckLength("--goal", arguments.goal, false);
  CheckLength("--indifference", arguments.indifference, true);
  CheckHoldouts(arguments.holdouts);
  const DataArguments& data = arguments.data;
  ComponentConfig component;
  component.data = data.file;
  component.target = data.target;
  component.inputs = SplitNames(data.inputs, "--inputs");
  component.exclude = SplitNames(data.exclude, "--exclude");
  component.group = data.group;
  component.time = data.time;
  component.session = data.session;
  component.align = AlignOf(data.align);
  component.weight = data.weight;
  component.missing = MissingPolicyOf(data.missing);
  component.faults = FaultPolicyOf(data.faults);
  component.keep_dead = data.keep_dead;
  component.split = arguments.split;
  component.save_split = arguments.save_split;
  component.predictions = arguments.predictions;
  std::vector<std::string> specs = ModelSpecs(arguments);
  for (const PredictionsFile& predictions : component.predictions) {
    if (std::ranges::find(specs, predictions.name) != specs.end() ||
        std::ranges::count(component.predictions,
                           predictions.name,
                           &PredictionsFile::name) > 1) {
      throw UsageError("two models are named " + predictions.name +
                       "; give the --predictions another name");
    }
  }
  return {.seed = arguments.seed,
          .goal = arguments.goal,
          .indifference = arguments.indifference,
          .holdouts = arguments.holdouts,
          .models = std::move(specs),
          .components = {std::move(component)}};
}

// Whether a model that was asked for could be judged.
bool AnyJudged(const Comparison& component) {
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

int StatusOf(const StudyRun& run) {
  if (run.interrupted) {
    Say("interrupted; what was finished is shown");
    return kInterrupted;
  }
  bool any = false;
  for (const Comparison& component : run.components) {
    if (AnyJudged(component)) {
      any = true;
    } else if (run.has_several()) {
      Say(fmt::format("{}: every fit failed",
                      data::Printable(component.name, component.name.size())));
    }
  }
  if (any) return kDone;
  Say("every fit failed; the reasons are in the table");
  return kEveryFitFailed;
}

void SaveSplit(const Comparison& comparison, const ComponentConfig& config) {
  if (config.save_split.empty()) return;
  data::WriteFileAtomically(
      config.save_split,
      models::SplitFileText(comparison.holdouts, comparison.data.dataset));
}

void SayUnlessQuiet(const CompareArguments& arguments,
                    const std::vector<std::string>& lines) {
  if (arguments.data.quiet) return;
  for (const std::string& line : lines) Say(line);
}

// Fits are kept in the output folder of a run that has one.
std::unique_ptr<models::JournalFile> OpenJournal(
    const CompareArguments& arguments) {
  using models::JournalFile;
  if (arguments.out.empty()) return nullptr;
  auto journal = std::make_unique<JournalFile>(
      arguments.out,
      arguments.resume ? JournalFile::Opening::kResume
                       : JournalFile::Opening::kAnew);
  // The folder is ours alone now, and so is what a killed run had begun.
  RemoveAbandoned(arguments.out);
  SayUnlessQuiet(arguments, journal->OpeningRemarks());
  return journal;
}

// The study file with what the command line says in place of its words.
StudyFile ConfigOfFile(const CompareArguments& arguments) {
  const auto given = [&](const char* flag) {
    return arguments.given.contains(flag);
  };
  if (given("DATA")) {
    throw UsageError(
        "DATA and --config exclude each other; the study file names its data");
  }
  StudyFile file = ReadStudyFile(arguments.config, arguments.changes);
  StudyConfig& config = file.config;
  const StudyConfig flags = ConfigOf(arguments);
  if (given("--seed")) config.seed = flags.seed;
  if (given("--goal")) {
    config.goal = flags.goal;
    for (ComponentConfig& component : config.components) {
      component.goal = flags.goal;
    }
  }
  if (given("--indifference")) {
    config.indifference = flags.indifference;
    for (ComponentConfig& component : config.components) {
      component.indifference = flags.indifference;
    }
  }
  if (given("--holdout")) config.holdouts = flags.holdouts;
  if (given("--models") || given("--model")) config.models = flags.models;
  const ComponentConfig& from = flags.components.front();
  for (const char* flag : {"--target",
                           "--inputs",
                           "--exclude",
                           "--group",
                           "--time",
                           "--session",
                           "--weight",
                           "--split",
                           "--save-split",
                           "--predictions"}) {
    if (!given(flag) || config.components.size() == 1) continue;
    throw UsageError(
        fmt::format("{} is for one component, and {} has {}; write --set "
                    "component.0.KEY=VALUE",
                    flag,
                    data::PrintablePath(arguments.config),
                    config.components.size()));
  }
  for (ComponentConfig& component : config.components) {
    if (given("--target")) component.target = from.target;
    if (given("--inputs")) component.inputs = from.inputs;
    if (given("--exclude")) component.exclude = from.exclude;
    if (given("--group")) component.group = from.group;
    if (given("--time")) component.time = from.time;
    if (given("--session")) component.session = from.session;
    if (given("--align")) component.align = from.align;
    if (given("--weight")) component.weight = from.weight;
    if (given("--missing")) component.missing = from.missing;
    if (given("--faults")) component.faults = from.faults;
    if (given("--keep-dead")) component.keep_dead = from.keep_dead;
    if (given("--split")) component.split = from.split;
    if (given("--save-split")) component.save_split = from.save_split;
    if (given("--predictions")) component.predictions = from.predictions;
  }
  return file;
}

// With --machine DATA is the folder of its components' data.
std::optional<MachineStudy> MachineOf(const CompareArguments& arguments) {
  if (arguments.machine.empty()) {
    if (arguments.given.contains("--later")) {
      throw UsageError("--later goes with --machine");
    }
    return std::nullopt;
  }
  for (const char* flag : {"--config",
                           "--target",
                           "--inputs",
                           "--weight",
                           "--split",
                           "--save-split",
                           "--predictions"}) {
    if (arguments.given.contains(flag)) {
      throw UsageError(fmt::format(
          "{} is for one component, and --machine has several", flag));
    }
  }
  if (!arguments.given.contains("DATA")) {
    throw UsageError(
        "--machine needs the folder of its components' data: errmap compare "
        "--machine machine.toml DIR");
  }
  return ReadMachineStudy(arguments.machine,
                          arguments.data.file,
                          arguments.later,
                          arguments.data.session);
}

StudyPlan PlanOf(const CompareArguments& arguments,
                 const std::optional<MachineStudy>& machine) {
  if (machine) {
    StudyPlan plan = PlanStudy(ConfigOfMachine(*machine, ConfigOf(arguments)),
                               arguments.data.quiet);
    plan.inputs.push_back(HashInput(machine->path));
    plan.inputs.push_back(HashInput(machine->points.file));
    return plan;
  }
  if (arguments.config.empty()) {
    if (!arguments.given.contains("DATA")) {
      throw UsageError("DATA is required; see errmap --help");
    }
    if (!arguments.changes.empty()) {
      throw UsageError("--set changes a study file; name it with --config");
    }
    return PlanStudy(ConfigOf(arguments), arguments.data.quiet);
  }
  const StudyFile file = ConfigOfFile(arguments);
  StudyPlan plan = PlanStudy(file.config, arguments.data.quiet);
  plan.inputs.insert(plan.inputs.begin(), file.file);
  return plan;
}

int JobsOf(const CompareArguments& arguments) {
  if (arguments.jobs > 0) return arguments.jobs;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

// Of a study of many components, each by itself: components from patterns, a
// share of a study, or what goes on with one. Nothing for any other.
std::optional<int> RunIfFleet(const CompareArguments& arguments) {
  if (arguments.config.empty()) {
    if (!arguments.shard.empty()) {
      throw UsageError(
          "--shard deals the components of a study file; name it "
          "with --config");
    }
    return std::nullopt;
  }
  StudyFile study = ConfigOfFile(arguments);
  if (!study.has_patterns() && arguments.shard.empty() &&
      (arguments.out.empty() || !IsStore(arguments.out))) {
    return std::nullopt;
  }
  return RunCompareFleet({.study = std::move(study),
                          .out = arguments.out,
                          .shard = arguments.shard,
                          .command_line = arguments.command_line,
                          .format = arguments.format,
                          .jobs = JobsOf(arguments),
                          .dry_run = arguments.dry_run,
                          .force = arguments.force,
                          .quiet = arguments.data.quiet});
}

Screen Formatted(const StudyRun& run,
                 const models::StudyRecord& record,
                 const CompareArguments& arguments) {
  const std::string& format = arguments.format;
  if (format == "json") return {models::ToJsonText(record), {}};
  if (format == "csv") return {CsvTable(LeaderboardRows(record)), {}};
  if (format == "md") return {MarkdownTable(LeaderboardRows(record)), {}};
  Screen screen = StudyTable(run,
                             record,
                             {.all = arguments.all,
                              .details = arguments.details,
                              .folder = arguments.out,
                              .terminal = OutputTerminal()});
  for (const models::ComponentRecord& component : record.components) {
    screen.Add(ProbesText(component));
  }
  return screen;
}

int RunCompare(const CompareArguments& arguments) {
  if (arguments.resume && arguments.out.empty()) {
    throw UsageError("--resume needs the folder of the earlier run: --out DIR");
  }
  const std::optional<MachineStudy> machine = MachineOf(arguments);
  if (const std::optional<int> status = RunIfFleet(arguments)) return *status;
  StudyPlan plan = PlanOf(arguments, machine);
  const int jobs = JobsOf(arguments);
  if (arguments.dry_run) {
    PrintResult(PlanText(plan, jobs, arguments.out));
    return kDone;
  }
  // Better now than after minutes of fitting.
  const std::vector<std::string> inputs = plan.InputPaths();
  for (const ComponentConfig& component : plan.config.components) {
    RefuseInputAsOutput("--save-split", component.save_split, inputs);
  }
  RefuseInputAsOutput("-o", arguments.page, inputs);
  std::optional<ClaimedFolder> folder;
  if (!arguments.out.empty()) {
    folder.emplace(arguments.out, OutputNames(plan), inputs, arguments.force);
    models::JournalFile::RequireNoOther(arguments.out, arguments.force);
  }
  for (std::size_t i = 0; i < plan.components.size(); ++i) {
    SaveSplit(plan.components[i].comparison, plan.config.components[i]);
  }
  const std::unique_ptr<models::JournalFile> journal = OpenJournal(arguments);
  StudyRun run;
  {
    Progress progress(!arguments.data.quiet);
    run = RunPlan(
        std::move(plan),
        arguments.command_line,
        {.jobs = jobs,
         .stop = &InstallInterruptFlag(),
         .journal = journal.get(),
         .describe_resume = arguments.resume && !arguments.data.quiet,
         .progress = [&](int done, int all) { progress.Show(done, all); }});
  }
  if (journal != nullptr) SayUnlessQuiet(arguments, journal->WritingRemarks());
  models::StudyRecord record = RecordOf(run);
  if (machine && !run.interrupted) record.machine = JudgeMachine(*machine, run);
  AddProbes(run, arguments.probes, &record);
  if (folder) NameMaps(run, &record);
  // Before the files: a full disk must not cost the answer.
  PrintScreen(Formatted(run, record, arguments));
  if (!arguments.page.empty()) {
    data::WriteFileAtomically(arguments.page,
                              ReportHtml(record, MakeFigures(record)));
  }
  if (folder) WriteOutputs(run, record, &*folder);
  return StatusOf(run);
}

PredictionsFile ParsePredictions(const std::string& pair) {
  const std::size_t equals = pair.find('=');
  if (equals == 0 || equals == pair.npos || equals + 1 == pair.size()) {
    throw UsageError("--predictions must be NAME=FILE, found '" + pair + "'");
  }
  return {pair.substr(0, equals), pair.substr(equals + 1)};
}

// CLI11 would take "nan", which says that none was given, and "inf".
std::string RefusalOfNumber(const std::string& text) {
  double ignored = 0.0;
  return data::ParseNumber(text, &ignored) ? "" : "give a finite number";
}

std::string KnownModels() {
  return fmt::format("{}", fmt::join(models::ModelTypes(), ", "));
}

void AddJudgingOptions(CLI::App* command, CompareArguments* arguments) {
  command
      ->add_option("--indifference",
                   arguments->indifference,
                   "Difference in RMSE that never matters, in the target's "
                   "unit (default for lengths: 0.02 um)")
      ->check(RefusalOfNumber)
      ->type_name("X");
  command
      ->add_option("--probes-per-session",
                   arguments->probes.numbers,
                   "What so many probes of each unseen session, from its first "
                   "row on, would make of every model: 0,1,2,4,8")
      ->delimiter(',')
      ->check(CLI::Range(0, 1000))
      ->type_name("N,N,...");
  command
      ->add_option("--probe-spacing",
                   arguments->probes.spacing,
                   "Seconds between the probes; rows where there are no times "
                   "follow one another")
      ->check(CLI::PositiveNumber)
      ->type_name("S")
      ->capture_default_str();
  command
      ->add_option("--split",
                   arguments->split,
                   "Hold-outs from a file with row,holdout,fold,role in place "
                   "of the default ones")
      ->type_name("FILE.csv");
  command
      ->add_option("--save-split",
                   arguments->save_split,
                   "Write the hold-outs to such a file, for other programs")
      ->type_name("FILE.csv");
  command
      ->add_option_function<std::vector<std::string>>(
          "--predictions",
          [arguments](const std::vector<std::string>& pairs) {
            for (const std::string& pair : pairs) {
              arguments->predictions.push_back(ParsePredictions(pair));
            }
          },
          "Predictions made elsewhere enter the table as NAME, may be "
          "repeated: row,predicted or row,holdout,fold,predicted")
      ->type_name("NAME=FILE")
      ->allow_extra_args(false);
}

}  // namespace

void AddCompareCommand(CLI::App* app, Run* run) {
  auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command = app->add_subcommand(
      "compare", "Fit several maps to the same rows and judge them on others");
  AddDataArguments(command, &arguments->data);
  command->get_option("DATA")->required(false);
  command
      ->add_option("--config",
                   arguments->config,
                   "Study file in place of DATA: components, models and "
                   "hold-outs (errmap init writes one)")
      ->type_name("study.toml");
  command
      ->add_option("--set",
                   arguments->changes,
                   "Put in place of a key of the study file, may be repeated: "
                   "seed=2, component.0.target=error_mm")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_flag("--dry-run",
                    arguments->dry_run,
                    "Print what would be fitted and how long it may take; fit "
                    "and write nothing");
  command
      ->add_option(
          "--holdout",
          arguments->holdouts,
          "Rows to judge by, may be repeated: " + stats::HoldoutFormsText() +
              " (default: every:3, groups:5 where "
              "there are groups, sessions:5 where there are sessions, "
              "blocks:5 without groups)")
      ->type_name("SPEC")
      ->allow_extra_args(false);
  command
      ->add_option("--models",
                   arguments->model_list,
                   "Models, separated by commas (default: all that suit): " +
                       KnownModels() + "; errmap models explains them")
      ->type_name("LIST");
  command
      ->add_option("--model",
                   arguments->models,
                   "One model, may be repeated: net:scg:hidden=60:wfactor=1e-3")
      ->type_name("SPEC")
      ->allow_extra_args(false);
  command
      ->add_option("--goal",
                   arguments->goal,
                   "RMSE wanted on held-out rows, in the target's unit "
                   "(default for lengths: 0.5 um)")
      ->check(RefusalOfNumber)
      ->type_name("X");
  AddSeedOption(command, &arguments->seed);
  command
      ->add_option("--jobs",
                   arguments->jobs,
                   "Fits at the same time (default: the processor's cores); "
                   "changes no figure")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  command
      ->add_option("--out",
                   arguments->out,
                   "Folder for report.html, results.json, residuals.csv and "
                   "models/")
      ->type_name("DIR");
  command
      ->add_option("--shard",
                   arguments->shard,
                   "Of a study of many components do share I of 0 to N-1 only, "
                   "or the one that mpirun or Slurm gave this task (env); "
                   "errmap merge STORE puts the shares together")
      ->type_name("I/N|env");
  command
      ->add_option(
          "-o,--output", arguments->page, "The page alone: a file to write")
      ->type_name("PAGE.html");
  command->add_flag(
      "--all", arguments->all, "Every model in the table, not the best twelve");
  command->add_flag("--details",
                    arguments->details,
                    "Also print p values, gaps, times and every sentence");
  command
      ->add_option("--format",
                   arguments->format,
                   "What to print; csv and md have a row per component, "
                   "hold-out and model")
      ->check(CLI::IsMember({"table", "json", "csv", "md"}))
      ->type_name("table|json|csv|md")
      ->capture_default_str();
  AddJudgingOptions(command, arguments.get());
  command
      ->add_option("--machine",
                   arguments->machine,
                   "Compare the maps STEM.json of this machine on the data "
                   "STEM.csv of the folder DATA, and judge them together at "
                   "the poses of tool_tip.csv there")
      ->type_name("machine.toml");
  command
      ->add_option("--later",
                   arguments->later,
                   "With --machine: last sessions that no fit sees and that "
                   "judge it")
      ->check(CLI::Range(1, 1000))
      ->type_name("N")
      ->capture_default_str();
  command->add_flag("--resume",
                    arguments->resume,
                    "Go on with the run that was broken off in --out DIR: fits "
                    "finished there are not repeated");
  AddKeepPathsFlag(command);
  AddForceFlag(command, &arguments->force);
  command->footer(
      "Exit status: 0 done, 2 wrong command line, 3 unusable input, 4 every "
      "fit failed, 130 interrupted.\n"
      "Where a component's data in a study file are a pattern, \"{machine}/"
      "{component}.csv\", --out is a\nstore of the components of all files "
      "that "
      "match, each studied by itself: one that fails stops\nno other, and the "
      "same command goes on where it was broken off.\n"
      "Example: errmap compare xdown.csv --models mean,poly:eq8,net:scg "
      "--out study");
  command->callback([arguments, run, command] {
    for (const CLI::Option* option : command->get_options()) {
      if (option->count() > 0) arguments->given.insert(option->get_name());
    }
    arguments->command_line = run->command_line;
    run->status = RunCompare(*arguments);
  });
}

}  // namespace errmap::cli
