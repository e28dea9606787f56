#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/json_blocks.h"
#include "cli/output/claimed_folder.h"
#include "cli/report/documents/fit_text.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "cli/study_setup/plan/component_names.h"
#include "cli/study_setup/provenance.h"
#include "data/files/shown_path.h"
#include "data/measurements/axis/directions.h"
#include "data/measurements/joined_tables.h"
#include "data/text.h"
#include "fitting/interruption.h"
#include "models/file_recipe.h"
#include "models/model_file.h"
#include "models/record_json.h"
#include "models/sensors/sensitivity.h"
#include "models/study/fold_pool.h"
#include "models/study/record/builders/parts.h"
#include "models/study/study_defaults.h"
#include "models/uncertainty/add_uncertainty.h"

namespace errmap::cli {
namespace {

struct FitArguments {
  DataArguments data;
  std::string model;
  std::string out;
  std::uint64_t seed = 1;
  int jobs = 0;
  std::string format = "table";
  bool correlations = false;
  bool no_interval = false;
  bool details = false;
};

Json SensitivityJson(const models::Sensitivity& sensitivity) {
  return {{"noise", models::Sensitivity::kNoise},
          {"per_noise", sensitivity.per_noise},
          {"largest_jump", sensitivity.largest_jump},
          {"jump_of",
           sensitivity.jump_of.empty() ? Json() : Json(sensitivity.jump_of)},
          {"rezero_jump", sensitivity.rezero_jump}};
}

Json FitJson(const models::FittedModel& fitted,
             double fit_seconds,  // its choices and starts included
             const models::Sensitivity& sensitivity,
             const stats::ErrorMetrics& train,
             const data::PreparedDataset& prepared,
             const FitArguments& arguments) {
  const data::Dataset& dataset = prepared.dataset;
  Json inputs = Json::array();
  for (const models::TrainedInput& input : fitted.inputs) {
    inputs.push_back(input.column.name);
  }
  Json json = {
      {"schema", "errmap-fit-1"},
      {"model", fitted.name},
      {"file", data::ShownPath(arguments.out)},
      {"target", fitted.target.name},
      {"unit", fitted.target.unit.symbol},
      {"inputs", std::move(inputs)},
      {"parameters", fitted.model->num_parameters()},
      {"equation", fitted.equation.empty() ? Json() : Json(fitted.equation)},
      {"train", models::ToJson(train)},
      {"fit_seconds", fit_seconds},
      {"remarks", fitted.remarks},
      {"data_remarks", prepared.remarks},
      {"sensitivity", SensitivityJson(sensitivity)}};
  json.update(models::ToJson(models::MakeRecord(fitted.summary)));
  if (!fitted.choices.empty()) {
    json["choices"] = models::ToJson(models::MakeRecord(fitted.choices));
  }
  if (!fitted.starts.empty()) {
    json["starts"] = models::ToJson(models::MakeRecord(fitted.starts));
  }
  if (fitted.regression) {
    json["regression"] = models::ToJson(*fitted.regression);
  }
  if (arguments.correlations) {
    json["correlations"] = models::ToJson(models::Correlate(dataset));
  }
  return json;
}

// What took effect, defaults included.
Json ConfigurationJson(const models::ModelRecipe& recipe,
                       const data::Dataset& dataset,
                       const FitArguments& arguments) {
  const std::string& weight = arguments.data.selection.weight;
  return {
      {"model", recipe.name()},
      {"options", models::ToJson(models::MakeRecord(recipe.options()))},
      {"target", dataset.target().name},
      {"inputs", dataset.InputNames()},
      {"group", dataset.has_groups() ? Json(dataset.groups().column) : Json()},
      {"weight", weight.empty() ? Json() : Json(weight)},
      {"missing", ToString(arguments.data.selection.missing)},
      {"faults", ToString(arguments.data.selection.faults)},
      {"seed", arguments.seed}};
}

// A map of all rows and the seconds that it took, its choices and starts
// included.
struct TimedFit {
  models::FittedModel map;
  double seconds = 0.0;
};

TimedFit FitTimed(const models::ModelRecipe& recipe,
                  const data::Dataset& dataset,
                  const models::FitContext& context) {
  const auto start = std::chrono::steady_clock::now();
  TimedFit fit{.map = recipe.Fit(dataset, context)};
  const std::chrono::duration<double> taken =
      std::chrono::steady_clock::now() - start;
  fit.seconds = taken.count();
  return fit;
}

// Why there is no map to write; nothing if there is one.
std::optional<std::string> WhyFailed(const models::FittedModel& fitted,
                                     const VectorXd& predicted) {
  if (!predicted.allFinite()) return "a prediction is not finite";
  if (fitted.summary.termination != fitting::Termination::kFailed) return {};
  return fitted.summary.message;
}

void AddInterval(const data::Dataset& dataset,
                 std::unique_ptr<models::ModelRecipe> recipe,
                 const models::StudyOptions& options,
                 models::FittedModel* fitted) {
  try {
    models::AddUncertainty(dataset, std::move(recipe), options, fitted);
  } catch (const std::invalid_argument& error) {
    Warn(fmt::format("no interval: {}", error.what()));
  }
}

// One map for both ways along an axis is one for neither.
void RefuseBothWays(const data::Reading& reading,
                    const data::DatasetSelection& selection) {
  if (data::DirectionsOf(reading, selection).empty()) return;
  throw UsageError(fmt::format(
      "rows go both ways along {}, and the error depends on the direction; fit "
      "each with --direction up and --direction down, or both into a folder: "
      "-o FOLDER/",
      data::QuotedName(
          reading.position.column.value_or(*reading.direction.column))));
}

int FitOne(const FitArguments& arguments, const std::string& command_line) {
  CheckOutputName(
      "-o",
      arguments.out,
      arguments.data.PathsWith({models::FileOfSpec(arguments.model)}));
  RequirePlaceFor(arguments.out);
  auto recipe = RecipeFromArgument(arguments.model);
  const data::PreparedDataset prepared = ReadData(arguments.data);
  RefuseBothWays(prepared.reading, arguments.data.selection);
  const data::Dataset& dataset = prepared.dataset;
  const std::atomic<bool>& stop = InstallInterruptFlag();
  const models::FitContext context{
      .seed = arguments.seed,
      .explain = true,
      .threads = JobsOf(arguments.jobs),
      .keep_trace = arguments.format == "json",
      .indifference = models::DefaultIndifference(dataset.target().unit)};
  TimedFit fit;
  try {
    const fitting::InterruptionScope interruptible(&stop);
    fit = FitTimed(*recipe, dataset, context);
  } catch (const std::invalid_argument& error) {
    if (stop.load()) {
      Warn("interrupted before there was a map; nothing written");
      return kInterrupted;
    }
    Warn(fmt::format("{} failed: {}", arguments.model, error.what()));
    return kEveryFitFailed;
  }
  models::FittedModel& fitted = fit.map;
  const VectorXd predicted = fitted.Predict(dataset);
  if (const auto why = WhyFailed(fitted, predicted)) {
    Warn(fmt::format("{} failed: {}; nothing written", arguments.model, *why));
    return kEveryFitFailed;
  }
  const Json configuration = ConfigurationJson(*recipe, dataset, arguments);
  fitted.where = prepared.where;
  fitted.reading = std::make_shared<const data::Reading>(prepared.reading);
  models::AddExperience(dataset, &fitted);
  if (!arguments.no_interval && !stop.load()) {
    AddInterval(dataset,
                std::move(recipe),
                {.seed = context.seed,
                 .jobs = context.threads,
                 .stop = &stop,
                 .indifference = context.indifference},
                &fitted);
  }
  const std::vector<study_setup::InputFile> inputs =
      study_setup::HashInputs(arguments.data.files);
  models::SaveModel(
      fitted,
      study_setup::ModelProvenance(
          command_line, inputs, dataset.num_rows(), arguments.seed),
      arguments.out);
  const models::Sensitivity sensitivity =
      models::MeasureSensitivity(fitted, dataset);
  const stats::ErrorMetrics train = models::Judge(dataset, predicted);
  if (arguments.format == "json") {
    Json document =
        FitJson(fitted, fit.seconds, sensitivity, train, prepared, arguments);
    document["provenance"] =
        ProvenanceJson(command_line, configuration, inputs);
    PrintResult(DumpJson(document));
  } else {
    PrintResult(report::FitText(fitted,
                                sensitivity,
                                train,
                                dataset,
                                {.out = arguments.out,
                                 .correlations = arguments.correlations,
                                 .details = arguments.details,
                                 .terminal = OutputTerminal()}));
  }
  if (stop.load()) {
    Warn("interrupted; the best map so far was written");
    return kInterrupted;
  }
  return kDone;
}

bool NamesFolder(const std::string& out) {
  return out.ends_with('/') || std::filesystem::is_directory(out);
}

// The ways along the axis, and what their maps are called: by the file of each
// way if there is one, else by the first file and the way.
std::vector<std::pair<std::string, std::string>> MapsOfWays(
    const DataArguments& arguments,
    const std::vector<std::string>& ways,
    const std::string& name) {
  std::vector<data::DatasetSelection> selections;
  for (const std::string& way : ways) {
    selections.emplace_back(arguments.selection).direction = way;
  }
  const std::vector<std::string> names = study_setup::NamesByFile(
      data::ReadTables(arguments.files, arguments.selection).table, selections);
  std::vector<std::pair<std::string, std::string>> maps;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    maps.emplace_back(ways[i], names.empty() ? name + "_" + ways[i] : names[i]);
  }
  return maps;
}

// -o FOLDER/: a map for each way (MapsOfWays) where rows go both ways, else
// NAME.json, by the name of the first file.
int FitIntoFolder(const FitArguments& arguments,
                  const std::string& command_line) {
  const std::filesystem::path folder(arguments.out);
  const std::string name =
      std::filesystem::path(arguments.data.files.front()).stem().string();
  FitArguments one = arguments;
  one.data.quiet = true;
  const data::Reading reading = ReadData(one.data).reading;
  one.data.quiet = arguments.data.quiet;
  const bool both_ways =
      !data::DirectionsOf(reading, arguments.data.selection).empty();
  if (both_ways && arguments.format == "json") {
    throw UsageError(
        "--format json describes one map; choose it with --direction up or "
        "--direction down");
  }
  std::filesystem::create_directories(folder);
  if (!both_ways) {
    one.out = (folder / (name + ".json")).string();
    return FitOne(one, command_line);
  }
  for (const auto& [way, map] :
       MapsOfWays(arguments.data, reading.direction.values, name)) {
    one.data.selection.direction = way;
    one.out = (folder / (map + ".json")).string();
    if (const int status = FitOne(one, command_line); status != kDone) {
      return status;
    }
  }
  return kDone;
}

int RunFit(const FitArguments& arguments, const std::string& command_line) {
  return NamesFolder(arguments.out) ? FitIntoFolder(arguments, command_line)
                                    : FitOne(arguments, command_line);
}

}  // namespace

