#include "models/net/feedforward_net.h"

#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/models/golden_netcg.h"

namespace errmap::models {
namespace {

double Sigmoid(double s) { return 1.0 / (1.0 + std::exp(-s)); }

NetForm SmallNet() {
  NetForm form;
  form.input_offset = Eigen::Vector2d(1.0, -2.0);
  form.input_scale = Eigen::Vector2d(0.5, 0.25);
  form.w1.resize(2, 3);
  form.w1 << 0.3, -0.2, 0.1, 0.7, 0.4, -0.6;
  form.w2.resize(1, 3);
  form.w2 << 1.5, -0.8, 0.2;
  form.target_slope = Eigen::VectorXd::Constant(1, 20.0);
  form.target_offset = Eigen::VectorXd::Constant(1, 0.4);
  return form;
}

TEST(FeedforwardNet, PropagatesAsEquations14To18Say) {
  const double x1 = (3.0 - 1.0) * 0.5;
  const double x2 = (5.0 + 2.0) * 0.25;
  const double y1 = Sigmoid(0.3 * x1 - 0.2 * x2 + 0.1);
  const double y2 = Sigmoid(0.7 * x1 + 0.4 * x2 - 0.6);
  const double s = 1.5 * y1 - 0.8 * y2 + 0.2;
  const Eigen::MatrixXd inputs = Eigen::RowVector2d(3.0, 5.0);
  EXPECT_NEAR(FeedforwardNet(SmallNet()).Predict(inputs)[0],
              (Sigmoid(s) - 0.4) / 20.0,
              1e-15);
  NetForm linear = SmallNet();
  linear.output = OutputFunction::kLinear;
  EXPECT_NEAR(
      FeedforwardNet(linear).Predict(inputs)[0], (s - 0.4) / 20.0, 1e-15);
}

TEST(FeedforwardNet, BecomesAMapOfTheRowsThatItLearntFrom) {
  data::Dataset::Parts parts;
  parts.source = "rows";
  parts.inputs = {{"position_mm", data::UnitOfSymbol("mm")},
                  {"t_degC", data::UnitOfSymbol("degC")}};
  parts.input_values.resize(3, 2);
  parts.input_values << 0.0, 20.0, 10.0, 25.0, 30.0, 21.0;
  parts.target = {"error_um", data::UnitOfSymbol("um")};
  parts.target_values = Eigen::Vector3d(1.0, 4.0, 2.0);
  const data::Dataset rows(parts);
  const NetShape shape{.inputs = 2, .hidden = 3, .slope = 2.0};
  const Eigen::VectorXd w = InitialWeights(shape, 7);
  const ColumnScaling inputs = UnitRangeScaling(rows.input_values());
  const TargetScaling target = SigmoidTargetScaling(rows.target_values());
  const FittedModel map = MapOfWeights(shape, w, inputs, target, rows);
  const NetObjective objective(
      shape,
      inputs.Apply(rows.input_values()),
      (target.slope * map.Predict(rows)).array() + target.offset,
      0.0);
  EXPECT_NEAR(objective.Evaluate(w, nullptr), 0.0, 1e-20);
  EXPECT_EQ(map.target.name, "error_um");
  EXPECT_EQ(map.inputs[1].max, 25.0);
  EXPECT_THROW(MapOfWeights(shape, w.head(4), inputs, target, rows),
               std::invalid_argument);
}

TEST(FeedforwardNet, AgreesWithTheReportsProgramOnItsFinalWeights) {
  const auto golden = errmap::testing::ReadGoldenCase("case_c");
  const Eigen::VectorXd w =
      errmap::testing::ToVector(golden.json["weights_final"]);
  const auto& rows = golden.json["pred_scaled"];
  for (Eigen::Index node = 0; node < golden.shape.outputs; ++node) {
    NetForm form;
    form.input_offset = Eigen::VectorXd::Zero(3);
    form.input_scale = Eigen::VectorXd::Ones(3);
    form.w1 = FirstLayer(golden.shape, w);
    form.w2 = SecondLayer(golden.shape, w).row(node);
    form.target_slope = Eigen::VectorXd::Ones(1);
    form.target_offset = Eigen::VectorXd::Zero(1);
    const Eigen::VectorXd z = FeedforwardNet(form).Predict(golden.inputs);
    for (Eigen::Index p = 0; p < z.size(); ++p) {
      const double expected =
          rows[static_cast<std::size_t>(p)][static_cast<std::size_t>(node)];
      EXPECT_NEAR(z[p], expected, 1e-13);
    }
  }
}

TEST(FeedforwardNet, PredictsARowTheSameWhateverStandsAroundIt) {
  const FeedforwardNet net(SmallNet());
  Eigen::MatrixXd inputs(7, 2);
  for (Eigen::Index i = 0; i < 7; ++i) {
    inputs.row(i) << 0.37 * static_cast<double>(i), 1.0 / (1.0 + double(i));
  }
  const Eigen::VectorXd together = net.Predict(inputs);
  for (Eigen::Index i = 0; i < 7; ++i) {
    EXPECT_EQ(net.Predict(inputs.row(i))[0], together[i]);
  }
}

TEST(FeedforwardNet, RefusesShapesAndNumbersThatMakeNoNet) {
  NetForm form = SmallNet();
  form.w2.resize(1, 2);
  EXPECT_THROW(FeedforwardNet{form}, std::invalid_argument);
  form = SmallNet();
  form.w1(0, 0) = std::nan("");
  EXPECT_THROW(FeedforwardNet{form}, std::invalid_argument);
  form = SmallNet();
  form.target_slope[0] = 0.0;
  EXPECT_THROW(FeedforwardNet{form}, std::invalid_argument);
  EXPECT_THROW(
      static_cast<void>(
          FeedforwardNet(SmallNet()).Predict(Eigen::MatrixXd::Zero(1, 3))),
      std::invalid_argument);
}

TEST(InitialWeights, LieWithinAHalfAndFollowTheSeed) {
  const NetShape shape{3, 50, 1, OutputFunction::kSigmoid};
  const Eigen::VectorXd w = InitialWeights(shape, 7);
  EXPECT_EQ(w.size(), 50 * 4 + 51);
  EXPECT_LE(w.maxCoeff(), 0.5);
  EXPECT_GE(w.minCoeff(), -0.5);
  EXPECT_NEAR(w.mean(), 0.0, 0.1);
  EXPECT_EQ(w, InitialWeights(shape, 7));
  EXPECT_NE(w, InitialWeights(shape, 8));
}

TEST(InitialWeights, AreDrawnNodeByNodeSoThatMoreNodesKeepTheFirst) {
  const NetShape small{3, 2, 1, OutputFunction::kSigmoid};
  const NetShape large{3, 5, 1, OutputFunction::kSigmoid};
  EXPECT_EQ(FirstLayer(small, InitialWeights(small, 7)),
            FirstLayer(large, InitialWeights(large, 7)).topRows(2));
}

}  // namespace
}  // namespace errmap::models
