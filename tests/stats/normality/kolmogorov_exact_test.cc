#include "stats/normality/kolmogorov_exact.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stats/kolmogorov_smirnov.h"
#include "tests/places.h"
#include "tests/stats/golden_samples.h"

namespace errmap::stats {
namespace {

using Eigen::Index;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// golden/kolmogorov.csv: multiprecision, rounded to double.
TEST(KsProbabilityExact, AgreesWithMultiprecisionValues) {
  constexpr double kAbsolute = 1e-12;
  const std::string path = tests::TestDir() + "/golden/kolmogorov.csv";
  const Eigen::VectorXd n = ReadCsvColumn(path, "n");
  const Eigen::VectorXd d = ReadCsvColumn(path, "d");
  const Eigen::VectorXd sf = ReadCsvColumn(path, "sf");
  ASSERT_GE(n.size(), 28);
  for (Index i = 0; i < n.size(); ++i) {
    EXPECT_NEAR(
        KsProbabilityExact(d[i], static_cast<Index>(n[i])), sf[i], kAbsolute)
        << n[i] << " " << d[i];
  }
}

// golden/normality.json, ks_fitted_mtw_p_multiprecision.
TEST(KsProbabilityExact, OfTheReportsResidualsAgreesInAllDigits) {
  constexpr double kAbsolute = 1e-13;
  EXPECT_NEAR(KsProbabilityExact(0.038008178957008976, 397),
              0.6011511088032951,
              kAbsolute);
}

TEST(KsProbabilityExact, HasItsClosedForms) {
  constexpr double kRounding = 1e-15;
  // One value: P(D >= d) = 2 (1 - d) from 1/2 on.
  for (const double d : {0.5, 0.6, 0.875, 0.999}) {
    EXPECT_NEAR(KsProbabilityExact(d, 1), 2.0 * (1.0 - d), kRounding) << d;
  }
  // d at most 1/n: P(D < d) = n! (2 d - 1/n)^n (Ruben & Gambino 1982).
  EXPECT_NEAR(KsProbabilityExact(0.3, 2), 1.0 - 2.0 * 0.01, kRounding);
  EXPECT_NEAR(KsProbabilityExact(0.3, 3),
              1.0 - 6.0 * std::pow(0.6 - 1.0 / 3.0, 3.0),
              kRounding);
  // The largest distance: 2 (1 - d)^n from 1 - 1/n on.
  EXPECT_NEAR(KsProbabilityExact(0.9, 5), 2.0 * std::pow(0.1, 5.0), kRounding);
}

TEST(KsProbabilityExact, FallsFromOneToZero) {
  for (const Index n : {1, 2, 3, 17, 397, 5000}) {
    EXPECT_EQ(KsProbabilityExact(0.0, n), 1.0);
    EXPECT_EQ(KsProbabilityExact(0.5 / static_cast<double>(n), n), 1.0);
    EXPECT_EQ(KsProbabilityExact(1.0, n), 0.0);
  }
  double last = 1.0;
  for (double d = 0.0; d < 1.0; d += 0.001) {
    const double p = KsProbabilityExact(d, 57);
    EXPECT_LE(p, last + 1e-14) << d;
    EXPECT_GE(p, 0.0) << d;
    last = p;
  }
}

// Where a method hands over to the next both are right: no step is to be seen.
TEST(KsProbabilityExact, DoesNotJumpWhereItsMethodsMeet) {
  constexpr double kStep = 1e-9;
  for (const Index n : {30, 397, 5000, 100000}) {
    const double size = static_cast<double>(n);
    const double d = std::sqrt(5.0 / size);
    // dP/dd = -4 n d P there.
    const double slope = 4.0 * size * d * KsProbabilityExact(d, n);
    EXPECT_NEAR(KsProbabilityExact(d - kStep, n),
                KsProbabilityExact(d + kStep, n),
                4.0 * kStep * slope + 1e-12)
        << n;
  }
  // At one z, P changes along n by the same from each n to the next.
  constexpr double kExpansionError = 2e-10;
  constexpr Index kLast = kMostForExactKs;
  for (const double z : {0.5, 0.7, 0.9, 1.2, 1.8}) {
    const auto p = [z](Index n) {
      return KsProbabilityExact(z / std::sqrt(static_cast<double>(n)), n);
    };
    EXPECT_NEAR(p(kLast + 1), 2.0 * p(kLast) - p(kLast - 1), kExpansionError)
        << z;
  }
}

TEST(KsProbabilityExact, ApproachesTheAsymptoticForm) {
  for (const double z : {0.5, 1.0, 1.5}) {
    double last = 1.0;
    for (const Index n : {20, 200, 2000, 20000, 200000}) {
      const double d = z / std::sqrt(static_cast<double>(n));
      const double gap =
          std::abs(KsProbabilityExact(d, n) - KolmogorovComplement(z));
      EXPECT_LT(gap, last) << n;
      last = gap;
    }
  }
}

TEST(KsProbabilityExact, RefusesNoValuesAndPassesNaNOn) {
  EXPECT_TRUE(std::isnan(
      KsProbabilityExact(std::numeric_limits<double>::quiet_NaN(), 5)));
  EXPECT_THAT([] { KsProbabilityExact(0.1, 0); },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("needs at least 1 value, found 0")));
}

}  // namespace
}  // namespace errmap::stats
