#include "models/study/given_predictions.h"

#include <vector>

#include <fmt/format.h>

#include "models/study/fold_pool.h"
#include "models/study/row_table.h"
#include "stats/not_a_number.h"

namespace errmap::models {
namespace {

using ByRow = std::map<Index, double>;

// Predictions of every row of `rows`; stops at the first row without one.
std::optional<VectorXd> PredictionsOf(const data::Dataset& rows,
                                      const ByRow& by_row,
                                      Index* missing) {
  VectorXd predictions(rows.num_rows());
  for (Index i = 0; i < rows.num_rows(); ++i) {
    const Index row = rows.rows()[static_cast<std::size_t>(i)];
    const auto found = by_row.find(row);
    if (found == by_row.end()) {
      *missing = row;
      return std::nullopt;
    }
    predictions[i] = found->second;
  }
  return predictions;
}

// The table that serves a fold, or null.
const ByRow* TableFor(const GivenPredictions& given,
                      const Holdout& holdout,
                      Index fold) {
  const auto found = given.by_fold.find({holdout.name, fold});
  if (found != given.by_fold.end()) return &found->second;
  // Rows of another file have other numbers.
  if (holdout.test_data != nullptr || given.by_row.empty()) return nullptr;
  return &given.by_row;
}

FitOutcome OutcomeOf(const GivenPredictions& given,
                     const Holdout& holdout,
                     Index fold,
                     const PreparedFold& prepared) {
  FitOutcome outcome;
  const ByRow* table = TableFor(given, holdout, fold);
  if (table == nullptr) {
    outcome.why_failed =
        fmt::format("{} has no predictions for it", given.file);
    return outcome;
  }
  Index missing = -1;
  const auto test = PredictionsOf(*prepared.test, *table, &missing);
  if (!test) {
    outcome.why_failed =
        fmt::format("{} has no prediction of data row {}", given.file, missing);
    return outcome;
  }
  outcome.test_predictions = *test;
  // Training rows of the data file; the table of another file has other rows.
  if (holdout.test_data == nullptr) {
    const auto train = PredictionsOf(prepared.training, *table, &missing);
    if (train) outcome.train_predictions = *train;
  }
  FittedModel stand_in;
  stand_in.name = given.name;
  stand_in.kind = ModelKind::kFile;
  stand_in.summary.termination = fitting::Termination::kDirect;
  stand_in.summary.message = "predictions made elsewhere";
  outcome.fitted = std::move(stand_in);
  return outcome;
}

}  // namespace

GivenPredictions ReadGivenPredictions(const std::string& name,
                                      const data::CsvTable& file) {
  const RowTable table(file);
  const bool by_fold = table.Has("holdout") || table.Has("fold");
  table.Require(
      by_fold ? std::vector<std::string>{"row", "holdout", "fold", "predicted"}
              : std::vector<std::string>{"row", "predicted"});
  GivenPredictions given;
  given.name = name;
  given.file = file.file;
  for (std::size_t line = 0; line < table.num_lines(); ++line) {
    const Index row = table.Whole(line, "row");
    ByRow* rows = &given.by_row;
    if (by_fold) {
      rows = &given.by_fold[{table.Text(line, "holdout"),
                             table.Whole(line, "fold")}];
    }
    if (!rows->emplace(row, table.Number(line, "predicted")).second) {
      table.Refuse(line, "row", fmt::format("data row {} stands twice", row));
    }
  }
  return given;
}

ModelResult JudgeGivenPredictions(const GivenPredictions& given,
                                  const data::Dataset& dataset,
                                  const std::vector<Holdout>& holdouts) {
  ModelResult model;
  model.name = given.name;
  model.kind = ModelKind::kFile;
  model.predict_ns = stats::kNaN;
  for (std::size_t h = 0; h < holdouts.size(); ++h) {
    std::vector<FoldOutcome> outcomes;
    for (std::size_t fold = 0; fold < holdouts[h].folds.size(); ++fold) {
      outcomes.push_back(
          JudgeFold(dataset,
                    holdouts[h],
                    fold,
                    OutcomeOf(given,
                              holdouts[h],
                              static_cast<Index>(fold),
                              PrepareFold(dataset, holdouts[h], fold))));
    }
    model.holdouts.push_back(
        PoolFolds(dataset, holdouts[h], std::move(outcomes)));
  }
  return model;
}

}  // namespace errmap::models
