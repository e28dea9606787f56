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
  /// Throws std::invalid_argument if shapes do not agree, a number is not
  /// finite, a target slope is 0, or the number of outputs is not one.
  explicit FeedforwardNet(NetForm form);

  Index num_inputs() const override { return form_.input_offset.size(); }
  Index num_parameters() const override {
    return form_.w1.size() + form_.w2.size();
  }
  ModelDescription Describe() const override { return form_; }
  const NetForm& form() const { return form_; }

 private:
  double DoPredictRow(const double* inputs) const override;

  NetForm form_;
};

/// Returns initial weights (N) of a net: uniform in +-0.5, drawn node by node
/// (to outer, from inner, bias last) as in the report's program.
VectorXd InitialWeights(const NetShape& shape, std::uint64_t seed);

/// Returns the two weight matrices of a weight vector (N).
MatrixXd FirstLayer(const NetShape& shape, const VectorXd& w);
MatrixXd SecondLayer(const NetShape& shape, const VectorXd& w);

/// Returns the net with weights w (N), trained on inputs and targets with that
/// scaling.
NetForm FormOfWeights(const NetShape& shape,
                      const VectorXd& w,
                      const ColumnScaling& inputs,
                      const TargetScaling& target);

/// Returns such a net as a map with the columns and ranges of its training
/// rows. For your own training loops, such as with early stopping. Throws
/// std::invalid_argument as FeedforwardNet does.
FittedModel MapOfWeights(const NetShape& shape,
                         const VectorXd& w,
                         const ColumnScaling& inputs,
                         const TargetScaling& target,
                         const data::Dataset& training,
                         const std::string& name = "net");

}  // namespace errmap::models
