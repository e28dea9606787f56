#include "stats/comparison/sign_flip.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stats/random.h"

namespace errmap::stats {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr Index kDraws = 9999;
constexpr std::uint64_t kSeed = 1;

SignFlipTest TestOne(const VectorXd& d) {
  return TestBySignFlips(d, kDraws, kSeed).front();
}

// All 2^n patterns one by one, equal sums within the last digits.
double PByEnumeration(const VectorXd& d) {
  const double observed = std::abs(d.sum());
  const std::uint64_t patterns = std::uint64_t{1} << d.size();
  std::uint64_t extreme = 0;
  for (std::uint64_t pattern = 0; pattern < patterns; ++pattern) {
    double sum = 0.0;
    for (Index i = 0; i < d.size(); ++i) {
      sum += ((pattern >> i) & 1U) != 0 ? d[i] : -d[i];
    }
    if (std::abs(sum) >= observed * (1.0 - 1e-12) - 1e-12) ++extreme;
  }
  return static_cast<double>(extreme) / static_cast<double>(patterns);
}

TEST(TestBySignFlips, CountsEveryPatternOfFewDifferences) {
  Random random(11);
  for (Index n = 1; n <= 14; ++n) {
    VectorXd d = NormalSample(n, &random).array() + 0.4;
    const SignFlipTest found = TestOne(d);
    EXPECT_TRUE(found.exact);
    EXPECT_DOUBLE_EQ(found.test.p, PByEnumeration(d)) << n;
    EXPECT_DOUBLE_EQ(found.test.statistic, d.mean());
    EXPECT_DOUBLE_EQ(found.smallest_p,
                     std::pow(2.0, 1.0 - static_cast<double>(n)));
    // Whole and tenth numbers: many sums are equal, some but for rounding.
    for (double& value : d) value = std::round(4.0 * value) / 10.0;
    EXPECT_DOUBLE_EQ(TestOne(d).test.p, PByEnumeration(d)) << n;
  }
}

// By hand: of all patterns of 0.1 ... 0.6, the sums of at least the
// observed 1.7 are 2.1 (no minus), 1.9 (at 0.1) and 1.7 (at 0.2): 3 of 64 on
// each side.
TEST(TestBySignFlips, CountsEqualSumsAsExtreme) {
  EXPECT_DOUBLE_EQ(TestOne(VectorXd{{0.1, -0.2, 0.3, 0.4, 0.5, 0.6}}).test.p,
                   6.0 / 64.0);
  EXPECT_DOUBLE_EQ(TestOne(VectorXd{{0.1, 0.2, 0.3, 0.4, 0.5, 0.6}}).test.p,
                   2.0 / 64.0);
  // Five equal ones and one against: 7 of 64 on each side.
  EXPECT_DOUBLE_EQ(TestOne(VectorXd{{0.1, 0.1, 0.1, -0.1, 0.1, 0.1}}).test.p,
                   14.0 / 64.0);
}

TEST(TestBySignFlips, CannotReachFivePercentWithFiveDifferences) {
  EXPECT_DOUBLE_EQ(TestOne(VectorXd{{1, 2, 3, 4, 5}}).test.p, 0.0625);
  EXPECT_DOUBLE_EQ(TestOne(VectorXd{{1, 2, 3, 4, 5}}).smallest_p, 0.0625);
}

TEST(TestBySignFlips, DropsZerosWhichNoSignChanges) {
  const SignFlipTest found = TestOne(VectorXd{{0, 1, 2, 0, 3, 4, 0}});
  EXPECT_DOUBLE_EQ(found.test.p, 2.0 / 16.0);
  EXPECT_DOUBLE_EQ(found.smallest_p, 2.0 / 16.0);
  EXPECT_DOUBLE_EQ(found.test.statistic, 10.0 / 7.0);
  const SignFlipTest equal = TestOne(VectorXd::Zero(40));
  EXPECT_EQ(equal.test.p, 1.0);
  EXPECT_EQ(equal.smallest_p, 1.0);
  EXPECT_TRUE(equal.exact);
}

TEST(TestBySignFlips, DrawsWhereThereAreTooManyPatterns) {
  Random random(4);
  const VectorXd d =
      NormalSample(kMostForExactFlips + 1, &random).array() + 0.3;
  const SignFlipTest drawn = TestOne(d);
  EXPECT_FALSE(drawn.exact);
  EXPECT_DOUBLE_EQ(drawn.smallest_p, 1e-4);
  // Exact of all but the smallest difference, and four standard errors.
  Index smallest = 0;
  d.cwiseAbs().minCoeff(&smallest);
  VectorXd fewer = d;
  fewer[smallest] = 0.0;
  const SignFlipTest exact = TestOne(fewer);
  EXPECT_TRUE(exact.exact);
  const double p = exact.test.p;
  EXPECT_GT(p, 0.01);
  EXPECT_NEAR(drawn.test.p, p, 4.0 * std::sqrt(p * (1.0 - p) / 9999.0) + 0.005);
  EXPECT_DOUBLE_EQ(TestOne(VectorXd::Constant(200, 0.1)).test.p, 1e-4);
}

TEST(TestBySignFlips, GivesTheSameForTheSameSeedOnly) {
  Random random(5);
  const VectorXd d = NormalSample(60, &random);
  const double p = TestBySignFlips(d, 999, 1).front().test.p;
  EXPECT_EQ(p, TestBySignFlips(d, 999, 1).front().test.p);
  EXPECT_NE(p, TestBySignFlips(d, 999, 2).front().test.p);
}

TEST(TestBySignFlips, UsesTheSamePatternsForAllPairs) {
  Random random(6);
  const VectorXd d = NormalSample(60, &random);
  MatrixXd twice(60, 3);
  twice << d, -d, 1e-9 * d;
  const auto found = TestBySignFlips(twice, 999, 1);
  EXPECT_EQ(found[0].test.p, found[1].test.p);
  EXPECT_EQ(found[0].test.p, found[2].test.p);
}

TEST(TestBySignFlips, SaysWhyOrThrowsWhereItDoesNotApply) {
  const auto none = TestBySignFlips(MatrixXd(0, 2), kDraws, kSeed);
  ASSERT_EQ(none.size(), 2U);
  EXPECT_EQ(none[1].test.why_not, "no units");
  EXPECT_TRUE(TestBySignFlips(MatrixXd(7, 0), kDraws, kSeed).empty());
  EXPECT_THAT([] { TestBySignFlips(VectorXd::Ones(9), 0, kSeed); },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("at least 1 draw, found 0")));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(
      [&] {
        TestBySignFlips(VectorXd{{1.0, nan}}, 9, kSeed);
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("not finite")));
}

}  // namespace
}  // namespace errmap::stats
