#pragma once

#include <memory>
#include <string>
#include <vector>

#include "models/error_model.h"
#include "stats/eigen.h"

namespace errmap::models {

/// One of the maps that are averaged.
struct AveragedMember {
  std::string name;
  double weight = 0.0;        // above 0
  std::vector<Index> inputs;  // indices of average inputs it reads
  /// Its predictions are clipped to these bounds (target's unit), so that one
  /// wrong map cannot spoil the average.
  double lowest = 0.0;
  double highest = 0.0;
  std::shared_ptr<const ErrorModel> model;
};

/// The weighted mean of maps of the same inputs.
class AveragedModel final : public ErrorModel {
 public:
  /// Throws std::invalid_argument if there are no members, if a weight is not
  /// finite and above 0, or if inputs do not match a member. Scales the weights
  /// to sum 1.
  AveragedModel(Index num_inputs,
                std::string rule,
                std::vector<AveragedMember> members);

  Index num_inputs() const override { return num_inputs_; }
  Index num_parameters() const override;
  /// Returns a BlendForm.
  ModelDescription Describe() const override;

 private:
  double DoPredictRow(const double* inputs) const override;

  Index num_inputs_;
  std::string rule_;
  std::vector<AveragedMember> members_;
};

}  // namespace errmap::models
