#include "fitting/minimisers/cost_resolution.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fitting/test_problems.h"

namespace errmap::fitting {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using errmap::testing::FunctionObjective;

const std::function<bool()> kAlways = [] { return true; };

// floor + 1/2 sum of curvatures x^2.
FunctionObjective Bowl(double floor, const VectorXd& curvatures) {
  return {curvatures.size(), [=](const VectorXd& x, VectorXd* gradient) {
            if (gradient != nullptr) *gradient = curvatures.cwiseProduct(x);
            return floor + 0.5 * curvatures.dot(x.cwiseAbs2());
          }};
}

TEST(CostResolution, FindsWhatNewtonsStepPromises) {
  const FunctionObjective f = Bowl(1e3, VectorXd{{1.0, 1e-2, 1e-4}});
  const VectorXd x{{1e-6, 1e-5, 1e-2}};
  const CostResolution found = FindCostResolution(f, x, kAlways);
  const double promised = 0.5 * (1e-12 + 1e-12 + 1e-8);
  EXPECT_EQ(found.cost, f.Evaluate(x, nullptr));
  // The residual is brought to a tenth, what remains to a hundredth or so of
  // the stiffest direction's part.
  EXPECT_NEAR(found.remaining, promised, 0.05 * promised);
  EXPECT_GE(found.rounding, 1e3 * 0x1p-53);
  EXPECT_TRUE(found.is_reached());
  EXPECT_THAT(found.Text(), ::testing::HasSubstr("the resolution of the cost"));
}

TEST(CostResolution, IsNotReachedWhereMoreIsPromised) {
  const FunctionObjective f = Bowl(1.0, VectorXd{{1.0, 1e-6}});
  EXPECT_TRUE(
      FindCostResolution(f, VectorXd{{0.0, 1e-2}}, kAlways).is_reached());
  EXPECT_FALSE(
      FindCostResolution(f, VectorXd{{0.0, 0.1}}, kAlways).is_reached());
  // Without a floor every distance shows.
  EXPECT_FALSE(FindCostResolution(Bowl(0.0, VectorXd{{1.0, 1.0}}),
                                  VectorXd{{1e-9, 1e-9}},
                                  kAlways)
                   .is_reached());
}

TEST(CostResolution, IsUnknownAtASaddleOnAPlainAndBesideACliff) {
  const VectorXd near = VectorXd::Constant(2, 1e-9);
  EXPECT_FALSE(
      FindCostResolution(Bowl(1.0, VectorXd{{1.0, -1.0}}), near, kAlways)
          .is_reached());
  const FunctionObjective plain(2, [](const VectorXd&, VectorXd* gradient) {
    if (gradient != nullptr) *gradient << 1e-12, 0.0;
    return 1.0;
  });
  EXPECT_FALSE(FindCostResolution(plain, near, kAlways).is_reached());
  const FunctionObjective cliff(
      2, [near](const VectorXd& x, VectorXd* gradient) {
        if (gradient != nullptr) *gradient = x;
        return x[0] > 1e-7 ? std::nan("") : 1.0 + 0.5 * x.squaredNorm();
      });
  EXPECT_FALSE(FindCostResolution(cliff, near, kAlways).is_reached());
}

// The gradient has no part in the way down.
TEST(CostResolution, IsUnknownAtASaddleThatTheGradientDoesNotSee) {
  const VectorXd x{{1e-7, 0.0, 1e-7}};
  EXPECT_FALSE(
      FindCostResolution(Bowl(1.0, VectorXd{{1.0, -1e-3, 0.5}}), x, kAlways)
          .is_reached());
  EXPECT_TRUE(
      FindCostResolution(Bowl(1.0, VectorXd{{1.0, 1e-3, 0.5}}), x, kAlways)
          .is_reached());
  // A direction that changes nothing is not a way down.
  EXPECT_TRUE(
      FindCostResolution(Bowl(1.0, VectorXd{{1.0, 0.0, 0.5}}), x, kAlways)
          .is_reached());
}

// What the first parameter promises, 0.005, is a thousandth of the gradient.
TEST(CostResolution, SeesThroughUnitsThatDifferByPowersOfTen) {
  const auto at = [](double first) {
    const FunctionObjective f(2, [](const VectorXd& x, VectorXd* gradient) {
      const double a = 1e-3 * (x[0] - 400.0);
      const double b = 1e6 * (x[1] - 1e-4);
      if (gradient != nullptr) *gradient << 1e-3 * a, 1e6 * b;
      return 1.0 + 0.5 * (a * a + b * b);
    });
    return FindCostResolution(f, VectorXd{{first, 1e-4 + 1e-13}}, kAlways)
        .is_reached();
  };
  EXPECT_FALSE(at(500.0));
  EXPECT_TRUE(at(400.0));
}

// A run that shortens its steps ends a few digits before a wall.
TEST(CostResolution, TakesNoWallForRounding) {
  const VectorXd edge{{0.3, 0.4}};
  for (const double wall : {std::nan(""), HUGE_VAL, 1e3, 0.2}) {
    const FunctionObjective f(2, [&](const VectorXd& x, VectorXd* gradient) {
      if (gradient != nullptr) *gradient = x;
      return x[0] < edge[0] ? wall : 0.5 * x.squaredNorm();
    });
    EXPECT_FALSE(FindCostResolution(f, edge, kAlways).is_reached()) << wall;
  }
  const FunctionObjective hole(2, [&](const VectorXd& x, VectorXd* gradient) {
    if (gradient != nullptr) *gradient = x;
    return x == edge ? 0.125 : HUGE_VAL;
  });
  EXPECT_FALSE(FindCostResolution(hole, edge, kAlways).is_reached());
}

TEST(CostResolution, IsUnknownWhereItMayNotLook) {
  const FunctionObjective f = Bowl(1.0, VectorXd{{1.0, 1e-3, 1e-6}});
  const VectorXd x = VectorXd::Constant(3, 1e-7);
  int needed = 0;
  EXPECT_TRUE(FindCostResolution(f, x, [&] {
                ++needed;
                return true;
              }).is_reached());
  for (int allowed = 0; allowed < needed; ++allowed) {
    int asked = 0;
    const CostResolution found =
        FindCostResolution(f, x, [&] { return ++asked <= allowed; });
    EXPECT_FALSE(found.is_reached()) << allowed;
    EXPECT_EQ(asked, allowed + 1);
  }
}

}  // namespace
}  // namespace errmap::fitting
