#include "models/fault_effect.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "models/error_model.h"
#include "models/inner_folds.h"
#include "models/recipe_catalog.h"
#include "stats/not_a_number.h"

namespace errmap::models {
namespace {

// RMSE on `judged` of a plane fitted to `training`.
double RmseOfPlane(const data::Dataset& training, const data::Dataset& judged) {
  try {
    const auto recipe =
        MakeRecipe(training.num_inputs() > 0 ? "poly:full:degree=1" : "mean");
    const VectorXd residuals =
        judged.target_values() - recipe->Fit(training, {}).Predict(judged);
    return std::sqrt(residuals.squaredNorm() /
                     static_cast<double>(residuals.size()));
  } catch (const std::invalid_argument&) {
    return stats::kNaN;  // too few rows
  }
}

// Of planes, each judged on the fold that it was not fitted to.
double HeldOutRmseOfPlane(const data::Dataset& dataset,
                          const fitting::FoldCodes& folds) {
  double squares = 0.0;
  for (Index fold = 0; fold < folds.count(); ++fold) {
    const auto rows = folds.Split(fold);
    const double rmse = RmseOfPlane(dataset.SelectRows(rows.train),
                                    dataset.SelectRows(rows.test));
    squares += rmse * rmse * static_cast<double>(rows.test.size());
  }
  return std::sqrt(squares / static_cast<double>(dataset.num_rows()));
}

// Rows spread evenly: a plane needs no more, and many inputs are asked about.
data::Dataset Thinned(const data::Dataset& dataset) {
  constexpr Index kEnough = 2000;
  const Index step = (dataset.num_rows() + kEnough - 1) / kEnough;
  if (step <= 1) return dataset;
  std::vector<Index> rows;
  for (Index row = 0; row < dataset.num_rows(); row += step) {
    rows.push_back(row);
  }
  return dataset.SelectRows(rows);
}

}  // namespace

FaultEffect EffectOfRows(const data::Dataset& dataset,
                         const std::vector<Index>& rows) {
  const data::Dataset sound = data::WithoutRows(dataset, rows);
  return {.rmse_with = RmseOfPlane(dataset, sound),
          .rmse_without = RmseOfPlane(sound, sound)};
}

FaultEffect EffectOfInput(const data::Dataset& all_rows, Index input) {
  const data::Dataset dataset = Thinned(all_rows);
  std::vector<data::ColumnInfo> inputs = dataset.inputs();
  inputs.erase(inputs.begin() + input);
  MatrixXd values(dataset.num_rows(), dataset.num_inputs() - 1);
  const Index after = values.cols() - input;
  values.leftCols(input) = dataset.input_values().leftCols(input);
  values.rightCols(after) = dataset.input_values().rightCols(after);
  const data::Dataset sound =
      dataset.WithInputs(std::move(inputs), std::move(values));
  const fitting::FoldCodes folds =
      MakeInnerFolds(dataset, {.inner_holdout = InnerHoldout::kWholeSessions})
          .folds;
  return {.rmse_with = HeldOutRmseOfPlane(dataset, folds),
          .rmse_without = HeldOutRmseOfPlane(sound, folds)};
}

}  // namespace errmap::models
