#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>

#include "models/study/judgement/extrapolated_rows.h"
#include "models/study/record/builders/parts.h"
#include "stats/indices.h"

namespace errmap::models {
namespace {

constexpr Index kMostRows = 5000;
constexpr std::size_t kMostInputs = 45;

// Nine digits are more than any figure shows.
double Rounded(double value) {
  if (!std::isfinite(value)) return kNotKnown;
  constexpr int kDigits = 9;
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", kDigits, value);
  return std::strtod(text, nullptr);
}

// Inputs that a fitted map reads, in the data's order, the position first.
std::vector<std::string> UsedInputs(const ComponentStudy& study,
                                    std::optional<std::string>* position) {
  const data::Dataset& dataset = study.data.dataset;
  const Index at = FindPosition(dataset, "");
  if (at >= 0) *position = dataset.inputs()[static_cast<std::size_t>(at)].name;
  std::set<std::string> used;
  for (const ModelResult& model : study.study.models) {
    if (!model.final_fit) continue;
    for (const TrainedInput& input : model.final_fit->inputs) {
      used.insert(input.column.name);
    }
  }
  std::vector<std::string> names;
  if (*position) names.push_back(**position);
  for (const data::ColumnInfo& input : dataset.inputs()) {
    if (input.name != *position && used.contains(input.name)) {
      names.push_back(input.name);
    }
  }
  return names;
}

FigureTableRecord MakeTable(const data::Dataset& source,
                            const std::vector<Index>& rows,
                            const std::vector<FigureInputRecord>& inputs) {
  FigureTableRecord table;
  table.file = source.source();
  table.rows_total = source.num_rows();
  if (source.has_groups()) table.labels = source.groups().labels;
  for (const Index row : rows) {
    const auto i = static_cast<std::size_t>(row);
    table.rows.push_back(source.rows()[i]);
    table.target.push_back(Rounded(source.target_values()[row]));
    if (source.has_groups()) table.groups.push_back(source.groups().codes[i]);
  }
  if (source.has_sessions()) {
    const std::vector<Index> codes = source.session_codes();
    table.session_labels = source.log()->sessions.labels;
    table.sessions.emplace();
    for (const Index row : rows) {
      table.sessions->push_back(codes[static_cast<std::size_t>(row)]);
    }
  }
  if (source.log() != nullptr && source.log()->time_unit == "s") {
    table.time.emplace();
    for (const Index row : rows) {
      const auto of_log = source.log_rows()[static_cast<std::size_t>(row)];
      table.time->push_back(Rounded(source.log()->time[of_log]));
    }
  }
  for (const FigureInputRecord& input : inputs) {
    const Index column = source.FindInput(input.name);
    std::vector<double>& values = table.inputs.emplace_back();
    for (const Index row : rows) {
      values.push_back(
          column < 0 ? kNotKnown : Rounded(source.input_values()(row, column)));
    }
  }
  return table;
}

FigureHoldoutRecord MakeFigureHoldout(const ComponentStudy& study,
                                      std::size_t index,
                                      std::size_t table,
                                      const std::vector<Index>& rows,
                                      Index num_rows) {
  FigureHoldoutRecord record{.name = study.holdouts[index].name,
                             .table = static_cast<std::int64_t>(table)};
  for (const ModelResult& model : study.study.models) {
    if (index >= model.holdouts.size()) continue;
    const HoldoutResult& result = model.holdouts[index];
    if (!result.ok()) continue;
    const VectorXd all =
        HeldOutPredictions(study.holdouts[index], result, num_rows);
    std::vector<double> values;
    for (const Index row : rows) values.push_back(Rounded(all[row]));
    record.predictions.emplace_back(model.name, std::move(values));
  }
  return record;
}

// Entries of `rows` with an input of the map outside what its fold saw.
std::vector<std::int64_t> RowsOutside(const data::Dataset& dataset,
                                      const Holdout& holdout,
                                      const FittedModel& map,
                                      const std::vector<Index>& rows) {
  std::vector<bool> outside(
      static_cast<std::size_t>(holdout.Source(dataset).num_rows()));
  const auto of_folds = ExtrapolatedRows(dataset, holdout, map);
  for (std::size_t fold = 0; fold < of_folds.size(); ++fold) {
    Index i = 0;
    for (const Index row : holdout.folds[fold].test) {
      if (of_folds[fold][i++]) outside[static_cast<std::size_t>(row)] = true;
    }
  }
  std::vector<std::int64_t> entries;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (outside[static_cast<std::size_t>(rows[i])]) {
      entries.push_back(static_cast<std::int64_t>(i));
    }
  }
  return entries;
}

// Of rows scaled by the roots of their weights.
MatrixXd Correlations(const data::Dataset& dataset) {
  const Index p = dataset.num_inputs();
  MatrixXd values(dataset.num_rows(), p + 1);
  values << dataset.input_values(), dataset.target_values();
  VectorXd weights = dataset.weights();
  if (weights.size() == 0) weights = VectorXd::Ones(values.rows());
  const Eigen::RowVectorXd means = weights.transpose() * values / weights.sum();
  values.rowwise() -= means;
  values = weights.cwiseSqrt().asDiagonal() * values;
  for (Index j = 0; j <= p; ++j) {
    const double length = values.col(j).norm();
    if (length > 0.0) values.col(j) /= length;
  }
  MatrixXd correlations = values.transpose() * values;
  for (Index j = 0; j <= p; ++j) {
    if (correlations(j, j) > 0.0) correlations(j, j) = 1.0;
  }
  return correlations;
}

}  // namespace

