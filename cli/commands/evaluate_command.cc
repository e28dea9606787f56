#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/map_warnings.h"
#include "cli/json_blocks.h"
#include "cli/report/summary_text.h"
#include "cli/shell/number_text.h"
#include "cli/shell/standard_streams.h"
#include "cli/study_file/data_arguments.h"
#include "cli/study_file/fault_text.h"
#include "cli/study_file/map_log.h"
#include "cli/study_file/provenance.h"
#include "models/model_file.h"
#include "models/study/fit_blocks.h"
#include "models/study/fold_pool.h"
#include "models/study/make_study_record.h"
#include "models/study/record_json.h"
#include "models/study/residual_record.h"
#include "models/trained_range.h"
#include "stats/kolmogorov_smirnov.h"

namespace errmap::cli {
namespace {

struct EvaluateArguments {
  std::string model;
  std::string file;
  std::string missing = "error";
  std::string faults = "keep";
  std::string format = "table";
  MapLogArguments log;
  bool quiet = false;
};

// The rows with what the map's filters run through.
data::Dataset RowsToJudge(const data::Dataset& dataset, const MapLog& map) {
  if (map.log == nullptr) return dataset;
  std::vector<Eigen::Index> log_rows;
  for (const Eigen::Index row : dataset.rows()) {
    log_rows.push_back(map.first_row + row);
  }
  return dataset.WithLog(map.log, std::move(log_rows));
}

// Rows outside of the trained range, and the inputs that are so.
Json OutsideJson(const std::vector<models::TrainedInput>& trained,
                 const Eigen::MatrixXd& values) {
  Eigen::Index rows = 0;
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    rows += models::IsInside(trained, values, row) ? 0 : 1;
  }
  Json inputs = Json::array();
  for (const models::InputOutside& found :
       models::InputsOutside(trained, values)) {
    const models::TrainedInput& input =
        trained[static_cast<std::size_t>(found.input)];
    inputs.push_back(
        {{"input", input.column.name},
         {"rows", found.num_rows},
         {"min", found.min},
         {"max", found.max},
         {"trained_min", input.min},
         {"trained_max", input.max},
         {"looks_like",
          found.looks_like.empty() ? Json() : Json(found.looks_like)}});
  }
  return {{"rows", rows}, {"inputs", std::move(inputs)}};
}

int RunEvaluate(const EvaluateArguments& arguments,
                const std::string& command_line) {
  const models::FittedModel fitted = models::LoadModel(arguments.model);
  data::DatasetSelection selection{
      .target = fitted.target.name,
      .inputs = {},
      .exclude = {},
      .group = "",
      .time = arguments.log.time,
      .session = arguments.log.session,
      .weight = "",
      .align = fitted.align,
      .missing = MissingPolicyOf(arguments.missing),
      .faults = FaultPolicyOf(arguments.faults),
      .keep_dead = true,
      .only_to_judge = true,
      .with_log = fitted.align != data::Alignment::kNone};
  for (const models::TrainedInput& input : fitted.inputs) {
    selection.inputs.push_back(input.column.name);
  }
  const data::CsvTable table = ReadForMap(
      fitted, arguments.file, MapColumns::kInputsAndTarget, arguments.quiet);
  const data::PreparedDataset prepared = data::MakeDataset(table, selection);
  const MapLog map =
      MakeMapLog(fitted, table, prepared.dataset.rows(), arguments.log);
  const data::Dataset dataset = RowsToJudge(prepared.dataset, map);
  if (!arguments.quiet) {
    for (const std::string& remark : prepared.remarks) Say(remark);
    for (const std::string& line :
         FaultLines(prepared, selection.faults, FaultUse::kJudge)) {
      Say(line);
    }
    for (const std::string& warning : map.warnings) Say(warning);
    SayOutside(fitted.inputs, dataset.input_values());
  }
  const models::Prediction prediction =
      fitted.PredictForm(fitted.FormInputs(dataset));
  const Eigen::VectorXd& predicted = prediction.errors;
  if (SayNotFinite(predicted, dataset.rows(), arguments.file)) {
    return kEveryFitFailed;
  }
  const Eigen::Index clipped = prediction.clipped.count();
  if (clipped > 0 && !arguments.quiet) {
    Say(fmt::format("warning: {} clipped by the map's guards",
                    Count(clipped, "row")));
  }
  const Eigen::VectorXd residuals = dataset.target_values() - predicted;
  const stats::ErrorMetrics metrics = models::Judge(dataset, predicted);
  const double ks_d = stats::KsDistanceFromNormal(
      residuals, metrics.residuals.mean, metrics.residuals.sd);
  const double ks_p = stats::KsProbabilityMeanSdGiven(ks_d, residuals.size());
  if (arguments.format == "json") {
    PrintResult(DumpJson(
        {{"schema", "errmap-evaluate-1"},
         {"model", fitted.name},
         {"file", arguments.file},
         {"target", fitted.target.name},
         {"unit", fitted.target.unit.symbol},
         {"align", data::ToString(fitted.align)},
         {"clipped", clipped},
         {"summary", models::ToJson(models::MakeRecord(metrics))},
         {"outside", OutsideJson(fitted.inputs, dataset.input_values())},
         {"faults", models::ToJson(models::MakeFaultRecords(prepared))},
         {"normality",
          models::ToJson(models::MakeRecord(
              stats::AssessNormality(stats::OrderedSample(residuals)), {}))},
         {"provenance",
          ProvenanceJson(
              command_line,
              {{"missing", arguments.missing}, {"faults", arguments.faults}},
              {HashInput(arguments.model), HashInput(arguments.file)})}}));
    return kDone;
  }
  PrintResult(
      fmt::format("{} ({}) on {}: target - predicted of {}\n{}",
                  arguments.model,
                  fitted.name,
                  arguments.file,
                  TargetText(dataset),
                  SummaryText(metrics, fitted.target.unit, ks_d, ks_p)));
  return kDone;
}

}  // namespace

void AddEvaluateCommand(CLI::App* app, Run* run) {
  auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* command = app->add_subcommand(
      "evaluate", "Judge a fitted map on measurements it may not know");
  command->add_option("MODEL", arguments->model, "Model file")
      ->required()
      ->type_name("FILE.json");
  command
      ->add_option("DATA", arguments->file, "CSV file with inputs and target")
      ->required()
      ->type_name("FILE.csv");
  AddRowOptions(command, &arguments->missing, &arguments->faults);
  command->add_option("--format", arguments->format, "table or json")
      ->check(CLI::IsMember({"table", "json"}))
      ->type_name("table|json")
      ->capture_default_str();
  AddMapLogArguments(command, &arguments->log);
  command->add_flag("--quiet", arguments->quiet, "No remarks on stderr");
  command->callback([arguments, run] {
    run->status = RunEvaluate(*arguments, run->command_line);
  });
}

}  // namespace errmap::cli
