#include "cli/commands/studies/compare_arguments.h"

#include <algorithm>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/command.h"
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
  desk::ForStudyOptions(arguments->study, FlagAdder(command));
  AddSeedOption(command, &arguments->study.seed);
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
  AddCacheFlag(command, &arguments->cache);
  AddKeepPathsFlag(command);
  AddForceFlag(command, &arguments->force);
  MarkSeldom(command,
             {"--set",
              "--seed",
              "--shard",
              "--probes-per-session",
              "--probe-spacing",
              "--split",
              "--save-split",
              "--predictions",
              "--machine",
              "--later"});
}

CompareArguments ReadCompareArguments(std::vector<std::string> words) {
  CompareArguments arguments;
  CLI::App command;
  AddCompareOptions(&command, &arguments);
  std::ranges::reverse(words);  // as CLI11 takes them
  try {
    command.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what());
  }
  NoteGiven(command, &arguments);
  return arguments;
}

void NoteGiven(const CLI::App& command, CompareArguments* arguments) {
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() > 0) arguments->given.insert(option->get_name());
  }
}

}  // namespace errmap::cli