CorrelationRecord Correlate(const data::Dataset& dataset) {
  CorrelationRecord record;
  record.columns = dataset.InputNames();
  record.columns.push_back(dataset.target().name);
  const MatrixXd matrix = Correlations(dataset);
  for (Index i = 0; i < matrix.rows(); ++i) {
    const VectorXd row = matrix.row(i);
    record.matrix.emplace_back(row.begin(), row.end());
  }
  return record;
}

FiguresRecord MakeFiguresRecord(const ComponentStudy& study) {
  const data::Dataset& dataset = study.data.dataset;
  FiguresRecord record;
  std::vector<std::string> used = UsedInputs(study, &record.position);
  const std::size_t left_out = used.size() - std::min(used.size(), kMostInputs);
  used.resize(used.size() - left_out);
  record.inputs_left_out = static_cast<std::int64_t>(left_out);
  for (const std::string& name : used) {
    const data::ColumnInfo& column =
        dataset.inputs()[static_cast<std::size_t>(dataset.FindInput(name))];
    record.inputs.push_back({.name = name, .unit = column.unit.symbol});
  }
  if (dataset.has_groups()) record.group = dataset.groups().column;
  const std::vector<Index> rows =
      stats::SpreadSample(dataset.num_rows(), kMostRows);
  record.tables.push_back(MakeTable(dataset, rows, record.inputs));
  for (std::size_t h = 0; h < study.holdouts.size(); ++h) {
    const auto& elsewhere = study.holdouts[h].test_data;
    if (elsewhere == nullptr) {
      record.holdouts.push_back(
          MakeFigureHoldout(study, h, 0, rows, dataset.num_rows()));
      continue;
    }
    const std::vector<Index> its =
        stats::SpreadSample(elsewhere->num_rows(), kMostRows);
    record.holdouts.push_back(MakeFigureHoldout(
        study, h, record.tables.size(), its, elsewhere->num_rows()));
    record.tables.push_back(MakeTable(*elsewhere, its, record.inputs));
  }
  if (const auto& advice = study.judgement.recommendation) {
    const FittedModel& map = *study.study.models[advice->model].final_fit;
    const Holdout& holdout = study.holdouts[advice->holdout];
    record.holdouts[advice->holdout].outside = RowsOutside(
        dataset,
        holdout,
        map,
        stats::SpreadSample(holdout.Source(dataset).num_rows(), kMostRows));
    const VectorXd fitted = map.Predict(dataset);
    record.fitted.emplace();
    for (const Index row : rows) {
      record.fitted->push_back(Rounded(fitted[row]));
    }
  }
  return record;
}

}  // namespace errmap::models
