#include "models/study/judgement/extrapolated_rows.h"

namespace errmap::models {

FoldValues ValuesOfFold(const data::Dataset& dataset,
                        const Holdout& holdout,
                        const stats::Fold& fold,
                        Index input) {
  const auto values = dataset.input_values().col(input);
  return {values(fold.train),
          holdout.test_data != nullptr
              ? VectorXd(holdout.test_data->input_values().col(input))
              : VectorXd(values(fold.test))};
}

std::vector<Eigen::Array<bool, Eigen::Dynamic, 1>> ExtrapolatedRows(
    const data::Dataset& dataset,
    const Holdout& holdout,
    const FittedModel& map) {
  std::vector<Eigen::Array<bool, Eigen::Dynamic, 1>> outside;
  for (const stats::Fold& fold : holdout.folds) {
    auto& rows = outside.emplace_back();
    rows.setConstant(holdout.test_data != nullptr
                         ? holdout.test_data->num_rows()
                         : std::ssize(fold.test),
                     false);
    for (const TrainedInput& input : map.inputs) {
      const auto [trained, tested] = ValuesOfFold(
          dataset, holdout, fold, dataset.FindInput(input.column.name));
      rows = rows || tested.array() < trained.minCoeff() ||
             tested.array() > trained.maxCoeff();
    }
  }
  return outside;
}

}  // namespace errmap::models
