#include "models/study/judgement/extrapolated_rows.h"

namespace errmap::models {

FoldValues ValuesOfFold(const data::Dataset& dataset,
                        const Holdout& holdout,
                        const stats::Fold& fold,
                        Index input) {
  const auto values = dataset.input_values().col(input);
  const VectorXd trained = values(fold.train);
  return {trained.minCoeff(),
          trained.maxCoeff(),
          holdout.Source(dataset).input_values().col(input)(fold.test)};
}

std::vector<RowFlags> ExtrapolatedRows(const data::Dataset& dataset,
                                       const Holdout& holdout,
                                       const FittedModel& map) {
  std::vector<RowFlags> outside;
  for (const stats::Fold& fold : holdout.folds) {
    auto& rows = outside.emplace_back();
    rows.setConstant(std::ssize(fold.test), false);
    for (const TrainedInput& input : map.inputs) {
      const FoldValues values = ValuesOfFold(
          dataset, holdout, fold, dataset.FindInput(input.column.name));
      rows = rows || values.Below() || values.Above();
    }
  }
  return outside;
}

}  // namespace errmap::models