void AddFitCommand(CLI::App* app, Run* run) {
  const Command<FitArguments> command(
      app, run, "fit", "Fit one map to all rows and write it");
  AddDataArguments(command, &command->data);
  AddOption(command, "--model SPEC", command->model)
      .About("The model, e.g. poly:eq8")
      .Required();
  AddOption(command, "-o,--output FILE.json", command->out)
      .About("Model file to write, or a folder: a map per direction of motion")
      .Required()
      .Under(kOutputOptions);
  AddSeedOption(command, &command->seed);
  AddOption(command, "--jobs N", command->jobs)
      .About("Threads (default: one per core)\nResults do not depend on it")
      .Range(1, 1024);
  AddFlag(command, "--correlations", command->correlations)
      .About("Also print the correlations of inputs and target")
      .Under(kOutputOptions);
  AddFlag(command, "--no-interval", command->no_interval)
      .About(
          "Skip the fits that measure the error on held-out days, cycles or "
          "blocks");
  AddFlag(command, "--details", command->details)
      .About("Print the equation and tables in full, even if large")
      .Under(kOutputOptions);
  AddKeepPathsFlag(command);
  AddFormatOption(command, &command->format);
  SetFooter(command,
            "Example: errmap fit data/sets/turning_centre/six_days.csv --model "
            "poly:ridge:view=auto -o map.json");
  command.Runs(RunFit);
}

}  // namespace errmap::cli
