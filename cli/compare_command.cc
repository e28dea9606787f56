#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <set>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/comparison.h"
#include "cli/data_arguments.h"
#include "cli/interrupt.h"
#include "cli/output_folder.h"
#include "cli/progress.h"
#include "cli/results_json.h"
#include "cli/sha256.h"
#include "cli/study_table.h"
#include "data/atomic_file.h"
#include "models/model_spec.h"
#include "models/recipe_catalog.h"

namespace errmap::cli {
namespace {

struct CompareArguments {
  DataArguments data;
  std::vector<std::string> holdouts;
  std::string model_list;
  std::vector<std::string> models;
  double goal = std::numeric_limits<double>::quiet_NaN();
  std::uint64_t seed = 1;
  int jobs = 0;
  std::string out;
  std::string format = "table";
  std::string command_line;
};

using Recipes = std::vector<std::unique_ptr<models::ModelRecipe>>;

// What the command line alone can get wrong is said before any file is read.
std::vector<stats::HoldoutSpec> ParseHoldouts(
    const std::vector<std::string>& texts) {
  std::vector<stats::HoldoutSpec> specs;
  std::set<std::string> seen;
  for (const std::string& text : texts) {
    if (!seen.insert(text).second) {
      throw UsageError("--holdout " + text + " is given twice");
    }
    try {
      specs.push_back(stats::ParseHoldout(text));
    } catch (const std::invalid_argument& error) {
      throw UsageError(error.what());
    }
  }
  return specs;
}

Recipes ParseRecipes(const CompareArguments& arguments) {
  std::vector<std::string> specs;
  if (!arguments.model_list.empty()) {
    try {
      specs = models::SplitList(arguments.model_list);
    } catch (const std::invalid_argument& error) {
      throw UsageError(fmt::format("--models: {}", error.what()));
    }
  }
  specs.insert(specs.end(), arguments.models.begin(), arguments.models.end());
  Recipes recipes;
  std::set<std::string> seen;
  for (const std::string& spec : specs) {
    if (!seen.insert(spec).second) {
      throw UsageError("model " + spec + " is given twice");
    }
    recipes.push_back(RecipeFromArgument(spec));
  }
  return recipes;
}

// every:3, and whole groups where there are at least two.
std::vector<stats::HoldoutSpec> DefaultHoldouts(const data::Dataset& dataset) {
  constexpr std::size_t kGroupFolds = 5;
  std::vector<stats::HoldoutSpec> specs{stats::ParseHoldout("every:3")};
  if (!dataset.has_groups()) return specs;
  const std::size_t groups = dataset.groups().labels.size();
  if (groups >= 2) {
    specs.push_back(stats::ParseHoldout(
        fmt::format("groups:{}", std::min(groups, kGroupFolds))));
  } else {
    Say(
        fmt::format("column '{}' has one group only, so nothing can be said "
                    "about another day; more cycles are needed for that",
                    dataset.groups().column));
  }
  return specs;
}

std::vector<models::Holdout> MakeHoldouts(
    const CompareArguments& arguments,
    const std::vector<stats::HoldoutSpec>& specs,
    const data::Dataset& dataset) {
  std::vector<models::Holdout> holdouts;
  for (const stats::HoldoutSpec& spec : specs) {
    std::shared_ptr<const data::Dataset> test_data;
    if (spec.kind == stats::HoldoutKind::kFile) {
      test_data = std::make_shared<const data::Dataset>(ReadDataLike(
          spec.file,
          dataset,
          arguments.data.weight,
          arguments.data.missing == "error" ? data::MissingPolicy::kError
                                            : data::MissingPolicy::kDropRows));
    }
    try {
      holdouts.push_back(models::MakeHoldout(
          spec, dataset, arguments.seed, std::move(test_data)));
    } catch (const std::invalid_argument& error) {
      throw data::InputError(
          fmt::format("{}: {}", arguments.data.file, error.what()));
    }
  }
  return holdouts;
}

Eigen::Index FewestTrainingRows(const std::vector<models::Holdout>& holdouts) {
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  for (const models::Holdout& holdout : holdouts) {
    for (const stats::Fold& fold : holdout.folds) {
      fewest = std::min(fewest, fold.train.size());
    }
  }
  return static_cast<Eigen::Index>(fewest);
}

// The report's goal serves for lengths; angles have none of their own.
double GoalOrDefault(double goal, const data::Unit& unit) {
  constexpr double kReportGoalUm = 0.5;
  if (std::isfinite(goal) || unit.quantity != data::Quantity::kLength) {
    return goal;
  }
  return kReportGoalUm / unit.display_scale;
}

int RunCompare(const CompareArguments& arguments) {
  if (arguments.goal <= 0.0 || std::isinf(arguments.goal)) {
    throw UsageError(
        fmt::format("--goal must be above 0, found {}", arguments.goal));
  }
  std::vector<stats::HoldoutSpec> specs = ParseHoldouts(arguments.holdouts);
  Recipes recipes = ParseRecipes(arguments);
  Comparison comparison{
      .name = std::filesystem::path(arguments.data.file).stem().string(),
      .file = arguments.data.file,
      .sha256 = "",
      .command_line = arguments.command_line,
      .seed = arguments.seed,
      .goal = arguments.goal,
      .data = ReadData(arguments.data),
      .holdouts = {},
      .study = {},
      .verdicts = {}};
  const data::Dataset& dataset = comparison.data.dataset;
  comparison.sha256 = Sha256(data::ReadFile(arguments.data.file));
  comparison.goal = GoalOrDefault(arguments.goal, dataset.target().unit);
  if (specs.empty()) specs = DefaultHoldouts(dataset);
  comparison.holdouts = MakeHoldouts(arguments, specs, dataset);
  const Eigen::Index fewest = FewestTrainingRows(comparison.holdouts);
  constexpr Eigen::Index kFewestUsable = 2;
  if (fewest < kFewestUsable) {
    throw data::InputError(fmt::format(
        "{}: too few rows for every model: a fold trains on {}; more "
        "data or another --holdout are needed",
        arguments.data.file,
        fewest));
  }
  if (recipes.empty()) {
    models::DefaultRecipes defaults =
        models::MakeDefaultRecipes(dataset, fewest);
    recipes = std::move(defaults.recipes);
    if (!arguments.data.quiet) {
      for (const std::string& line : defaults.left_out) Say(line);
    }
  }
  // Better now than after minutes of fitting.
  if (!arguments.out.empty()) PrepareFolder(arguments.out);

  {
    Progress progress(!arguments.data.quiet);
    const int cores =
        std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    comparison.study = models::RunStudy(
        dataset,
        comparison.holdouts,
        recipes,
        {.seed = arguments.seed,
         .jobs = arguments.jobs > 0 ? arguments.jobs : cores,
         .stop = &InstallInterruptFlag(),
         .progress = [&](int done, int all) { progress.Show(done, all); }});
  }
  comparison.verdicts =
      models::JudgeHoldouts(comparison.study, comparison.holdouts);

  if (!arguments.out.empty()) WriteOutputs(comparison, arguments.out);
  fmt::print("{}",
             arguments.format == "json" ? ResultsJson(comparison)
                                        : StudyTable(comparison));
  if (comparison.study.interrupted) {
    Say("interrupted; what was finished is shown");
    return kInterrupted;
  }
  if (models::DecisiveVerdict(comparison.verdicts) == nullptr) {
    Say("every fit failed; the reasons are in the table");
    return kEveryFitFailed;
  }
  return kDone;
}

}  // namespace

void AddCompareCommand(CLI::App* app, Run* run) {
  auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command = app->add_subcommand(
      "compare", "Fit several maps to the same rows and judge them on others");
  AddDataArguments(command, &arguments->data);
  command
      ->add_option("--holdout",
                   arguments->holdouts,
                   "Rows to judge by, may be repeated: every:K, "
                   "groups:K[:repeats=R], leave-one-group-out, kfold:K, "
                   "forward:K[:gap=G], random:F, file:TEST.csv (default: "
                   "every:3 and, with groups, groups:5)")
      ->type_name("SPEC")
      ->allow_extra_args(false);
  command
      ->add_option("--models",
                   arguments->model_list,
                   "Models, separated by commas (default: all that suit)")
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
                   "sd wanted on held-out rows, in the target's unit "
                   "(default for lengths: 0.5 um)")
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
                   "Folder for results.json, residuals.csv and models/")
      ->type_name("DIR");
  command->add_option("--format", arguments->format, "table or json")
      ->check(CLI::IsMember({"table", "json"}))
      ->type_name("table|json")
      ->capture_default_str();
  command->footer(
      "Exit status: 0 done, 2 wrong command line, 3 unusable input, 4 every "
      "fit failed, 130 interrupted.\n"
      "Example: errmap compare xdown.csv --models mean,poly:eq8,net:scg "
      "--out study");
  command->callback([arguments, run] {
    arguments->command_line = run->command_line;
    run->status = RunCompare(*arguments);
  });
}

}  // namespace errmap::cli
