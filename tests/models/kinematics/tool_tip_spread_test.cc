#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/kinematics/volumetric.h"
#include "stats/distributions.h"
#include "stats/random.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::MatrixX3d;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

HeldOutToolTip SessionInToolTipSpread(MatrixX3d errors, double half_width) {
  MatrixX3d half_widths = MatrixX3d::Constant(errors.rows(), 3, half_width);
  return {std::move(errors), std::move(half_widths)};
}

HeldOutToolTip Same(double error, double half_width, Index points = 2) {
  return SessionInToolTipSpread(MatrixX3d::Constant(points, 3, error),
                                half_width);
}

// Mean squares of errors / half-widths by hand: (0.5 + 1.5) / 2 and 1.21. Their
// squares about the mean 1.105 sum to 0.02205; over 0.0641847547, the lower
// fifth of chi-squared with 1 degree of freedom (R: qchisq(0.2, 1)), that is a
// variance of 0.34354, and 2 * 1.105^2 over it 7.1085 degrees of freedom each.
TEST(ToolTipHalfWidths, AreTheSpreadOfSessionsTimesStudentsT) {
  const MatrixX3d first{{-std::sqrt(0.5), -std::sqrt(2.0), 0.0},
                        {std::sqrt(1.5), std::sqrt(6.0), 0.0}};
  const MatrixX3d second{{1.1, 2.2, 0.0}, {-1.1, 2.2, 0.0}};
  const MatrixX3d first_order{{1.0, 2.0, 1.0}, {3.0, 6.0, 1.0}};
  HeldOutToolTip one = SessionInToolTipSpread(first, 1.0);
  HeldOutToolTip two = SessionInToolTipSpread(second, 1.0);
  one.half_widths.col(1).setConstant(2.0);
  two.half_widths.col(1).setConstant(2.0);
  const MatrixX3d half_widths = ToolTipHalfWidths({one, two}, first_order, 0.9);
  const double factor =
      std::sqrt(1.105) * stats::StudentQuantile(0.95, 2.0 * 7.1084980);
  EXPECT_NEAR(half_widths(0, 0), factor, 1e-7);
  EXPECT_NEAR(half_widths(1, 0), 3.0 * factor, 1e-7);
  // Twice the errors with half-widths twice as wide.
  EXPECT_NEAR(half_widths(1, 1), 6.0 * factor, 1e-7);
  // Where no session erred nothing is to be expected.
  EXPECT_EQ(half_widths(0, 2), 0.0);
}

// One session ten times worse than the other: a single degree of freedom each.
TEST(ToolTipHalfWidths, CountASessionForOneAtLeast) {
  const MatrixX3d half_widths = ToolTipHalfWidths(
      {Same(0.0, 1.0), Same(10.0, 1.0)}, MatrixX3d::Ones(1, 3), 0.9);
  constexpr double kT2 = 2.9199855804;
  EXPECT_NEAR(half_widths(0, 0), kT2 * std::sqrt(50.0), 1e-8);
}

TEST(ToolTipHalfWidths, AreNormalWhereSessionsAreAlike) {
  const MatrixX3d half_widths = ToolTipHalfWidths(
      {Same(1.0, 0.5), Same(-1.0, 0.5)}, MatrixX3d::Ones(1, 3), 0.9);
  EXPECT_NEAR(half_widths(0, 0), 2.0 * 1.6448536270, 1e-6);
}

TEST(ToolTipHalfWidths, WeighSessionsAlikeHoweverManyPointsTheyHave) {
  const MatrixX3d one = MatrixX3d::Ones(1, 3);
  EXPECT_TRUE(ToolTipHalfWidths({Same(1.0, 1.0), Same(3.0, 1.0)}, one, 0.9)
                  .isApprox(ToolTipHalfWidths(
                      {Same(1.0, 1.0, 50), Same(3.0, 1.0)}, one, 0.9)));
}

// Constants have half-widths of 0, and a map may have none: the errors of the
// sessions are known all the same.
TEST(ToolTipHalfWidths, AreTheSameEverywhereWhereComponentsTellNone) {
  HeldOutToolTip session = Same(1.0, 1.0);
  session.half_widths.col(0).setZero();
  session.half_widths(1, 1) = std::numeric_limits<double>::quiet_NaN();
  const MatrixX3d first_order{{0.0, 1.0, 1.0}, {0.0, 2.0, 2.0}};
  const MatrixX3d half_widths =
      ToolTipHalfWidths({session, session}, first_order, 0.9);
  EXPECT_NEAR(half_widths(0, 0), 1.6448536270, 1e-6);
  EXPECT_EQ(half_widths(1, 0), half_widths(0, 0));
  EXPECT_EQ(half_widths(1, 1), half_widths(0, 0));
  EXPECT_NEAR(half_widths(1, 2), 2.0 * half_widths(0, 2), 1e-12);
}

// Sessions of four independent values each: of a further one at least nine
// tenths lie within, and not many more.
TEST(ToolTipHalfWidths, CoverAFurtherSession) {
  stats::Random random(7);
  const auto draw = [&] {
    constexpr double kHalfStep = 0x1.0p-54;  // never 0, as Uniform may be
    return stats::NormalQuantile(random.Uniform() + kHalfStep);
  };
  for (const int sessions : {2, 4, 6}) {
    constexpr int kTrials = 2000;
    int within = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
      std::vector<HeldOutToolTip> seen;
      for (int i = 0; i < sessions; ++i) {
        MatrixX3d errors(4, 3);
        for (double& error : errors.reshaped()) error = draw();
        seen.push_back(SessionInToolTipSpread(errors, 0.5));
      }
      const double half_width =
          ToolTipHalfWidths(seen, MatrixX3d::Constant(1, 3, 0.5), 0.9)(0, 0);
      within += std::abs(draw()) <= half_width ? 1 : 0;
    }
    EXPECT_GT(within, 0.89 * kTrials) << sessions;
    EXPECT_LT(within, 0.96 * kTrials) << sessions;
  }
}

TEST(ToolTipHalfWidths, RefuseWhatTheyCannotJudge) {
  const auto expect = [](const std::vector<HeldOutToolTip>& sessions,
                         double coverage,
                         const char* says) {
    EXPECT_THAT(
        [&] { ToolTipHalfWidths(sessions, MatrixX3d::Ones(1, 3), coverage); },
        ThrowsMessage<std::invalid_argument>(HasSubstr(says)));
  };
  const HeldOutToolTip good = Same(0.0, 1.0);
  expect({good}, 0.9, "needs two sessions");
  expect({good, good}, 1.0, "a coverage between 0 and 1");
  expect({good, SessionInToolTipSpread(MatrixX3d(0, 3), 1.0)},
         0.9,
         "or there are none");
  expect({good, {MatrixX3d::Zero(2, 3), MatrixX3d::Ones(1, 3)}},
         0.9,
         "differ in number");
}

}  // namespace
}  // namespace errmap::models
