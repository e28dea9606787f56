#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <Eigen/Core>

#include "models/scaling.h"

namespace errmap::netcg {

/// Weights of a net as subroutines SETWTS and PUTWTS of NISTIR 5367, Appendix
/// A, read and write them.
struct NetcgWeights {
  Eigen::Index inputs = 0;
  Eigen::Index hidden = 0;
  Eigen::Index outputs = 0;
  Eigen::VectorXd w;  // (N) in NetcgObjective's order
  /// How the training run scaled its targets; the program's own files do not
  /// say.
  std::optional<models::TargetScaling> scaling;
};

enum class WeightDigits {
  kReport,  // 5E14.6: six digits
  kFull,    // all digits, and the scaling on a last line that SETWTS ignores
};

/// Throws InputError naming `name`, line, what was expected and found.
NetcgWeights ParseWeights(std::string_view text, const std::string& name);

/// Nodes, then the weights into each node from a new line on.
std::string WeightsText(const NetcgWeights& weights, WeightDigits digits);

/// The graphics file of the weights into the hidden nodes: a row per input, a
/// column per hidden node.
std::string FirstLayerGraph(const NetcgWeights& weights);
/// That of the weights into the first output.
std::string SecondLayerGraph(const NetcgWeights& weights);

}  // namespace errmap::netcg
