#include "cli/commands/studies/compare_arguments.h"

#include <utility>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/shell/command_options.h"
#include "cli/slice.h"
#include "data/text.h"
#include "models/recipe_catalog.h"
#include "stats/holdout.h"

namespace errmap::cli {
namespace {

study_setup::PredictionsFile ParsePredictions(const std::string& pair) {
  const std::size_t equals = pair.find('=');
  if (equals == 0 || equals == pair.npos || equals + 1 == pair.size()) {
    throw UsageError("--predictions must be NAME=FILE, found '" + pair + "'");
  }
  return {pair.substr(0, equals), pair.substr(equals + 1)};
}

void AddJudgingOptions(CLI::App* command, CompareArguments* arguments) {
  AddOption(command, "--split FILE.csv", arguments->split)
      .About(
          "Hold-outs from a file with row,holdout,fold,role, in place of the "
          "default ones");
  AddOption(command, "--save-split FILE.csv", arguments->save_split)
      .About("Write the hold-outs to such a file, for other programs");
  AddOption(command,
            "--predictions NAME=FILE",
            [arguments](const std::vector<std::string>& pairs) {
              for (const std::string& pair : pairs) {
                arguments->predictions.push_back(ParsePredictions(pair));
              }
            })
      .About(
          "Add predictions of another program to the table as NAME, may be "
          "repeated: row,predicted or row,holdout,fold,predicted")
      .OneAtATime();
}

}  // namespace

void AddCompareOptions(CLI::App* command, CompareArguments* arguments) {
  for (const Slice& slice : Slices()) {
    if (slice.compare != nullptr) arguments->modes.push_back(slice.compare());
  }
  const auto add_of_modes_after = [&](std::string_view flag) {
    for (const auto& mode : arguments->modes) mode->AddOptions(flag, command);
  };
  AddDataArguments(command, &arguments->data);
  FindOption(command, "DATA").Required(false);
  AddOption(command, "--config study.toml", arguments->config)
      .About(
          "Study file in place of DATA: errmap init writes it\nIt has "
          "components, models and hold-outs. A path such as "
          "\"{machine}/{component}.csv\" stands for all files that match. Each "
          "is studied separately, and --out is their store. Run the same "
          "command again after an interruption");
  AddOption(command, "--set KEY=VALUE", arguments->changes)
      .About(
          "Change a key of the study file (may be repeated): seed=2, "
          "component.0.target=error_mm")
      .OneAtATime();
  AddFlag(command, "--dry-run", arguments->dry_run)
      .About(
          "Print what would be fitted and how long it takes\nNothing is fitted "
          "or written");
  AddOption(command, "--holdout SPEC", arguments->holdouts)
      .About(
          "Rows to hold out (may be repeated): every:K, groups:K, sessions:K, "
          "forward:K\nAll forms: " +
          stats::HoldoutFormsText() +
          ". Default: every:3; groups:5 with groups, else blocks:5; "
          "sessions:5 with sessions; forward:3 from four sessions on")
      .OneAtATime();
  AddOption(command, "--models LIST", arguments->model_list)
      .About(
          "Models, separated by commas (default: all suitable ones)\n"
          "They are  " +
          data::JoinWords(models::ModelTypes(), ", "));
  AddOption(command, "--model SPEC", arguments->models)
      .About("One model (may be repeated): net:scg:hidden=60:wfactor=1e-3")
      .OneAtATime();
  study_setup::ForStudyOptions(arguments->study, FlagAdder(command));
  AddSeedOption(command, &arguments->study.seed);
  AddOption(command, "--jobs N", arguments->jobs)
      .About(
          "Fits at the same time (default: one per core)\nResults do not "
          "depend on it")
      .Range(1, 1024);
  AddOption(command, "--out DIR", arguments->out)
      .About("Folder for report.html, results.json, residuals.csv and models/")
      .Under(kOutputOptions);
  add_of_modes_after("--out");
  AddOption(command, "-o,--output PAGE.html", arguments->page)
      .About("Write only the page, to this file")
      .Under(kOutputOptions);
  AddFlag(command, "--all", arguments->all)
      .About("Show every model in the table, not the best twelve")
      .Under(kOutputOptions);
  AddFlag(command, "--details", arguments->details)
      .About("Also print p values, gaps, times and all remarks")
      .Under(kOutputOptions);
  AddTableFormatOption(command,
                       "What to print; csv and md have a row per component, "
                       "hold-out and model",
                       &arguments->format);
  AddJudgingOptions(command, arguments);
  add_of_modes_after("--predictions");
  AddFlag(command, "--resume", arguments->resume)
      .About(
          "Continue the interrupted run in --out DIR\nFits finished there are "
          "not repeated");
  AddCacheFlag(command, &arguments->cache);
  AddKeepPathsFlag(command);
  AddForceFlag(command, &arguments->force);
  MarkSeldom(command,
             {"--set", "--seed", "--split", "--save-split", "--predictions"});
}

CompareArguments ReadCompareArguments(std::vector<std::string> words) {
  CompareArguments arguments;
  arguments.given = ParseWords(std::move(words), [&](CLI::App* command) {
    AddCompareOptions(command, &arguments);
  });
  return arguments;
}

}  // namespace errmap::cli
