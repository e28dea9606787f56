#include "models/net_objective.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fitting/gradient_check.h"
#include "stats/random.h"
#include "tests/golden_netcg.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using errmap::testing::GoldenCase;
using errmap::testing::ReadGoldenCase;

MatrixXd RandomMatrix(Index rows, Index cols, std::uint64_t seed) {
  stats::Random random(seed);
  MatrixXd matrix(rows, cols);
  for (double& value : matrix.reshaped()) value = 2.0 * random.Uniform() - 1.0;
  return matrix;
}

TEST(NetObjective, AgreesWithTheReportsProgramInValueAndGradient) {
  constexpr double kRounding = 1e-12;
  for (const std::string name : {"case_c", "case_d1", "case_d2"}) {
    const GoldenCase golden = ReadGoldenCase(name);
    VectorXd gradient;
    const double cost =
        golden.Objective().Evaluate(golden.initial_weights, &gradient);
    const double expected_cost = golden.json["error_init"];
    EXPECT_NEAR(cost, expected_cost, kRounding * expected_cost) << name;
    const VectorXd expected =
        -errmap::testing::ToVector(golden.json["neggrad_init"]);
    EXPECT_LT((gradient - expected).cwiseAbs().maxCoeff(), kRounding) << name;
  }
}

TEST(NetObjective, AgreesWithTheReportsProgramOnItsFullSize) {
  constexpr double kRounding = 1e-12;
  constexpr Index kKept = 40;
  for (const std::string name : {"case_a", "case_b"}) {
    const GoldenCase golden = ReadGoldenCase(name);
    VectorXd gradient;
    const double cost =
        golden.Objective().Evaluate(golden.initial_weights, &gradient);
    const double expected_cost = golden.json["error_init"];
    EXPECT_NEAR(cost, expected_cost, kRounding) << name;
    EXPECT_NEAR(gradient.norm(),
                golden.json["neggrad_init_norm"].get<double>(),
                kRounding)
        << name;
    const VectorXd first =
        -errmap::testing::ToVector(golden.json["neggrad_init_first"]);
    const VectorXd last =
        -errmap::testing::ToVector(golden.json["neggrad_init_last"]);
    EXPECT_LT((gradient.head(kKept) - first).cwiseAbs().maxCoeff(), kRounding);
    EXPECT_LT((gradient.tail(kKept) - last).cwiseAbs().maxCoeff(), kRounding);
  }
}

struct ShapeCase {
  Index inputs, hidden, outputs, patterns;
  OutputFunction output;
  bool weighted;
};

class NetObjectiveGradient : public ::testing::TestWithParam<ShapeCase> {};

TEST_P(NetObjectiveGradient, AgreesWithRiddersDerivatives) {
  // Extrapolated differences of a smooth cost of order 0.1 are good to about
  // eleven digits.
  constexpr double kRidders = 1e-9;
  const ShapeCase& c = GetParam();
  VectorXd weights;
  if (c.weighted) {
    weights = RandomMatrix(c.patterns, 1, 5).cwiseAbs().array() + 0.1;
  }
  const NetObjective objective(
      {c.inputs, c.hidden, c.outputs, c.output},
      RandomMatrix(c.patterns, c.inputs, 1),
      RandomMatrix(c.patterns, c.outputs, 2).cwiseAbs(),
      1e-2,
      weights);
  const VectorXd w = RandomMatrix(objective.num_parameters(), 1, 3);
  EXPECT_LT(fitting::CheckGradient(objective, w).worst_relative_error,
            kRidders);
}

INSTANTIATE_TEST_SUITE_P(
    Shapes,
    NetObjectiveGradient,
    ::testing::Values(ShapeCase{1, 1, 1, 1, OutputFunction::kSigmoid, false},
                      ShapeCase{3, 4, 2, 12, OutputFunction::kSigmoid, false},
                      ShapeCase{3, 4, 2, 12, OutputFunction::kLinear, false},
                      ShapeCase{5, 7, 3, 40, OutputFunction::kSigmoid, true},
                      ShapeCase{2, 3, 1, 700, OutputFunction::kLinear, true}));

