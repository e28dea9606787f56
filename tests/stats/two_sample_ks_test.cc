#include "stats/two_sample_ks.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stats/random.h"
#include "tests/models/serial_reference.h"

namespace errmap::stats {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double kTwoSampleKsRounding = 1e-12;

TEST(TwoSampleKs, ReproducesRWithAndWithoutTies) {
  const VectorXd a{{0.61, 0.29, 0.06, 0.59, -1.73}};
  const VectorXd b{{-0.74, 0.51, -0.56, 0.39, 1.64, 0.05, -0.06, 0.64, -0.82}};
  const auto& plain = SerialReference("plain");
  EXPECT_NEAR(ComputeTwoSampleKs(a, b).d, plain.at("d"), kTwoSampleKsRounding);
  EXPECT_NEAR(
      ComputeTwoSampleKs(a, b).p_exact, plain.at("p"), kTwoSampleKsRounding);
  const VectorXd c{{1, 2, 2, 3, 3}};
  const VectorXd d{{1, 2, 3, 4, 4, 5, 5}};
  const auto& tied = SerialReference("tied");
  EXPECT_NEAR(ComputeTwoSampleKs(c, d).d, tied.at("d"), kTwoSampleKsRounding);
  EXPECT_NEAR(
      ComputeTwoSampleKs(c, d).p_exact, tied.at("p"), kTwoSampleKsRounding);
}

TEST(TwoSampleKs, CountsTheWaysByHand) {
  // Apart: 2 of C(4, 2) = 6 ways of dealing out four values reach D = 1.
  const TwoSampleKs apart =
      ComputeTwoSampleKs(VectorXd{{1, 2}}, VectorXd{{3, 4}});
  EXPECT_DOUBLE_EQ(apart.d, 1.0);
  EXPECT_DOUBLE_EQ(apart.p_exact, 2.0 / 6.0);
  const TwoSampleKs same =
      ComputeTwoSampleKs(VectorXd{{1, 2}}, VectorXd{{1, 2}});
  EXPECT_EQ(same.d, 0.0);
  EXPECT_DOUBLE_EQ(same.p_exact, 1.0);
  EXPECT_DOUBLE_EQ(same.p_asymptotic, 1.0);
}

TEST(TwoSampleKs, TakesTheSamplesInEitherOrder) {
  Random random(4);
  const VectorXd a = NormalSample(31, &random);
  const VectorXd b = 1.5 * NormalSample(57, &random);
  const TwoSampleKs one = ComputeTwoSampleKs(a, b);
  const TwoSampleKs two = ComputeTwoSampleKs(b, a.reverse());
  EXPECT_DOUBLE_EQ(one.d, two.d);
  EXPECT_NEAR(one.p_exact, two.p_exact, kTwoSampleKsRounding);
}

TEST(TwoSampleKs, TheTwoPApproachEachOther) {
  double last = 1.0;
  for (const Index n : {30, 300, 3000}) {
    const VectorXd a = VectorXd::LinSpaced(n, 0.0, 1.0);
    // D is near sqrt(2 / n), so that p is near 0.27 for all.
    const VectorXd b = a.array() + std::sqrt(2.0 / static_cast<double>(n));
    const TwoSampleKs found = ComputeTwoSampleKs(a, b);
    const double gap = std::abs(found.p_asymptotic - found.p_exact);
    EXPECT_LT(gap, 0.2 * last) << n;
    last = gap;
  }
}

TEST(TwoSampleKs, KeepsTheDigitsOfASmallP) {
  constexpr Index kSize = 60;
  const VectorXd a = VectorXd::LinSpaced(kSize, 0.0, 1.0);
  const VectorXd b = a.array() + 2.0;
  // 2 / C(120, 60).
  const double p = 2.0 / std::exp(std::lgamma(121.0) - 2.0 * std::lgamma(61.0));
  EXPECT_NEAR(ComputeTwoSampleKs(a, b).p_exact, p, 1e-10 * p);
}

TEST(TwoSampleKs, LeavesTheExactPOutWhereItWouldTakeLong) {
  const VectorXd large = VectorXd::LinSpaced(5000, 0.0, 1.0);
  const TwoSampleKs found = ComputeTwoSampleKs(large, large.array() + 0.001);
  EXPECT_TRUE(std::isnan(found.p_exact));
  EXPECT_GT(found.p_asymptotic, 0.99);
}

TEST(TwoSampleKs, RefusesWhatIsNoSample) {
  const VectorXd a{{1, 2}};
  const VectorXd b{{1, std::numeric_limits<double>::infinity()}};
  EXPECT_THAT([&] { ComputeTwoSampleKs(a, VectorXd()); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("no values")));
  EXPECT_THAT([&] { ComputeTwoSampleKs(a, b); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("not finite")));
}

}  // namespace
}  // namespace errmap::stats
