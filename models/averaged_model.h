#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "models/error_model.h"

namespace errmap::models {

/// A map among those that are averaged.
struct AveragedMember {
  std::string name;
  double weight = 0.0;               // above 0
  std::vector<Eigen::Index> inputs;  // those of the average that it reads
  /// Its predictions are kept within these bounds (target's unit), so that one
  /// that goes astray alone cannot carry the others with it.
  double lowest = 0.0;
  double highest = 0.0;
  std::shared_ptr<const ErrorModel> model;
};

/// The weighted mean of maps of the same inputs.
class AveragedModel final : public ErrorModel {
 public:
  /// Throws std::invalid_argument without members, on weights that are not
  /// above 0 and finite, or inputs that do not go with a member. Weights are
  /// brought to a sum of 1.
  AveragedModel(Eigen::Index num_inputs,
                std::string rule,
                std::vector<AveragedMember> members);

  Eigen::Index num_inputs() const override { return num_inputs_; }
  Eigen::Index num_parameters() const override;
  /// A BlendForm.
  ModelDescription Describe() const override;

 private:
  double DoPredictRow(const double* inputs) const override;

  Eigen::Index num_inputs_;
  std::string rule_;
  std::vector<AveragedMember> members_;
};

}  // namespace errmap::models
