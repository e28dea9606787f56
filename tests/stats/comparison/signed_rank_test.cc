#include "stats/comparison/signed_rank.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace errmap::stats {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kSignedRankRelative = 1e-12;

struct Reference {
  double v;
  double p;
  bool exact;
};

void ExpectAsR(const VectorXd& differences, const Reference& r) {
  const SignedRankTest found = TestSignedRanks(differences);
  ASSERT_TRUE(found.test.ok()) << found.test.why_not;
  EXPECT_EQ(found.test.statistic, r.v);
  EXPECT_NEAR(found.test.p, r.p, kSignedRankRelative * r.p);
  EXPECT_EQ(found.exact, r.exact);
}

// n values without ties or zeros: ((7 i^2) mod 101)/10 - 4.03 + i step, i = 1
// ... n.
VectorXd Scattered(Index n, double step) {
  VectorXd values(n);
  for (Index i = 1; i <= n; ++i) {
    values[i - 1] = static_cast<double>((i * i * 7) % 101) / 10.0 - 4.03 +
                    static_cast<double>(i) * step;
  }
  return values;
}

// R 4.2.2: wilcox.test(d)$statistic and $p.value, "%.17g".
TEST(TestSignedRanks, AgreesWithRWhereExact) {
  ExpectAsR(VectorXd{{0.8, -0.3, 1.7, 2.2, -0.9, 0.4, 3.1, -1.2, 0.65, 1.05}},
            {42.0, 0.16015625, true});
  ExpectAsR(Scattered(49, 0.0), {852.0, 0.016490706021031091, true});
  ExpectAsR(VectorXd{{0.3}}, {1.0, 1.0, true});
  ExpectAsR(VectorXd{{1, 2, 3, 4, 5, 6}}, {21.0, 0.03125, true});
}

TEST(TestSignedRanks, AgreesWithRWithTiesZerosAndFromFiftyOn) {
  ExpectAsR(VectorXd{{1, -1, 2, 2, -3, 4, 5, -5, 6, 7, 8, -2}},
            {58.0, 0.14577446391220564, false});
  ExpectAsR(VectorXd{{0, 0, 1, -2, 3, 4, 5, -6, 7, 8}},
            {28.0, 0.18343061898217813, false});
  ExpectAsR(Scattered(50, 1e-6), {875.0, 0.022147595151076924, false});
}

TEST(TestSignedRanks, GivesTheSamePWhenAAndBChangePlaces) {
  const VectorXd d = Scattered(31, 0.0);
  EXPECT_DOUBLE_EQ(TestSignedRanks(d).test.p, TestSignedRanks(-d).test.p);
  EXPECT_DOUBLE_EQ(TestSignedRanks(d).test.p,
                   TestSignedRanks(1e-200 * d).test.p);
}

TEST(TestSignedRanks, FindsNothingInEqualModels) {
  const SignedRankTest found = TestSignedRanks(VectorXd::Zero(9));
  EXPECT_TRUE(found.test.ok());
  EXPECT_EQ(found.test.p, 1.0);
  EXPECT_FALSE(found.exact);
}

TEST(TestSignedRanks, SaysWhyWhereItDoesNotApply) {
  EXPECT_EQ(TestSignedRanks(VectorXd()).test.why_not, "no units");
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(TestSignedRanks(VectorXd{{1.0, infinity}}).test.why_not,
            "differences that are not finite");
}

}  // namespace
}  // namespace errmap::stats
