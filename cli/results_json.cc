#include "cli/results_json.h"

#include <cmath>
#include <map>

#include "cli/fit_summary.h"
#include "cli/json_blocks.h"
#include "cli/residual_json.h"
#include "cli/residual_report.h"
#include "cli/start_report.h"
#include "cli/verdict_text.h"

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
      {"dropped", std::move(dropped)}};
}

Json HoldoutsJson(const Comparison& comparison) {
  Json holdouts = Json::array();
  for (const models::Holdout& holdout : comparison.holdouts) {
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
    holdouts.push_back({{"name", holdout.name},
                        {"folds", holdout.folds.size()},
                        {"train_rows", std::move(train)},
                        {"test_rows", std::move(test)}});
  }
  return holdouts;
}

// The held-out residuals of all folds in the file's order. Of a row that is
// held out more than once (groups:K:repeats=R) the first is taken.
ResidualInputs HeldOutResiduals(const Comparison& comparison,
                                const HoldoutResult& result,
                                std::size_t holdout_index) {
  const models::Holdout& holdout = comparison.holdouts[holdout_index];
  const bool elsewhere = holdout.test_data != nullptr;
  const data::Dataset& source =
      elsewhere ? *holdout.test_data : comparison.data.dataset;
  std::map<Eigen::Index, double> predicted;  // by index into source
  for (std::size_t fold = 0; fold < result.folds.size(); ++fold) {
    const Eigen::VectorXd& predictions = result.folds[fold].test_predictions;
    for (Eigen::Index i = 0; i < predictions.size(); ++i) {
      const Eigen::Index index =
          elsewhere ? i : holdout.folds[fold].test[static_cast<std::size_t>(i)];
      predicted.emplace(index, predictions[i]);
    }
  }
  ResidualInputs inputs;
  const auto size = static_cast<Eigen::Index>(predicted.size());
  inputs.values.resize(size);
  inputs.fitted.resize(size);
  inputs.fitted_column = "predicted";
  if (source.has_groups()) {
    inputs.group_column = source.groups().column;
    inputs.group_labels = source.groups().labels;
  }
  Eigen::Index position = -1;
  for (Eigen::Index i = 0; i < source.num_inputs() && position < 0; ++i) {
    const std::string& name = source.inputs()[static_cast<std::size_t>(i)].name;
    if (!name.starts_with("position")) continue;
    position = i;
    inputs.position_column = name;
    inputs.positions.resize(size);
  }
  Eigen::Index at = 0;
  for (const auto& [index, value] : predicted) {
    inputs.fitted[at] = value;
    inputs.values[at] = source.target_values()[index] - value;
    if (source.has_groups()) {
      inputs.group_codes.push_back(
          source.groups().codes[static_cast<std::size_t>(index)]);
    }
    if (position >= 0) {
      inputs.positions[at] = source.input_values()(index, position);
    }
    ++at;
  }
  return inputs;
}

Json ResultJson(const Comparison& comparison,
                const HoldoutResult& result,
                std::size_t holdout_index) {
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
      AssessResiduals(HeldOutResiduals(comparison, result, holdout_index));
  return {{"train", MetricsJson(result.train)},
          {"test", MetricsJson(result.test)},
          {"folds", std::move(folds)},
          {"normality", NormalityJson(report.normality, report.monte_carlo)},
          {"randomness", RandomnessJson(report)}};
}

Json ModelJson(const Comparison& comparison, const ModelResult& model) {
  Json options = Json::object();
  for (const models::EffectiveOption& option : model.options) {
    std::visit([&](const auto& value) { options[option.key] = value; },
               option.value);
  }
  Json results = Json::object();
  for (std::size_t h = 0; h < model.holdouts.size(); ++h) {
    const HoldoutResult& result = model.holdouts[h];
    if (result.ok())
      results[result.holdout] = ResultJson(comparison, result, h);
  }
  Json parameters;
  Json equation;
  if (model.final_fit) {
    parameters = model.final_fit->model->num_parameters();
    if (!model.final_fit->equation.empty()) {
      equation = model.final_fit->equation;
    }
  }
  return {{"name", model.name},
          {"kind", models::ToString(model.kind)},
          {"options", std::move(options)},
          {"parameters", std::move(parameters)},
          {"equation", std::move(equation)},
          {"status", model.ok() ? "ok" : "failed"},
          {"why", model.ok() ? Json() : Json(model.why())},
          {"results", std::move(results)},
          {"predict_ns", model.predict_ns}};
}

Json VerdictsJson(const Comparison& comparison) {
  Json verdicts = Json::array();
  for (const models::Verdict& verdict : comparison.verdicts) {
    if (verdict.best < 0) continue;
    const ModelResult& best =
        comparison.study.models[static_cast<std::size_t>(verdict.best)];
    verdicts.push_back({{"holdout", verdict.holdout},
                        {"choice", models::ChoiceWord(best.kind)},
                        {"model", best.name},
                        {"established", false},
                        {"why", VerdictSentence(comparison, verdict)}});
  }
  return verdicts;
}

Json RecommendationJson(const Comparison& comparison) {
  const models::Verdict* decisive =
      models::DecisiveVerdict(comparison.verdicts);
  if (decisive == nullptr) return nullptr;
  const ModelResult& best =
      comparison.study.models[static_cast<std::size_t>(decisive->best)];
  return {{"choice", models::ChoiceWord(best.kind)},
          {"model", best.name},
          {"why", RecommendationSentence(comparison)},
          {"caveats", Caveats(comparison)}};
}

}  // namespace

Json ComponentJson(const Comparison& comparison) {
  Json models = Json::array();
  for (const ModelResult& model : comparison.study.models) {
    models.push_back(ModelJson(comparison, model));
  }
  return {{"name", comparison.name},
          {"data", DataJson(comparison)},
          {"goal", comparison.goal},
          {"holdouts", HoldoutsJson(comparison)},
          {"models", std::move(models)},
          {"comparisons", Json::array()},
          {"tiers", Json::object()},
          {"verdict", VerdictsJson(comparison)},
          {"recommendation", RecommendationJson(comparison)}};
}

}  // namespace errmap::cli
