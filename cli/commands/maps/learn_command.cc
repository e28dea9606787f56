#include <algorithm>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/commands/progress.h"
#include "cli/json_blocks.h"
#include "cli/output/claimed_folder.h"
#include "cli/output/report_files.h"
#include "cli/report/figures/figures.h"
#include "cli/report/figures/svg.h"
#include "cli/report/shell_word.h"
#include "cli/report/text/answers/next_steps.h"
#include "cli/report/text/commands/learning_text.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "cli/study_setup/provenance.h"
#include "cli/study_setup/study_options.h"
#include "data/csv.h"
#include "data/files/atomic_file.h"
#include "data/files/prepare_folder.h"
#include "data/measurements/column_match.h"
#include "data/throwing_as.h"
#include "fitting/interruption.h"
#include "models/learning/learning_curve.h"
#include "models/learning/learning_record.h"
#include "models/learning/next_states.h"
#include "models/learning/sensor_curve.h"
#include "models/record_json.h"
#include "models/study/journal/fit_label.h"
#include "models/study/journal/kept_fits.h"
#include "models/study/study_defaults.h"
#include "stats/error_metrics.h"

namespace errmap::cli {
namespace {

struct LearnArguments {
  DataArguments data;
  std::string by;
  std::string model_list = models::kLearningModels;
  std::string candidates;
  int repeats = 4;
  int sensors = 8;
  int next = 5;
  std::optional<std::string> goal = {};
  std::uint64_t seed = 1;
  int jobs = 0;
  std::string out;
  bool resume = false;
  std::string cache;  // folder of the last fits, or ""
  bool force = false;
  std::string format = "table";
};

std::vector<std::unique_ptr<models::ModelRecipe>> RecipesOf(
    const LearnArguments& arguments, const data::Dataset& dataset) {
  std::vector<std::unique_ptr<models::ModelRecipe>> recipes;
  for (const std::string& spec : SplitFlag("--models", arguments.model_list)) {
    auto recipe = RecipeFromArgument(spec);
    if (const auto missing = recipe->WhatIsMissing(dataset)) {
      Warn(fmt::format("{} is left out: it needs {}", spec, *missing));
      continue;
    }
    if (recipe->kind() == models::ModelKind::kBlend &&
        arguments.model_list == models::kLearningModels &&
        dataset.num_rows() * dataset.num_inputs() > models::kMostForBlend) {
      Warn(
          fmt::format("{} is left out: so many curves of so many rows take "
                      "long; --models {} draws it",
                      spec,
                      spec));
      continue;
    }
    recipes.push_back(std::move(recipe));
  }
  if (recipes.empty()) throw UsageError("no model is left to learn with");
  return recipes;
}

std::unique_ptr<models::KeptFits> OpenJournal(const LearnArguments& arguments) {
  using models::KeptFits;
  if (arguments.out.empty()) return nullptr;
  // Of its own, so that a study in the same folder keeps its fits.
  const std::string folder =
      (std::filesystem::path(arguments.out) / "learn").string();
  data::PrepareFolder(folder);
  // What a killed run was writing.
  data::RemoveAbandonedFiles(arguments.out);
  KeptFits::RequireNoOther(folder, arguments.force);
  auto journal = std::make_unique<KeptFits>(
      folder,
      arguments.resume ? KeptFits::Opening::kResume : KeptFits::Opening::kAnew);
  return journal;
}

// Fits of the curve, resumed from those of an earlier run if there are any.
models::StudyResult RunLearning(
    const LearnArguments& arguments,
    const data::Dataset& dataset,
    const models::LearningPlan& plan,
    const std::vector<std::unique_ptr<models::ModelRecipe>>& recipes) {
  Progress progress(!arguments.data.quiet);
  models::StudyOptions options{
      .seed = arguments.seed,
      .jobs = JobsOf(arguments.jobs),
      .stop = &InstallInterruptFlag(),
      .indifference = models::DefaultIndifference(dataset.target().unit),
      .fit_all_rows = false,
      .progress = [&](const models::FitProgress& fit) {
        progress.Show({.done = fit.done, .all = fit.all});
      }};
  const std::unique_ptr<models::KeptFits> file = OpenJournal(arguments);
  const models::FitLabels labels(
      "learn", dataset, plan.holdouts, recipes, options);
  const auto kept = models::KeptFits::OpenCache(arguments.cache);
  models::ComponentJournal journal(
      {file.get(), kept.get()}, &labels, &dataset, &plan.holdouts);
  options.journal = &journal;
  models::StudyResult study =
      models::RunStudy(dataset, plan.holdouts, recipes, options);
  if (file != nullptr) {
    SayUnless(arguments.data.quiet, file->Remarks());
  }
  return study;
}

// Rows of the candidates with the inputs of `dataset`, in its units.
MatrixXd ReadCandidates(const std::string& file,
                        const data::Dataset& dataset,
                        bool quiet) {
  const data::TableForMap read =
      data::InMapUnits(data::ReadCsv(file), dataset.inputs());
  SayUnless(quiet, read.remarks);
  MatrixXd values(static_cast<Index>(read.table.num_rows),
                  dataset.num_inputs());
  for (Index i = 0; i < values.cols(); ++i) {
    values.col(i) =
        data::NumericColumn(read.table,
                            dataset.inputs()[static_cast<std::size_t>(i)].name,
                            data::MissingPolicy::kError,
                            nullptr);
  }
  return values;
}

// What a run finds; each part where it was asked for.
struct Learned {
  models::LearningRecord record;
  std::string text;
  bool interrupted = false;
  bool failed = false;
};

void LearnCurves(const LearnArguments& arguments,
                 const data::Dataset& dataset,
                 double goal,
                 Learned* learned) {
  const auto plan =
      data::ThrowingAs<UsageError>("--by " + arguments.by + ": ", [&] {
        return models::PlanLearning(dataset,
                                    arguments.by == "sessions"
                                        ? models::LearnBy::kSessions
                                        : models::LearnBy::kGroups,
                                    arguments.repeats,
                                    arguments.seed);
      });
  const auto recipes = RecipesOf(arguments, dataset);
  const models::StudyResult study =
      RunLearning(arguments, dataset, plan, recipes);
  learned->interrupted = study.interrupted;
  if (study.interrupted) return;
  if (study.short_of_memory > 0) throw std::bad_alloc();
  const std::vector<models::LearningCurve> curves =
      models::CurvesOf(dataset, plan, study);
  learned->failed = std::ranges::all_of(
      curves,
      [](const models::LearningCurve& curve) { return curve.points.empty(); });
  learned->record.curves = models::MakeRecord(plan, curves, goal);
  learned->text +=
      report::CurvesText(*learned->record.curves, dataset.target().unit);
}

// The comparison with the sensors that do it, and the positions.
std::string ComparisonOfChosen(const models::SensorCurve& curve,
                               const LearnArguments& arguments,
                               const data::Dataset& dataset) {
  if (!curve.enough || *curve.enough >= curve.all.sensors) return "";
  std::vector<std::string> inputs;
  for (const data::ColumnInfo& input : dataset.inputs()) {
    if (data::IsPosition(input) ||
        std::ranges::find(
            curve.chosen, input.name, &models::SensorCurve::Chosen::sensor) !=
            curve.chosen.end()) {
      inputs.push_back(input.name);
    }
  }
  data::DatasetSelection selection = arguments.data.selection;
  selection.inputs = std::move(inputs);
  selection.exclude.clear();
  std::vector<std::string> words{"errmap", "compare"};
  std::ranges::copy(arguments.data.files, std::back_inserter(words));
  report::AddOptions(study_setup::DataOptions(selection, arguments.seed),
                     &words);
  return "With these alone:\n  " +
         report::ShellCommand(words, OutputTerminal().columns, 2) + "\n";
}

void LearnBySensors(const LearnArguments& arguments,
                    const data::Dataset& dataset,
                    Learned* learned) {
  Progress progress(!arguments.data.quiet);
  try {
    learned->record.sensors =
        models::LearnSensors(dataset,
                             {.most_sensors = arguments.sensors,
                              .jobs = JobsOf(arguments.jobs),
                              .stop = &InstallInterruptFlag(),
                              .progress = [&](int done, int all) {
                                progress.Show({.done = done, .all = all});
                              }});
  } catch (const fitting::Interrupted&) {
    learned->interrupted = true;
    return;
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("--by sensors: {}", error.what()));
  }
  learned->text +=
      report::SensorsText(*learned->record.sensors, dataset.target().unit);
  learned->text +=
      ComparisonOfChosen(*learned->record.sensors, arguments, dataset);
}

void LearnNext(const LearnArguments& arguments,
               const data::Dataset& dataset,
               Learned* learned) {
  const MatrixXd candidates =
      ReadCandidates(arguments.candidates, dataset, arguments.data.quiet);
  learned->record.next =
      models::ChooseNext(dataset, candidates, arguments.next);
  learned->text += report::NextText(*learned->record.next);
}

std::string Stem(const LearnArguments& arguments) {
  return arguments.by.empty() ? "learn-next" : LearningStem(arguments.by);
}

int RunLearn(const LearnArguments& arguments, const std::string& command_line) {
  if (arguments.by.empty() && arguments.candidates.empty()) {
    throw UsageError("learn: say --by sessions|cycles|sensors or --next FILE");
  }
  if (arguments.resume && arguments.out.empty()) {
    throw UsageError("--resume needs --out DIR");
  }
  std::optional<ClaimedFolder> folder;
  if (!arguments.out.empty()) {
    folder.emplace(
        arguments.out,
        std::vector{Stem(arguments) + ".json", Stem(arguments) + ".svg"},
        arguments.data.PathsWith({arguments.candidates}),
        arguments.force);
  }
  const data::PreparedDataset prepared = ReadData(arguments.data);
  const data::Dataset& dataset = prepared.dataset;
  const double goal = GoalOrNone(arguments.goal,
                                 dataset.target(),
                                 stats::RootMeanSquare(dataset.target_values()),
                                 arguments.data.quiet);
  Learned learned;
  if (arguments.by == "sensors") {
    LearnBySensors(arguments, dataset, &learned);
  } else if (!arguments.by.empty()) {
    LearnCurves(arguments, dataset, goal, &learned);
  }
  if (!arguments.candidates.empty()) LearnNext(arguments, dataset, &learned);
  if (learned.interrupted) {
    Warn(arguments.by == "sensors"
             ? "interrupted"
             : "interrupted; with --out the fits that are done are kept for "
               "--resume");
    return kInterrupted;
  }
  models::LearningRecord& record = learned.record;
  record.file = study_setup::ShownNames(arguments.data.files);
  record.target = dataset.target().name;
  record.unit = dataset.target().unit.symbol;
  if (!arguments.by.empty()) record.by = arguments.by;
  Json document = models::ToJson(record);
  document["provenance"] =
      ProvenanceJson(command_line,
                     {{"models", arguments.model_list},
                      {"repeats", arguments.repeats},
                      {"sensors", arguments.sensors},
                      {"seed", arguments.seed}},
                     study_setup::HashInputs(arguments.data.files));
  if (arguments.format == "json") {
    PrintResult(DumpJson(document));
  } else {
    PrintFitted(learned.text);
  }
  if (folder) {
    folder->Write(Stem(arguments) + ".json", DumpJson(document));
    for (const report::Figure& figure : report::LearningFigures(record, "")) {
      folder->Write(Stem(arguments) + ".svg",
                    report::SvgFile(report::FigureSvg(figure)));
    }
    folder->Finish();
  }
  return learned.failed ? kEveryFitFailed : kDone;
}

}  // namespace

