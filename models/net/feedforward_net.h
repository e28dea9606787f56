#pragma once

#include <cstdint>
#include <string>

#include "models/error_model.h"
#include "models/net/net_objective.h"
#include "models/scaling.h"

namespace errmap::models {

/// One-hidden-layer sigmoid net (NISTIR 5367, Eq. 14-18) as an error map.
class FeedforwardNet final : public ErrorModel {
 public:
  /// Throws std::invalid_argument where shapes do not agree, a number is not
  /// finite, a target slope is 0, or there is not exactly one output.
  explicit FeedforwardNet(NetForm form);

  Eigen::Index num_inputs() const override { return form_.input_offset.size(); }
  Eigen::Index num_parameters() const override {
    return form_.w1.size() + form_.w2.size();
  }
  ModelDescription Describe() const override { return form_; }
  const NetForm& form() const { return form_; }

 private:
  double DoPredictRow(const double* inputs) const override;

  NetForm form_;
};

/// Initial weights (N) of a net: uniform in +-0.5, drawn node by node (to
/// outer, from inner, bias last) as the report's program does.
Eigen::VectorXd InitialWeights(const NetShape& shape, std::uint64_t seed);

/// The two weight matrices of a weight vector (N).
Eigen::MatrixXd FirstLayer(const NetShape& shape, const Eigen::VectorXd& w);
Eigen::MatrixXd SecondLayer(const NetShape& shape, const Eigen::VectorXd& w);

/// The net of the weights w (N) of a training on inputs and targets scaled so.
NetForm FormOfWeights(const NetShape& shape,
                      const Eigen::VectorXd& w,
                      const ColumnScaling& inputs,
                      const TargetScaling& target);

/// Such a net as a map of the rows that it was trained on, with their columns
/// and ranges: of a training of one's own, stopped when rows that it did not
/// see grew worse, say. Throws std::invalid_argument as FeedforwardNet does.
FittedModel MapOfWeights(const NetShape& shape,
                         const Eigen::VectorXd& w,
                         const ColumnScaling& inputs,
                         const TargetScaling& target,
                         const data::Dataset& training,
                         const std::string& name = "net");

}  // namespace errmap::models
