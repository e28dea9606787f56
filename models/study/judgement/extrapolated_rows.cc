#include "models/study/judgement/extrapolated_rows.h"

namespace errmap::models {

std::vector<Eigen::Array<bool, Eigen::Dynamic, 1>> ExtrapolatedRows(
    const data::Dataset& dataset,
    const Holdout& holdout,
    const FittedModel& map) {
  std::vector<Eigen::Array<bool, Eigen::Dynamic, 1>> outside;
  for (const stats::Fold& fold : holdout.folds) {
    auto& rows = outside.emplace_back();
    rows.setConstant(holdout.test_data != nullptr
                         ? holdout.test_data->num_rows()
                         : static_cast<Eigen::Index>(fold.test.size()),
                     false);
    for (const TrainedInput& input : map.inputs) {
      const Eigen::Index column = dataset.FindInput(input.column.name);
      const auto values = dataset.input_values().col(column);
      const Eigen::VectorXd trained = values(fold.train);
      const Eigen::ArrayXd tested =
          holdout.test_data != nullptr
              ? Eigen::ArrayXd(holdout.test_data->input_values().col(column))
              : Eigen::ArrayXd(values(fold.test));
      rows = rows || tested < trained.minCoeff() || tested > trained.maxCoeff();
    }
  }
  return outside;
}

}  // namespace errmap::models