void AddLearnCommand(CLI::App* app, Run* run) {
  const Command<LearnArguments> command(
      app,
      run,
      "learn",
      "Show what more days, cycles or fewer sensors do to the error");
  AddDataArguments(command, &command->data);
  AddOption(command, "--by", command->by)
      .About(
          "What to add step by step: sessions, cycles (the groups) or sensors")
      .OneOf(std::vector<std::string>(models::kLearntBy.begin(),
                                      models::kLearntBy.end()));
  AddOption(command, "--models LIST", command->model_list)
      .About(
          "Models, separated by commas, whose curves are drawn (default: "
          "baselines, a plane, ridge and blend)");
  AddOption(command, "--next CANDIDATES.csv", command->candidates)
      .About(
          "Inputs of states that could be measured next, one per row; the most "
          "useful are named");
  AddOption(command, "--repeats", command->repeats)
      .About("Random draws of training units, per size and fold")
      .Range(1, 100)
      .ShowDefault();
  AddOption(command, "--sensors", command->sensors)
      .About("Most sensors to choose")
      .Range(1, 100)
      .ShowDefault();
  AddOption(command, "--goal X", command->goal)
      .About("RMSE wanted: 2um (default: no goal)");
  AddSeedOption(command, &command->seed);
  AddOption(command, "--jobs N", command->jobs)
      .About("Fits at the same time (default: one per core)")
      .Positive();
  AddOption(command, "--out DIR", command->out)
      .About(
          "Folder for learn-*.json, learn-*.svg and the journal of fits\nIn a "
          "study's folder, errmap report puts the curves on its page")
      .Under(kOutputOptions);
  AddFlag(command, "--resume", command->resume)
      .About("Continue the interrupted run in --out");
  AddForceFlag(command, &command->force);
  AddFormatOption(command, &command->format);
  AddCacheFlag(command, &command->cache);
  MarkSeldom(command, {"--repeats", "--sensors", "--seed", "--resume"});
  SetFooter(
      command,
      R"(Whole days or cycles are held out, and maps learn from more and more of the
others. A power law through the curve tells how many would reach the goal,
if any number would. Sensors are chosen inside the folds, with linear maps.
Example: errmap learn data/sets/turning_centre/six_days.csv --by sessions --goal 2um)");
  command.Runs(RunLearn);
}

}  // namespace errmap::cli
