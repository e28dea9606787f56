#include "stats/distributions.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/numbers.h"

namespace errmap::stats {
namespace {

// R 4.2.2: sprintf("%.17g", pnorm(z, log.p = TRUE)).
TEST(LogNormalCdf, AgreesWithRFarIntoTheTail) {
  constexpr double kRelative = 1e-13;
  const double reference[][2] = {{-1000.0, -500007.82669481216},
                                 {-40.0, -804.6084420137538},
                                 {-31.0, -484.85396362717927},
                                 {-29.9, -451.32291245852861},
                                 {-5.0, -15.064998393988725},
                                 {0.0, -0.69314718055994529},
                                 {3.0, -0.0013508099647481923},
                                 {8.0, -6.2209605742717859e-16}};
  for (const auto& [z, log_p] : reference) {
    // Above 0 the digits of 1 - p are those of the probability itself.
    const double absolute = z > 0.0 ? 3e-16 : 0.0;
    EXPECT_NEAR(LogNormalCdf(z), log_p, kRelative * std::abs(log_p) + absolute)
        << z;
  }
}

TEST(LogNormalCdf, DoesNotJumpWhereTheSeriesTakesOver) {
  EXPECT_NEAR(
      LogNormalCdf(std::nextafter(-30.0, -31.0)), LogNormalCdf(-30.0), 1e-9);
}

TEST(NormalQuantile, InvertsTheDistributionFunction) {
  constexpr double kRelative = 1e-13;
  for (const double p : {1e-300, 1e-20, 1e-5, 0.01, 0.3, 0.5, 0.975}) {
    EXPECT_NEAR(NormalCdf(NormalQuantile(p)), p, 1000 * kRelative * p) << p;
  }
  EXPECT_NEAR(NormalQuantile(0.975), 1.959963984540054, 1e-14);
  EXPECT_EQ(NormalQuantile(0.5), 0.0);
  EXPECT_EQ(NormalQuantile(0.0), -kInfinity);
  EXPECT_EQ(NormalQuantile(1.0), kInfinity);
  EXPECT_TRUE(std::isnan(NormalQuantile(-0.1)));
}

// R 4.2.2: pchisq, pf and 2 pt with lower.tail = FALSE.
TEST(Distributions, AgreeWithR) {
  constexpr double kRelative = 1e-12;
  const auto expect = [](double found, double expected) {
    EXPECT_NEAR(found, expected, kRelative * expected);
  };
  expect(ChiSquaredUpperTail(3.84, 1.0), 0.050043521248705224);
  expect(ChiSquaredUpperTail(362.16623198646408, 10.0), 1.0412345999496488e-71);
  expect(FUpperTail(2.5, 3.0, 40.0), 0.073254352017949942);
  expect(FUpperTail(9.7259729819367831, 34.0, 362.0), 1.0332841206047489e-33);
  expect(StudentTwoSided(2.1, 12.0), 0.05754493873495118);
  expect(NormalTwoSided(-1.96), 0.049995790296440856);
}

// R 4.2.2: qt(p, df).
TEST(StudentQuantile, AgreesWithR) {
  constexpr double kRelative = 1e-12;
  const double reference[][3] = {{0.025, 5.0, -2.570581835636315},
                                 {0.05, 1.0, -6.3137515146750438},
                                 {0.975, 34.0, 2.0322445093177182},
                                 {0.1, 2.0, -1.8856180831641265}};
  for (const auto& [p, degrees_of_freedom, t] : reference) {
    EXPECT_NEAR(
        StudentQuantile(p, degrees_of_freedom), t, kRelative * std::abs(t));
  }
  EXPECT_NEAR(StudentQuantile(0.5, 7.0), 0.0, 1e-15);
}

// R 4.2.2: qchisq(p, df).
TEST(ChiSquaredQuantile, AgreesWithR) {
  constexpr double kRelative = 1e-12;
  const double reference[][3] = {{0.2, 1.0, 0.064184754667301613},
                                 {0.2, 3.0, 1.005174013052349213},
                                 {0.95, 2.0, 5.991464547107979932},
                                 {0.001, 2.5, 0.008815875243366963}};
  for (const auto& [p, degrees_of_freedom, x] : reference) {
    EXPECT_NEAR(ChiSquaredQuantile(p, degrees_of_freedom), x, kRelative * x);
  }
}

TEST(Distributions, HaveTheirLimits) {
  EXPECT_EQ(ChiSquaredUpperTail(0.0, 3.0), 1.0);
  EXPECT_EQ(ChiSquaredUpperTail(kInfinity, 3.0), 0.0);
  EXPECT_EQ(FUpperTail(0.0, 3.0, 4.0), 1.0);
  EXPECT_EQ(FUpperTail(kInfinity, 3.0, 4.0), 0.0);
  EXPECT_TRUE(std::isnan(ChiSquaredUpperTail(std::nan(""), 3.0)));
  EXPECT_TRUE(std::isnan(FUpperTail(std::nan(""), 3.0, 4.0)));
}

TEST(LogFactorial, IsTheSumOfLogarithms) {
  long double sum = 0.0L;
  for (std::ptrdiff_t n = 0; n <= 200; ++n) {
    if (n > 1) sum += std::log(static_cast<long double>(n));
    EXPECT_NEAR(
        static_cast<double>(LogFactorial(n)), static_cast<double>(sum), 1e-12)
        << n;
  }
}

}  // namespace
}  // namespace errmap::stats
