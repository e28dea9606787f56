#include "models/study/record/making/held_out_residuals.h"

#include <map>

namespace errmap::models {

ResidualInputs HeldOutResiduals(const ComponentStudy& comparison,
                                std::size_t model,
                                std::size_t holdout_index) {
  const HoldoutResult& result =
      comparison.study.models[model].holdouts[holdout_index];
  const Holdout& holdout = comparison.holdouts[holdout_index];
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
    const auto& input = source.inputs()[static_cast<std::size_t>(i)];
    if (!data::IsPosition(input)) continue;
    position = i;
    inputs.position_column = input.name;
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

}  // namespace errmap::models
