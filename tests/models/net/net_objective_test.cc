#include "models/net/net_objective.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fitting/minimisers/gradient_check.h"
#include "tests/models/golden_netcg.h"
#include "tests/models/net/net_test_cases.h"
#include "tests/random_matrix.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using errmap::testing::GoldenCase;
using errmap::testing::NetCase;
using errmap::testing::RandomMatrix;
using errmap::testing::ReadGoldenCase;

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

class NetObjectiveGradient : public ::testing::TestWithParam<NetCase> {};

TEST_P(NetObjectiveGradient, AgreesWithRiddersDerivatives) {
  // Extrapolated differences of a smooth cost of order 0.1 are good to about
  // eleven digits.
  constexpr double kRidders = 1e-9;
  // The steeper the sigmoids, the sooner the cost changes.
  const double step = 0.15 / GetParam().shape.slope;
  EXPECT_LT(fitting::CheckGradient(
                GetParam().Objective<double>(), GetParam().Point(), step)
                .worst_relative_error,
            kRidders);
}

TEST_P(NetObjectiveGradient, AgreesWithRiddersDerivativesInSinglePrecision) {
  // Derivatives of the same cost in double, which know more than seven digits;
  // a component is judged by the largest.
  constexpr double kRidders = 1e-3;
  const auto objective = GetParam().Objective<double>();
  const VectorXd w = GetParam().Point();
  VectorXd numeric(w.size());
  for (Index i = 0; i < w.size(); ++i) {
    numeric[i] = fitting::RiddersDerivative(
                     [&](double t) {
                       VectorXd at = w;
                       at[i] = t;
                       return objective.Evaluate(at, nullptr);
                     },
                     w[i],
                     0.1)
                     .value;
  }
  Eigen::VectorXf gradient;
  GetParam().Objective<float>().Evaluate(w.cast<float>(), &gradient);
  EXPECT_LT((gradient.cast<double>() - numeric).cwiseAbs().maxCoeff(),
            kRidders * numeric.cwiseAbs().maxCoeff());
}

TEST_P(NetObjectiveGradient, IsTheSameCostWithAndWithoutGradient) {
  const auto objective = GetParam().Objective<double>();
  const VectorXd w = GetParam().Point();
  VectorXd gradient;
  const double with = objective.Evaluate(w, &gradient);
  EXPECT_EQ(objective.Evaluate(w, nullptr), with);
  VectorXd again;
  EXPECT_EQ(objective.Evaluate(w, &again), with);
  EXPECT_EQ(again, gradient);
}

INSTANTIATE_TEST_SUITE_P(Shapes,
                         NetObjectiveGradient,
                         ::testing::ValuesIn(errmap::testing::WithFreeBiases(
                             errmap::testing::ManyNets())),
                         [](const ::testing::TestParamInfo<NetCase>& instance) {
                           return instance.param.Name();
                         });

// Eq. 14-20 written out for one pattern, with slope c in both layers (Eq. 12)
// or, for a linear output, in the first alone.
TEST(NetObjective, IsTheFormulaOfTheReport) {
  constexpr double kRounding = 1e-15;
  constexpr double kSlope = 1.7;
  constexpr double kWfactor = 0.4;
  const auto sigmoid = [](double s) { return 1.0 / (1.0 + std::exp(-s)); };
  const VectorXd w{{0.3, -0.5, 0.7, 0.2, -0.1, 0.9, 1.1}};
  // One hidden node: w1 = (0.3 -0.5 0.7), w2 = (0.2 0.9; -0.1 1.1).
  const double x1 = 0.6;
  const double x2 = -0.8;
  const double target = 0.25;
  for (const auto output :
       {OutputFunction::kSigmoid, OutputFunction::kLinear}) {
    const NetShape shape{2, 1, 2, output, kSlope};
    ASSERT_EQ(shape.num_weights(), w.size());
    const double y = sigmoid(kSlope * (0.3 * x1 - 0.5 * x2 + 0.7));
    double z1 = 0.2 * y + 0.9;
    double z2 = -0.1 * y + 1.1;
    if (output == OutputFunction::kSigmoid) {
      z1 = sigmoid(kSlope * z1);
      z2 = sigmoid(kSlope * z2);
    }
    const double squares =
        (z1 - target) * (z1 - target) + (z2 + target) * (z2 + target);
    const double expected =
        squares / (2.0 * 1.0 * 2.0) + kWfactor * w.squaredNorm() / (2.0 * 7.0);
    for (const auto arithmetic :
         {NetArithmetic::kFast, NetArithmetic::kPlain}) {
      const NetObjective objective(shape,
                                   Eigen::RowVector2d(x1, x2),
                                   Eigen::RowVector2d(target, -target),
                                   kWfactor,
                                   {},
                                   arithmetic);
      EXPECT_NEAR(objective.Evaluate(w, nullptr), expected, kRounding);
    }
  }
}

// Rows are worked on in blocks: how they fall must not show but in rounding.
TEST(NetObjective, IsTheMeanOfItsHalves) {
  constexpr double kRounding = 1e-14;
  const NetShape shape{3, 6, 2, OutputFunction::kSigmoid};
  const Index rows = 9000;
  const MatrixXd inputs = RandomMatrix(rows, 3, 1);
  const MatrixXd targets = RandomMatrix(rows, 2, 2);
  const VectorXd w = RandomMatrix(shape.num_weights(), 1, 3);
  VectorXd whole;
  VectorXd first;
  VectorXd second;
  const double cost =
      NetObjective(shape, inputs, targets, 1e-2).Evaluate(w, &whole);
  const double halves =
      NetObjective(
          shape, inputs.topRows(rows / 2), targets.topRows(rows / 2), 1e-2)
          .Evaluate(w, &first) +
      NetObjective(shape,
                   inputs.bottomRows(rows / 2),
                   targets.bottomRows(rows / 2),
                   1e-2)
          .Evaluate(w, &second);
  EXPECT_NEAR(cost, 0.5 * halves, kRounding);
  EXPECT_LT((whole - 0.5 * (first + second)).cwiseAbs().maxCoeff(), kRounding);
}

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
  for (const double slope : {0.0, -1.0, std::nan("")}) {
    EXPECT_THROW(
        NetObjective(
            {2, 3, 1, OutputFunction::kSigmoid, slope}, inputs, targets, 0.0),
        std::invalid_argument);
  }
}

}  // namespace
}  // namespace errmap::models
