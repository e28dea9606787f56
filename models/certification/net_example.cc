#include "models/certification/net_example.h"

#include <cmath>

namespace errmap::models {

const std::vector<NetExampleShape>& NetExampleShapes() {
  static const std::vector<NetExampleShape> kShapes{
      {.name = "net 1-1-1",
       .shape = {.inputs = 1, .hidden = 1},
       .patterns = 11,
       .wfactor = 1e-3},
      {.name = "net 3-5-1",
       .shape = {.inputs = 3, .hidden = 5},
       .patterns = 60,
       .wfactor = 1e-4},
      {.name = "net 3-5-1, linear output",
       .shape = {.inputs = 3, .hidden = 5, .output = OutputFunction::kLinear},
       .patterns = 60,
       .wfactor = 1e-4},
      {.name = "net 2-4-3, slope 2",
       .shape = {.inputs = 2, .hidden = 4, .outputs = 3, .slope = 2.0},
       .patterns = 40,
       .wfactor = 1e-3},
      {.name = "net 8-20-1",
       .shape = {.inputs = 8, .hidden = 20},
       .patterns = 50,
       .wfactor = 1e-3}};
  return kShapes;
}

NetExampleShape DampedNetExample() {
  return {.name = "net 3-6-1, wfactor 0.05",
          .shape = {.inputs = 3, .hidden = 6},
          .patterns = 120,
          .wfactor = 0.05};
}

MatrixXd ExampleInputs(const NetExampleShape& example) {
  MatrixXd inputs(example.patterns, example.shape.inputs);
  for (Index j = 0; j < inputs.cols(); ++j) {
    // Fractional parts of multiples of an irrational number per column.
    const double step = std::sqrt(static_cast<double>(2 + 3 * j * (j + 1)) +
                                  1.0 / static_cast<double>(3 + j));
    for (Index i = 0; i < inputs.rows(); ++i) {
      const double turns = step * static_cast<double>(i + 1);
      inputs(i, j) = 2.0 * (turns - std::floor(turns)) - 1.0;
    }
  }
  return inputs;
}

MatrixXd ExampleTargets(const NetExampleShape& example) {
  constexpr double kMiddle = 0.5;
  constexpr double kHalfRange = 0.3;
  const MatrixXd inputs = ExampleInputs(example);
  MatrixXd targets(inputs.rows(), example.shape.outputs);
  for (Index i = 0; i < targets.rows(); ++i) {
    for (Index j = 0; j < targets.cols(); ++j) {
      const double sum =
          inputs.row(i).sum() + static_cast<double>(j) * inputs(i, 0);
      targets(i, j) = kMiddle + kHalfRange * std::sin(1.5 * sum);
    }
  }
  return targets;
}

NetObjective MakeNetExample(const NetExampleShape& example) {
  return {example.shape,
          ExampleInputs(example),
          ExampleTargets(example),
          example.wfactor};
}

}  // namespace errmap::models