TEST(NetObjective, GradientCheckFindsAGradientWrongByOneInAThousand) {
  class Wrong final : public fitting::Objective {
   public:
    explicit Wrong(const NetObjective& right) : right_(right) {}
    Index num_parameters() const override { return right_.num_parameters(); }
    double Evaluate(const VectorXd& x, VectorXd* gradient) const override {
      const double value = right_.Evaluate(x, gradient);
      if (gradient != nullptr) (*gradient)[2] *= 1.001;
      return value;
    }

   private:
    const NetObjective& right_;
  };
  const NetObjective right({2, 3, 1, OutputFunction::kSigmoid},
                           RandomMatrix(20, 2, 1),
                           RandomMatrix(20, 1, 2),
                           0.0);
  const VectorXd w = RandomMatrix(right.num_parameters(), 1, 3);
  const auto check = fitting::CheckGradient(Wrong(right), w);
  EXPECT_GT(check.worst_relative_error, 5e-4);
  EXPECT_EQ(check.worst_parameter, 2);
}

TEST(NetObjective, IsTheSameInSinglePrecisionToItsDigits) {
  const NetShape shape{3, 5, 1, OutputFunction::kSigmoid};
  const MatrixXd inputs = RandomMatrix(300, 3, 1);
  const MatrixXd targets = RandomMatrix(300, 1, 2);
  const VectorXd w = RandomMatrix(shape.num_weights(), 1, 3);
  VectorXd gradient;
  const double cost =
      NetObjective(shape, inputs, targets, 1e-3).Evaluate(w, &gradient);
  Eigen::VectorXf single_gradient;
  const float single_cost =
      BasicNetObjective<float>(shape, inputs, targets, 1e-3)
          .Evaluate(w.cast<float>(), &single_gradient);
  EXPECT_NEAR(static_cast<double>(single_cost), cost, 1e-5 * cost);
  EXPECT_LT((single_gradient.cast<double>() - gradient).norm(),
            1e-4 * gradient.norm());
}

TEST(NetObjective, StaysFiniteWhereEverySigmoidIsSaturated) {
  const NetShape shape{2, 3, 1, OutputFunction::kSigmoid};
  const NetObjective objective(
      shape, RandomMatrix(10, 2, 1), RandomMatrix(10, 1, 2), 1e-3);
  for (const double size : {1e3, -1e3, 1e150, -1e150}) {
    VectorXd gradient;
    const VectorXd w = VectorXd::Constant(shape.num_weights(), size);
    const double cost = objective.Evaluate(w, &gradient);
    EXPECT_TRUE(std::isfinite(cost)) << size;
    EXPECT_TRUE(gradient.allFinite()) << size;
  }
}

TEST(NetObjective, CountsARowOfWeightTwoAsTwoRows) {
  const NetShape shape{2, 3, 1, OutputFunction::kSigmoid};
  const MatrixXd inputs = RandomMatrix(4, 2, 1);
  const MatrixXd targets = RandomMatrix(4, 1, 2);
  MatrixXd twice_inputs(5, 2);
  MatrixXd twice_targets(5, 1);
  twice_inputs << inputs, inputs.row(3);
  twice_targets << targets, targets.row(3);
  const VectorXd w = RandomMatrix(shape.num_weights(), 1, 3);
  const VectorXd weights = Eigen::Vector4d(1.0, 1.0, 1.0, 2.0);
  // One residual is counted twice, but P stays 4 against 5.
  const double weighted =
      NetObjective(shape, inputs, targets, 0.0, weights).Evaluate(w, nullptr);
  const double repeated = NetObjective(shape, twice_inputs, twice_targets, 0.0)
                              .Evaluate(w, nullptr);
  EXPECT_NEAR(weighted, repeated, 1e-14);
}

TEST(NetObjective, RefusesWhatDoesNotFitTogether) {
  const NetShape shape{2, 3, 1, OutputFunction::kSigmoid};
  const MatrixXd inputs = RandomMatrix(4, 2, 1);
  const MatrixXd targets = RandomMatrix(4, 1, 2);
  EXPECT_THROW(NetObjective(shape, inputs.leftCols(1), targets, 0.0),
               std::invalid_argument);
  EXPECT_THROW(NetObjective(shape, inputs, targets.topRows(3), 0.0),
               std::invalid_argument);
  EXPECT_THROW(NetObjective(shape, inputs, targets, -1.0),
               std::invalid_argument);
  MatrixXd bad = inputs;
  bad(1, 1) = std::nan("");
  EXPECT_THROW(NetObjective(shape, bad, targets, 0.0), std::invalid_argument);
  EXPECT_THROW(
      NetObjective({2, 0, 1, OutputFunction::kSigmoid}, inputs, targets, 0.0),
      std::invalid_argument);
}

}  // namespace
}  // namespace errmap::models
