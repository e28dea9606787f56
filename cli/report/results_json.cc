#include "cli/report/results_json.h"

#include <cmath>
#include <map>

#include "cli/json_blocks.h"
#include "cli/report/figure_data.h"
#include "cli/report/fit_summary.h"
#include "cli/report/held_out_residuals.h"
#include "cli/report/regression_text.h"
#include "cli/report/residual_json.h"
#include "cli/report/residual_report.h"
#include "cli/report/start_report.h"
#include "cli/report/verdict_json.h"
#include "cli/study_file/fault_text.h"
#include "models/inner_folds.h"

namespace errmap::cli {
namespace {

using models::HoldoutResult;
using models::ModelResult;

// Folds' indices as 0-based data rows of the file.
Json RowsJson(const std::vector<Eigen::Index>& indices,
              const data::Dataset& dataset) {
  Json rows = Json::array();
  for (const Eigen::Index index : indices) {
    rows.push_back(dataset.rows()[static_cast<std::size_t>(index)]);
  }
  return rows;
}

Json NameOrNull(const std::string& name) {
  return name.empty() ? Json() : Json(name);
}

Json DataJson(const Comparison& comparison) {
  const data::Dataset& dataset = comparison.data.dataset;
  Json inputs = Json::array();
  for (const data::ColumnInfo& input : dataset.inputs()) {
    inputs.push_back(input.name);
  }
  Json dropped = Json::array();
  for (const data::DroppedColumn& column : comparison.data.dropped) {
    dropped.push_back({{"column", column.column}, {"why", column.why}});
  }
  return {
      {"file", comparison.file},
      {"sha256", comparison.sha256},
      {"rows", dataset.num_rows()},
      {"target", dataset.target().name},
      {"unit", dataset.target().unit.symbol},
      {"inputs", std::move(inputs)},
      {"group", dataset.has_groups() ? Json(dataset.groups().column) : Json()},
      {"session", NameOrNull(dataset.log()->sessions.column)},
      {"time", NameOrNull(comparison.data.time_column)},
      {"time_unit", dataset.log()->time_unit},
      {"sessions", dataset.num_sessions()},
      {"align", data::ToString(dataset.align())},
      {"dropped", std::move(dropped)},
      {"faults", FaultsJson(comparison.data)}};
}

// How each fold's training rows are held out for the choices made in a fit.
Json InnerTexts(const models::Holdout& holdout, const data::Dataset& dataset) {
  Json texts = Json::array();
  for (const stats::Fold& fold : holdout.folds) {
    texts.push_back(models::MakeInnerFolds(dataset.SelectRows(fold.train),
                                           {.inner_holdout = holdout.inner})
                        .text);
  }
  return texts;
}

Json HoldoutsJson(const Comparison& comparison) {
  Json holdouts = Json::array();
  for (std::size_t h = 0; h < comparison.holdouts.size(); ++h) {
    const models::Holdout& holdout = comparison.holdouts[h];
    Json train = Json::array();
    Json test = Json::array();
    for (const stats::Fold& fold : holdout.folds) {
      train.push_back(RowsJson(fold.train, comparison.data.dataset));
      if (holdout.test_data == nullptr) {
        test.push_back(RowsJson(fold.test, comparison.data.dataset));
      } else {
        test.push_back(holdout.test_data->rows());
      }
    }
    Json entry = {{"name", holdout.name},
                  {"folds", holdout.folds.size()},
                  {"whole_groups", holdout.whole_groups},
                  {"whole_sessions", holdout.whole_sessions},
                  {"among_neighbours", holdout.among_neighbours},
                  {"repeats", holdout.repeats},
                  {"inner", InnerTexts(holdout, comparison.data.dataset)},
                  {"train_rows", std::move(train)},
                  {"test_rows", std::move(test)}};
    entry.update(UnitsJson(comparison, h));
    holdouts.push_back(std::move(entry));
  }
  return holdouts;
}

Json ResultJson(const Comparison& comparison,
                std::size_t model,
                std::size_t holdout_index) {
  const HoldoutResult& result =
      comparison.study.models[model].holdouts[holdout_index];
  Json folds = Json::array();
  for (const models::FoldResult& fold : result.folds) {
    Json entry = {{"train_rmse", fold.train_rmse},
                  {"test_rmse", fold.test_rmse},
                  {"fit_seconds", fold.fit_seconds}};
    entry.update(FitSummaryJson(fold.summary));
    entry["remarks"] = fold.remarks;
    if (!fold.choices.empty()) entry["choices"] = ChoicesJson(fold.choices);
    if (!fold.starts.empty()) entry["starts"] = StartsJson(fold.starts);
    folds.push_back(std::move(entry));
  }
  const ResidualReport report =
      AssessResiduals(HeldOutResiduals(comparison, model, holdout_index));
  Json json = {
      {"train", MetricsJson(result.train)},
      {"test", MetricsJson(result.test)},
      {"folds", std::move(folds)},
      {"normality", NormalityJson(report.normality, report.monte_carlo)},
      {"randomness", RandomnessJson(report)}};
  json.update(StandingJson(comparison, model, holdout_index));
  return json;
}

// The fit to all rows, whose map is the one to use.
Json FinalFitJson(const ModelResult& model) {
  const models::FittedModel& map = *model.final_fit;
  Json json = {{"fit_seconds", model.final_fit_seconds}};
  json.update(FitSummaryJson(map.summary));
  json["remarks"] = map.remarks;
  if (!map.choices.empty()) json["choices"] = ChoicesJson(map.choices);
  if (!map.starts.empty()) json["starts"] = StartsJson(map.starts);
  return json;
}

Json ModelJson(const Comparison& comparison, std::size_t index) {
  const ModelResult& model = comparison.study.models[index];
  Json options = Json::object();
  for (const models::EffectiveOption& option : model.options) {
    std::visit([&](const auto& value) { options[option.key] = value; },
               option.value);
  }
  Json results = Json::object();
  for (std::size_t h = 0; h < model.holdouts.size(); ++h) {
    const HoldoutResult& result = model.holdouts[h];
    if (result.ok()) {
      results[result.holdout] = ResultJson(comparison, index, h);
    }
  }
  Json parameters;
  Json equation;
  Json sensors;
  Json inputs;
  Json final_fit;
  Json regression;
  if (model.final_fit) {
    const models::FittedModel& map = *model.final_fit;
    parameters = map.model->num_parameters();
    if (!map.equation.empty()) equation = map.equation;
    sensors = models::SensorsOf(map);
    inputs = Json::array();
    for (const models::TrainedInput& input : map.inputs) {
      inputs.push_back(input.column.name);
    }
    final_fit = FinalFitJson(model);
    if (map.regression != nullptr) regression = RegressionJson(*map.regression);
  }
  return {{"name", model.name},
          {"kind", models::ToString(model.kind)},
          {"choice", models::ToString(models::ChoiceOf(model))},
          {"baseline", model.baseline},
          {"options", std::move(options)},
          {"parameters", std::move(parameters)},
          {"equation", std::move(equation)},
          {"sensors", std::move(sensors)},
          {"inputs_used", std::move(inputs)},
          {"final", std::move(final_fit)},
          {"regression", std::move(regression)},
          {"memorisation", MemorisationJson(model)},
          {"status", model.ok() ? "ok" : "failed"},
          {"why", model.ok() ? Json() : Json(model.why())},
          {"results", std::move(results)},
          {"predict_ns", model.predict_ns}};
}

}  // namespace

Json ComponentJson(const Comparison& comparison) {
  Json models = Json::array();
  for (std::size_t i = 0; i < comparison.study.models.size(); ++i) {
    models.push_back(ModelJson(comparison, i));
  }
  return {{"name", comparison.name},
          {"data", DataJson(comparison)},
          {"goal", comparison.goal},
          {"indifference", comparison.indifference},
          {"display", DisplayJson(comparison)},
          {"holdouts", HoldoutsJson(comparison)},
          {"models", std::move(models)},
          {"gap", GapJson(comparison)},
          {"comparisons", ComparisonsJson(comparison)},
          {"tiers", TiersJson(comparison)},
          {"stability", StabilityJson(comparison)},
          {"verdict", VerdictsJson(comparison)},
          {"recommendation", RecommendationJson(comparison)},
          {"figures", FigureDataJson(comparison)}};
}

}  // namespace errmap::cli
