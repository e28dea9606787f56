#include "models/net/net_effective_parameters.h"

#include <cmath>
#include <stdexcept>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "models/net/feedforward_net.h"
#include "models/net/net_objective.h"
#include "tests/decompositions.h"
#include "tests/random_matrix.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using errmap::testing::RandomMatrix;

NetTraining RowsOf(Index rows, const NetShape& shape, bool weighted = false) {
  NetTraining training;
  training.shape = shape;
  training.inputs = RandomMatrix(rows, shape.inputs, 1);
  training.targets = RandomMatrix(rows, shape.outputs, 2);
  if (weighted) {
    training.row_weights =
        RandomMatrix(rows, 1, 3).col(0).cwiseAbs().array() + 0.1;
  }
  return training;
}

MatrixXd JacobianOf(const NetTraining& training, const VectorXd& w) {
  const NetObjective objective(training.shape,
                               training.inputs,
                               training.targets,
                               training.wfactor,
                               training.row_weights);
  VectorXd residuals;
  MatrixXd jacobian;
  objective.residuals()->Evaluate(w, &residuals, &jacobian);
  return jacobian;
}

// Sum of s^2 / (s^2 + c) over the singular values s of the whole Jacobian.
double BySingularValues(const NetTraining& training, const VectorXd& w) {
  const double c = training.wfactor / static_cast<double>(w.size());
  double sum = 0.0;
  for (const double s : testing::SingularValues(JacobianOf(training, w))) {
    sum += s * s / (s * s + c);
  }
  return sum;
}

TEST(EffectiveParameters, AgreeWithTheSingularValuesOfTheJacobian) {
  constexpr double kRounding = 1e-8;  // squares double the digits lost
  struct Case {
    Index rows;
    NetShape shape;
    bool weighted;
  };
  for (const Case& c :
       {Case{12, {2, 9}, false},
        Case{12, {2, 9}, true},
        Case{90, {3, 6}, false},
        Case{90, {3, 6}, true},
        Case{40, {2, 4, 1, OutputFunction::kLinear}, false},
        Case{40, {2, 4, 2, OutputFunction::kSigmoid, 2.0}, true},
        // More rows than a block.
        Case{5000, {2, 3}, false},
        Case{5000, {2, 3}, true}}) {
    NetTraining training = RowsOf(c.rows, c.shape, c.weighted);
    const VectorXd w = 3.0 * InitialWeights(c.shape, 7);
    for (const double wfactor : {1e-4, 1e-2, 1.0}) {
      training.wfactor = wfactor;
      const double expected = BySingularValues(training, w);
      EXPECT_NEAR(EffectiveParameters(training, w),
                  expected,
                  kRounding * std::fmax(1.0, expected))
          << c.rows << " rows, wfactor " << wfactor;
    }
  }
}

TEST(EffectiveParameters, CountFreeBiasesWhole) {
  constexpr double kRounding = 1e-8;
  const NetShape shape{3, 6};
  for (const bool weighted : {false, true}) {
    NetTraining training = RowsOf(90, shape, weighted);
    training.wfactor = 0.5;
    const VectorXd w = 3.0 * InitialWeights(shape, 7);
    const MatrixXd jacobian = JacobianOf(training, w);
    VectorXd decay =
        VectorXd::Constant(w.size(), 0.5 / static_cast<double>(w.size()));
    decay.segment(18, 6).setZero();  // of the hidden nodes, after 3 x 6 weights
    decay[w.size() - 1] = 0.0;
    const MatrixXd gram = jacobian.transpose() * jacobian;
    const MatrixXd damped = gram + MatrixXd(decay.asDiagonal());
    const double expected = testing::SolveSymmetric(damped, gram).trace();
    training.shape.free_biases = true;
    EXPECT_NEAR(EffectiveParameters(training, w), expected, kRounding);
    training.wfactor = 1e12;  // the hidden nodes are at their constants
    EXPECT_NEAR(EffectiveParameters(training, w), 7.0, 1e-6);
  }
}

TEST(EffectiveParameters, AreTheRankWithoutDecayAndNoneWithMuch) {
  const NetShape shape{2, 3};
  const VectorXd w = 3.0 * InitialWeights(shape, 5);
  NetTraining training = RowsOf(60, shape);
  training.wfactor = 0.0;
  EXPECT_DOUBLE_EQ(EffectiveParameters(training, w), 13.0);  // its weights
  training.wfactor = 1e12;
  EXPECT_LT(EffectiveParameters(training, w), 1e-9);
  // Fewer rows than weights.
  NetTraining few = RowsOf(4, shape);
  few.wfactor = 0.0;
  EXPECT_DOUBLE_EQ(EffectiveParameters(few, w), 4.0);
  // Rows that repeat add nothing.
  few.inputs.row(3) = few.inputs.row(0);
  EXPECT_DOUBLE_EQ(EffectiveParameters(few, w), 3.0);
  // Nodes that see nothing of the inputs: the output's bias alone.
  EXPECT_DOUBLE_EQ(
      EffectiveParameters(few, VectorXd::Zero(shape.num_weights())), 1.0);
}

TEST(EffectiveParameters, FallAsTheDecayGrows) {
  const NetShape shape{3, 8};
  const VectorXd w = 2.0 * InitialWeights(shape, 11);
  NetTraining training = RowsOf(80, shape);
  double before = 1e9;
  for (const double wfactor : {0.0, 1e-7, 1e-5, 1e-3, 1e-1, 10.0}) {
    training.wfactor = wfactor;
    const double now = EffectiveParameters(training, w);
    EXPECT_LT(now, before) << wfactor;
    before = now;
  }
}

TEST(EffectiveParameters, AreNotANumberWhereThatWouldTakeTooLong) {
  const NetShape wide{1, 1500};
  EXPECT_TRUE(std::isnan(EffectiveParameters(
      RowsOf(3001, wide), VectorXd::Zero(wide.num_weights()))));
}

TEST(EffectiveParameters, RefuseWeightsOfAnotherNet) {
  EXPECT_THROW(EffectiveParameters(RowsOf(9, {2, 3}), VectorXd::Zero(12)),
               std::invalid_argument);
}

}  // namespace
}  // namespace errmap::models
