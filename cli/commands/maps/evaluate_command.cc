#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/commands/maps/map_warnings.h"
#include "cli/json_blocks.h"
#include "cli/report/documents/fit_text.h"
#include "cli/report/number_text.h"
#include "cli/report/text/answers/data_words.h"
#include "cli/report/text/commands/calibration_check_text.h"
#include "cli/report/text/commands/check_text.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "cli/study_setup/provenance.h"
#include "data/measurements/measured_files.h"
#include "data/text.h"
#include "models/record_json.h"
#include "models/sensors/sensor_check.h"
#include "models/session/calibration_check.h"
#include "models/session/map_rows.h"
#include "models/study/fold_pool.h"
#include "models/study/record/builders/parts.h"
#include "models/study/record/make_study_record.h"
#include "models/trained_range.h"
#include "stats/kolmogorov_smirnov.h"

namespace errmap::cli {
namespace {

struct EvaluateArguments {
  std::string model;
  std::vector<std::string> files;
  models::MapRowsOptions rows;
  std::string format = "table";
  bool quiet = false;
};

// Rows outside of the trained range, and the inputs that are so.
Json OutsideJson(const std::vector<models::TrainedInput>& trained,
                 const MatrixXd& values) {
  Index rows = 0;
  for (Index row = 0; row < values.rows(); ++row) {
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

// Rows unlike training, by what they are unlike in, and the worst.
Json UnlikeJson(const std::vector<models::RowFlag>& flags,
                const std::vector<Index>& rows) {
  Json json = {{"rows", 0},
               {"range", 0},
               {"relation", 0},
               {"distance", 0},
               {"leverage", 0},
               {"worst", nullptr}};
  double worst = 0.0;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    const models::RowFlag& flag = flags[i];
    if (!flag.outside()) continue;
    const std::string why(ToString(flag.why));
    json["rows"] = json["rows"].get<int>() + 1;
    json[why] = json[why].get<int>() + 1;
    if (flag.severity <= worst) continue;
    worst = flag.severity;
    json["worst"] = {
        {"row", rows[i]},
        {"why", why},
        {"column", flag.column.name.empty() ? Json() : Json(flag.column.name)},
        {"value", flag.value},
        {"low", flag.low},
        {"high", flag.high},
        {"severity", flag.severity}};
  }
  return json;
}

Json SensorJson(const std::optional<models::SensorFaultFound>& sensor) {
  if (!sensor) return nullptr;
  Json columns = Json::array();
  for (const data::ColumnInfo& column : sensor->columns) {
    columns.push_back(column.name);
  }
  return {{"fault", ToString(sensor->fault)}, {"columns", std::move(columns)}};
}

// What was found of a map on the rows of a file.
struct Evaluation {
  const models::FittedModel& fitted;
  const models::MapRows& rows;
  const RowsJudged& judged;
  Index clipped;  // rows
  std::optional<models::SensorFaultFound> sensor;
  models::CalibrationCheck kept;
  RowsLearnt learnt;
  VectorXd residuals;
  stats::ErrorMetrics metrics;
};

Json EvaluationJson(const Evaluation& found,
                    const EvaluateArguments& arguments,
                    const std::string& command_line) {
  const models::FittedModel& fitted = found.fitted;
  const data::Dataset& dataset = found.rows.dataset;
  Json json = MapAnswerJson("errmap-evaluate-1", fitted, arguments.files);
  json.update(Json{
      {"align", data::ToString(fitted.align)},
      {"clipped", found.clipped},
      {"learnt_from", LearntJson(found.learnt)},
      {"summary", models::ToJson(found.metrics)},
      {"promise", models::ToJson(found.kept)},
      {"outside", OutsideJson(fitted.inputs, dataset.input_values())},
      {"unlike", UnlikeJson(found.judged.flags, dataset.rows())},
      {"sensor_fault", SensorJson(found.sensor)},
      {"faults", models::ToJson(models::MakeFaultRecords(found.rows.prepared))},
      {"normality",
       models::ToJson(models::MakeRecord(
           stats::AssessNormality(stats::OrderedSample(found.residuals)), {}))},
      {"provenance",
       ProvenanceJson(
           command_line,
           {{"missing", ToString(arguments.rows.missing)},
            {"faults", ToString(arguments.rows.faults)}},
           study_setup::HashInputs(arguments.files, {arguments.model}))}});
  return json;
}

std::string EvaluationText(const Evaluation& found,
                           const EvaluateArguments& arguments) {
  const data::Unit& unit = found.fitted.target.unit;
  const double ks_d = stats::KsDistanceFromNormal(
      found.residuals, found.metrics.mean, found.metrics.sd);
  return fmt::format(
      "{} ({}) on {}: target - predicted of {}\n{}{}{}",
      arguments.model,
      found.fitted.name,
      data::NamesOfFiles(arguments.files),
      report::TargetWords(found.rows.dataset),
      LearntText(found.learnt),
      report::SummaryText(
          found.metrics,
          unit,
          ks_d,
          stats::KsProbabilityMeanSdGiven(ks_d, found.residuals.size())),
      // Errors of wrong readings tell nothing of the map.
      found.sensor
          ? report::FoundText(found.kept, unit) +
                report::SensorText(*found.sensor)
          : report::KeptPromiseText(found.kept, found.residuals.size(), unit));
}

// Its row counts in the file.
std::optional<models::SensorFaultFound> SensorFaultOf(
    const models::FittedModel& fitted, const data::Dataset& dataset) {
  auto found = models::FindSensorFault(fitted, dataset.input_values());
  if (found && found->row >= 0) {
    found->row = dataset.rows()[static_cast<std::size_t>(found->row)];
  }
  return found;
}

int RunEvaluate(const EvaluateArguments& arguments,
                const std::string& command_line) {
  const models::FittedModel fitted = LoadMap(arguments.model, arguments.quiet);
  const models::MapRows rows =
      ReadMapRows(fitted, arguments.files, arguments.rows, arguments.quiet);
  const data::Dataset& dataset = rows.dataset;
  const RowsJudged judged = JudgeMapRows(fitted, rows, arguments.quiet);
  const models::Prediction prediction = fitted.PredictForm(judged.form_inputs);
  const VectorXd& predicted = prediction.errors;
  const std::string files = data::NamesOfFiles(arguments.files);
  if (SayNotFinite(predicted, dataset.rows(), files)) {
    return kEveryFitFailed;
  }
  const Evaluation found{
      .fitted = fitted,
      .rows = rows,
      .judged = judged,
      .clipped = prediction.clipped.count(),
      .sensor = SensorFaultOf(fitted, dataset),
      .kept = models::CheckCalibration(
          fitted, dataset.target_values(), predicted, judged.flags),
      .learnt = FindRowsLearnt(fitted, arguments.model, arguments.files, rows),
      .residuals = dataset.target_values() - predicted,
      .metrics = models::Judge(dataset, predicted)};
  // Of rows outside it has been said.
  if (found.clipped > 0 && !arguments.quiet &&
      std::ranges::none_of(judged.flags, &models::RowFlag::outside)) {
    Warn(fmt::format("warning: {} clipped by the map's guards",
                     report::Count(found.clipped, "row")));
  }
  if (!(found.metrics.rmse <= models::kLargestRmse)) {
    Warn(
        fmt::format("{}: the predictions are off by {:.3g} RMSE, too large to "
                    "be squared; do not use the map there",
                    data::PrintablePath(files),
                    found.metrics.rmse));
    return kEveryFitFailed;
  }
  if (arguments.format == "json") {
    PrintResult(DumpJson(EvaluationJson(found, arguments, command_line)));
  } else {
    PrintFitted(EvaluationText(found, arguments));
  }
  return kDone;
}

}  // namespace

void AddEvaluateCommand(CLI::App* app, Run* run) {
  const Command<EvaluateArguments> command(
      app, run, "evaluate", "Judge a fitted map on other measurements");
  AddModelArgument(command, &command->model);
  AddOption(command, "DATA FILE.csv", command->files)
      .About(
          "CSV file with inputs and target, or several: days of one component")
      .Required();
  AddRowOptions(command, &command->rows.missing, &command->rows.faults);
  AddFormatOption(command, &command->format);
  AddMapDataArguments(command, &command->rows.log);
  AddTargetOfMap(command, &command->rows.log);
  AddJoinedLogArguments(command, &command->rows.log);
  AddFromRest(command, &command->rows.log);
  AddQuietFlag(command, &command->quiet);
  SetFooter(command,
            "Example: errmap evaluate map.json "
            "data/sets/turning_centre/later_days.csv");
  command.Runs(RunEvaluate);
}

}  // namespace errmap::cli
