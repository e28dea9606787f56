#include "models/netcg/netcg_json.h"

#include <cmath>

namespace errmap::models {
namespace {

using Json = nlohmann::ordered_json;

Json FiguresJson(const NetcgFigures& figures) {
  return {{"mean", figures.mean},
          {"sd", figures.sd},
          {"min", figures.min},
          {"max", figures.max},
          {"r2", figures.r2},
          {"ks_d", figures.ks_d},
          {"ks_p", figures.ks_p}};
}

Json MatrixJson(const Eigen::MatrixXd& values) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    Json row = Json::array();
    for (const double value : values.row(i)) row.push_back(value);
    rows.push_back(row);
  }
  return rows;
}

const char* WordOf(NetcgPrecision precision) {
  return precision == NetcgPrecision::kSingle ? "single" : "double";
}

// What a run and an experiment have in common.
Json RunJson(const NetcgRecord& record) {
  const NetcgSpecification& run = record.specification;
  const NetcgResult& result = record.result;
  Json json = {
      {"title", run.title},
      {"kind", run.is_training() ? "training" : "testing"},
      {"nodes", {run.inputs, run.hidden, run.outputs}},
      {"patterns", run.patterns},
      {"weights", run.num_weights()},
      {"iterations", result.iterations},
      {"ierr", run.is_training() ? Json(result.ierr) : Json(nullptr)},
      {"function_calls", result.function_calls},
      {"error", result.error},
      {"rms_error", std::sqrt(2.0 * result.error)},
      {"gradient_ratio", result.gradient_ratio},
      {"weight_change", result.weight_change},
      {"as_printed", FiguresJson(result.printed)},
      {"corrected", FiguresJson(result.corrected)},
      {"corrected_scaling",
       result.corrected_scaling == NetcgScaling::kTraining ? "training"
                                                           : "test file"}};
  if (run.is_training()) {
    json["seconds"] = result.summary.seconds;
    json["mean_iteration_seconds"] = result.summary.mean_iteration_seconds;
    json["sd_iteration_seconds"] = result.summary.sd_iteration_seconds;
  }
  return json;
}

}  // namespace

Json NetcgJson(const std::string& file,
               const std::vector<NetcgRecord>& records,
               const NetcgOptions& options) {
  Json document = {{"schema", "errmap-netcg-1"},
                   {"file", file},
                   {"precision", WordOf(options.precision)}};
  Json& runs = document["runs"] = Json::array();
  for (const NetcgRecord& record : records) {
    Json run = RunJson(record);
    const NetcgFigures& printed = record.result.printed;
    run["error_curve"] = record.result.error_curve;
    run["desired"] = MatrixJson(printed.desired);
    run["predicted"] = MatrixJson(printed.predicted);
    run["predicted_corrected"] = MatrixJson(record.result.corrected.predicted);
    Json& files = run["files"] = Json::array();
    for (const auto& output : record.files) files.push_back(output.path);
    runs.push_back(run);
  }
  return document;
}

Json NetcgStudyJson(const NetcgStudy& study) {
  Json document = {{"schema", "errmap-netcg-study-1"},
                   {"folder", study.folder},
                   {"precision", WordOf(study.options.netcg.precision)},
                   {"seconds", study.seconds}};
  Json& runs = document["runs"] = Json::array();
  for (const NetcgStudyRun& experiment : study.runs) {
    const ReportRun& report = experiment.report;
    Json run = {{"number", report.number},
                {"direction", report.down ? "down" : "up"},
                {"selection", report.selection},
                {"thermocouples", experiment.thermocouples}};
    run.update(RunJson(experiment.record));
    run["report"] = {{"patterns", report.patterns},
                     {"thermocouples_printed", report.thermocouples},
                     {"thermocouples_implied", report.implied_thermocouples()},
                     {"input_nodes_printed", report.input_nodes},
                     {"weights", report.weights},
                     {"mean", report.mean},
                     {"sd", report.sd},
                     {"sd_corrected", report.sd * std::sqrt(2.0)},
                     {"min", report.min},
                     {"max", report.max},
                     {"mean_iteration_seconds", report.iteration_seconds},
                     {"sd_iteration_seconds", report.iteration_seconds_sd},
                     {"seconds", report.elapsed_seconds}};
    runs.push_back(run);
  }
  document["notes"] = study.notes;
  return document;
}

}  // namespace errmap::models
