#include <cmath>
#include <vector>

#include "models/study/record/builders/parts.h"

namespace errmap::models {

VectorXd HeldOutPredictions(const Holdout& holdout,
                            const HoldoutResult& result,
                            Index num_rows) {
  VectorXd predicted = VectorXd::Constant(num_rows, kNotKnown);
  for (std::size_t fold = 0; fold < result.folds.size(); ++fold) {
    const VectorXd& values = result.folds[fold].test_predictions;
    for (Index i = 0; i < values.size(); ++i) {
      const Index row = holdout.folds[fold].test[static_cast<std::size_t>(i)];
      if (std::isnan(predicted[row])) predicted[row] = values[i];
    }
  }
  return predicted;
}

ResidualInputs HeldOutResiduals(const ComponentStudy& comparison,
                                std::size_t model,
                                std::size_t holdout_index) {
  const Holdout& holdout = comparison.holdouts[holdout_index];
  const data::Dataset& source = holdout.Source(comparison.data.dataset);
  const VectorXd predicted =
      HeldOutPredictions(holdout,
                         comparison.study.models[model].holdouts[holdout_index],
                         source.num_rows());
  std::vector<Index> rows;
  for (Index row = 0; row < predicted.size(); ++row) {
    if (!std::isnan(predicted[row])) rows.push_back(row);
  }
  ResidualInputs inputs;
  inputs.fitted = predicted(rows);
  inputs.values = source.target_values()(rows) - inputs.fitted;
  inputs.fitted_column = "predicted";
  if (source.has_groups()) {
    inputs.group_column = source.groups().column;
    inputs.group_labels = source.groups().labels;
    for (const Index row : rows) {
      inputs.group_codes.push_back(
          source.groups().codes[static_cast<std::size_t>(row)]);
    }
  }
  if (const Index position = FindPosition(source, ""); position >= 0) {
    inputs.position_column =
        source.inputs()[static_cast<std::size_t>(position)].name;
    inputs.positions = source.input_values().col(position)(rows);
  }
  return inputs;
}

}  // namespace errmap::models
