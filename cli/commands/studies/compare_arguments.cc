#include "cli/commands/studies/compare_arguments.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/command.h"
#include "cli/commands/choice_option.h"
#include "cli/commands/format_option.h"
#include "models/recipe_catalog.h"
#include "stats/holdout.h"

namespace errmap::cli {
namespace {

desk::PredictionsFile ParsePredictions(const std::string& pair) {
  const std::size_t equals = pair.find('=');
  if (equals == 0 || equals == pair.npos || equals + 1 == pair.size()) {
    throw UsageError("--predictions must be NAME=FILE, found '" + pair + "'");
  }
  return {pair.substr(0, equals), pair.substr(equals + 1)};
}

std::string KnownModels() {
  return fmt::format("{}", fmt::join(models::ModelTypes(), ", "));
}

void AddJudgingOptions(CLI::App* command, CompareArguments* arguments) {
  command
      ->add_option("--indifference",
                   arguments->indifference,
                   "Difference in RMSE that never matters, as --goal (default "
                   "for lengths: 0.02 um)")
      ->type_name("X");
  AddChoice(
      command,
      "--choose",
      "The map to recommend\nauto: the blend, unless a baseline errs less or a "
      "single map is proven better by separate days. best: the lowest error",
      {models::Choose::kAuto, models::Choose::kBest, models::Choose::kBlend},
      &arguments->choose);
  AddChoice(command,
            "--prefer",
            "small: fewest sensors, at most 5 % worse",
            {models::Prefer::kLeastError, models::Prefer::kSmall},
            &arguments->prefer);
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

void AddCompareOptions(CLI::App* command, CompareArguments* arguments) {
  AddDataArguments(command, &arguments->data);
  command->get_option("DATA")->required(false);
  command
      ->add_option("--config",
                   arguments->config,
                   "Study file in place of DATA: errmap init writes it\nIt "
                   "has components, models and hold-outs. Where the data of a "
                   "component are a pattern, \"{machine}/{component}.csv\", "
                   "--out is a store of the components of all files that "
                   "match, each studied by itself: one that fails stops no "
                   "other, and the same command goes on where it was broken "
                   "off")
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
                    "Print what would be fitted and how long it takes\nNothing "
                    "is fitted or written");
  command
      ->add_option("--holdout",
                   arguments->holdouts,
                   "Rows to judge by, may be repeated: every:K, groups:K, "
                   "sessions:K, forward:K ...\nAll: " +
                       stats::HoldoutFormsText() +
                       " (default: every:3, groups:5 where "
                       "there are groups, sessions:5 where there are sessions, "
                       "forward:3 from four sessions on, "
                       "blocks:5 without groups)")
      ->type_name("SPEC")
      ->allow_extra_args(false);
  command
      ->add_option("--models",
                   arguments->model_list,
                   "Models, separated by commas (default: all that suit); "
                   "errmap models lists them\nThey are " +
                       KnownModels())
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
                   "RMSE wanted: 2um (default for lengths: 0.5 um)\nof "
                   "held-out rows; without a unit in that of the target")
      ->type_name("X");
  command
      ->add_option("--rezero",
                   arguments->rezero,
                   "Judge maps with their offset set anew then\nfrom the true "
                   "error: at an interval (2h, 90min; 5 of a time column that "
                   "counts cycles), session (where one begins) or probe (with "
                   "every cycle, every row where there are none), beside no "
                   "map re-zeroed alike; by probes of this noise")
      ->type_name("2h|session|probe[:noise=X]");
  AddSeedOption(command, &arguments->seed);
  command
      ->add_option("--jobs",
                   arguments->jobs,
                   "Fits at the same time (default: one per core)\nIt changes "
                   "no figure")
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
                    "Also p values, gaps, times and every sentence");
  AddTableFormatOption(command,
                       "What to print; csv and md have a row per component, "
                       "hold-out and model",
                       &arguments->format);
  AddJudgingOptions(command, arguments);
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
                    "Go on with the run broken off in --out DIR\nFits finished "
                    "there are not repeated");
  AddKeepPathsFlag(command);
  AddForceFlag(command, &arguments->force);
  MarkSeldom(command,
             {"--set",
              "--seed",
              "--shard",
              "--indifference",
              "--probes-per-session",
              "--probe-spacing",
              "--split",
              "--save-split",
              "--predictions",
              "--machine",
              "--later"});
}

}  // namespace errmap::cli
