#include "cli/report/figure_data.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <set>

#include "cli/report/regression_text.h"

namespace errmap::cli {
namespace {

using models::HoldoutResult;
using models::ModelResult;

constexpr Eigen::Index kMostRows = 5000;
constexpr std::size_t kMostInputs = 45;

// Nine digits are more than any figure shows.
Json Rounded(double value) {
  if (!std::isfinite(value)) return nullptr;
  constexpr int kDigits = 9;
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", kDigits, value);
  return std::strtod(text, nullptr);
}

// Rows spread evenly over 0 .. num_rows-1.
std::vector<Eigen::Index> ThinnedRows(Eigen::Index num_rows) {
  const Eigen::Index size = std::min(num_rows, kMostRows);
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < size; ++i) rows.push_back(i * num_rows / size);
  return rows;
}

// Inputs that a fitted map reads, in the data's order, the position first.
std::vector<std::string> UsedInputs(const Comparison& comparison,
                                    std::string* position) {
  const data::Dataset& dataset = comparison.data.dataset;
  const Eigen::Index at = models::FindPosition(dataset, "");
  if (at >= 0) *position = dataset.inputs()[static_cast<std::size_t>(at)].name;
  std::set<std::string> used;
  for (const ModelResult& model : comparison.study.models) {
    if (!model.final_fit) continue;
    for (const models::TrainedInput& input : model.final_fit->inputs) {
      used.insert(input.column.name);
    }
  }
  std::vector<std::string> names;
  if (!position->empty()) names.push_back(*position);
  for (const data::ColumnInfo& input : dataset.inputs()) {
    if (input.name != *position && used.contains(input.name)) {
      names.push_back(input.name);
    }
  }
  return names;
}

Json TableJson(const data::Dataset& source,
               const std::vector<Eigen::Index>& rows,
               const std::vector<std::string>& inputs) {
  Json numbers = Json::array();
  Json target = Json::array();
  Json groups = Json::array();
  for (const Eigen::Index row : rows) {
    const auto i = static_cast<std::size_t>(row);
    numbers.push_back(source.rows()[i]);
    target.push_back(Rounded(source.target_values()[row]));
    if (source.has_groups()) groups.push_back(source.groups().codes[i]);
  }
  Json columns = Json::array();
  for (const std::string& name : inputs) {
    const Eigen::Index column = source.FindInput(name);
    Json values = Json::array();
    for (const Eigen::Index row : rows) {
      values.push_back(
          column < 0 ? Json() : Rounded(source.input_values()(row, column)));
    }
    columns.push_back(std::move(values));
  }
  return {{"file", source.source()},
          {"rows_total", source.num_rows()},
          {"rows", std::move(numbers)},
          {"labels",
           source.has_groups() ? Json(source.groups().labels) : Json::array()},
          {"groups", std::move(groups)},
          {"target", std::move(target)},
          {"inputs", std::move(columns)}};
}

// Held-out prediction of every row of the source, NaN where it is in no test.
Eigen::VectorXd HeldOutPredictions(const models::Holdout& holdout,
                                   const HoldoutResult& result,
                                   Eigen::Index num_rows) {
  Eigen::VectorXd predicted = Eigen::VectorXd::Constant(
      num_rows, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t fold = 0; fold < result.folds.size(); ++fold) {
    const Eigen::VectorXd& values = result.folds[fold].test_predictions;
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      const Eigen::Index row =
          holdout.test_data != nullptr
              ? i
              : holdout.folds[fold].test[static_cast<std::size_t>(i)];
      if (std::isnan(predicted[row])) predicted[row] = values[i];
    }
  }
  return predicted;
}

Json HoldoutJson(const Comparison& comparison,
                 std::size_t index,
                 std::size_t table,
                 const std::vector<Eigen::Index>& rows,
                 Eigen::Index num_rows) {
  const models::Holdout& holdout = comparison.holdouts[index];
  Json predictions = Json::object();
  for (const ModelResult& model : comparison.study.models) {
    if (index >= model.holdouts.size()) continue;
    const HoldoutResult& result = model.holdouts[index];
    if (!result.ok()) continue;
    const Eigen::VectorXd all = HeldOutPredictions(holdout, result, num_rows);
    Json values = Json::array();
    for (const Eigen::Index row : rows) values.push_back(Rounded(all[row]));
    predictions[model.name] = std::move(values);
  }
  return {{"name", holdout.name},
          {"table", table},
          {"predictions", std::move(predictions)}};
}

Json RoundedCorrelation(const data::Dataset& dataset) {
  Json json = CorrelationJson(dataset);
  for (auto& row : json["matrix"]) {
    for (auto& value : row) {
      if (value.is_number()) value = Rounded(value.get<double>());
    }
  }
  return json;
}

}  // namespace

Json FigureDataJson(const Comparison& comparison) {
  const data::Dataset& dataset = comparison.data.dataset;
  std::string position;
  std::vector<std::string> used = UsedInputs(comparison, &position);
  const std::size_t left_out = used.size() - std::min(used.size(), kMostInputs);
  used.resize(used.size() - left_out);
  Json inputs = Json::array();
  for (const std::string& name : used) {
    const data::ColumnInfo& column =
        dataset.inputs()[static_cast<std::size_t>(dataset.FindInput(name))];
    inputs.push_back({{"name", name}, {"unit", column.unit.symbol}});
  }
  const std::vector<Eigen::Index> rows = ThinnedRows(dataset.num_rows());
  Json tables = Json::array({TableJson(dataset, rows, used)});
  Json holdouts = Json::array();
  for (std::size_t h = 0; h < comparison.holdouts.size(); ++h) {
    const auto& elsewhere = comparison.holdouts[h].test_data;
    if (elsewhere == nullptr) {
      holdouts.push_back(
          HoldoutJson(comparison, h, 0, rows, dataset.num_rows()));
      continue;
    }
    const std::vector<Eigen::Index> its = ThinnedRows(elsewhere->num_rows());
    holdouts.push_back(
        HoldoutJson(comparison, h, tables.size(), its, elsewhere->num_rows()));
    tables.push_back(TableJson(*elsewhere, its, used));
  }
  return {
      {"inputs", std::move(inputs)},
      {"inputs_left_out", left_out},
      {"position", position.empty() ? Json() : Json(position)},
      {"group", dataset.has_groups() ? Json(dataset.groups().column) : Json()},
      {"tables", std::move(tables)},
      {"holdouts", std::move(holdouts)},
      {"correlation", RoundedCorrelation(dataset)}};
}

}  // namespace errmap::cli
