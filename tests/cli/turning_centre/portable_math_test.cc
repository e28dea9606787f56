#include "cli/turning_centre/portable_math.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "cli/turning_centre/random_stream.h"

namespace errmap::turning_centre {
namespace {

TEST(PortableMath, SineAgreesWithTheCLibraryToItsStatedError) {
  // 2 pi turns itself is rounded in the reference: no more than 1/2 turn here.
  constexpr double kStated = 1e-15;
  for (int i = -500; i <= 500; ++i) {
    const double turns = i / 1000.0;
    EXPECT_NEAR(
        SinOfTurns(turns), std::sin(2.0 * std::numbers::pi * turns), kStated)
        << turns;
    EXPECT_NEAR(
        CosOfTurns(turns), std::cos(2.0 * std::numbers::pi * turns), kStated)
        << turns;
  }
}

TEST(PortableMath, SineHasItsPeriodAndSymmetry) {
  for (int i = 0; i <= 64; ++i) {
    const double turns = i / 64.0;  // exact, also with whole turns added
    EXPECT_EQ(SinOfTurns(turns + 7.0), SinOfTurns(turns));
    EXPECT_EQ(SinOfTurns(turns - 1000.0), SinOfTurns(turns));
    EXPECT_EQ(SinOfTurns(turns + 0.5), -SinOfTurns(turns));
  }
  EXPECT_EQ(SinOfTurns(0.0), 0.0);
  EXPECT_EQ(SinOfTurns(3.0), 0.0);
}

TEST(PortableMath, LogarithmAgreesWithTheCLibraryToItsStatedError) {
  constexpr double kUnit = 0x1.0p-53;
  for (double x : {0x1.0p-1022,
                   1e-300,
                   1e-16,
                   0.3,
                   0.7071067811865475,
                   0.9999,
                   1.0,
                   1.0000001,
                   1.5,
                   2.0,
                   10.0,
                   12345.678,
                   1e300}) {
    const double expected = std::log(x);
    EXPECT_NEAR(PortableLog(x),
                expected,
                4.0 * kUnit * std::max(1.0, std::abs(expected)))
        << x;
  }
  EXPECT_EQ(PortableLog(1.0), 0.0);
}

TEST(RandomStream, IsTheSameForTheSameKeyAndAnotherForAnother) {
  RandomStream a(1, Purpose::kProgramme, 2);
  RandomStream same(1, Purpose::kProgramme, 2);
  RandomStream other_seed(2, Purpose::kProgramme, 2);
  RandomStream other_purpose(1, Purpose::kSensorNoise, 2);
  RandomStream other_index(1, Purpose::kProgramme, 3);
  const double value = a.Uniform();
  EXPECT_EQ(same.Uniform(), value);
  EXPECT_NE(other_seed.Uniform(), value);
  EXPECT_NE(other_purpose.Uniform(), value);
  EXPECT_NE(other_index.Uniform(), value);
}

TEST(RandomStream, NormalDeviatesHaveTheMomentsOfTheNormalDistribution) {
  constexpr int kCount = 200000;
  RandomStream random(3, Purpose::kReadingNoise, 0);
  double sum = 0.0;
  double sum_2 = 0.0;
  double sum_4 = 0.0;
  int beyond_two = 0;
  for (int i = 0; i < kCount; ++i) {
    const double z = random.Normal();
    sum += z;
    sum_2 += z * z;
    sum_4 += z * z * z * z;
    beyond_two += std::abs(z) > 2.0 ? 1 : 0;
  }
  // Five standard errors: 1, sqrt(2), sqrt(96) and sqrt(p (1 - p)) over sqrt n.
  EXPECT_NEAR(sum / kCount, 0.0, 5.0 * 0.0022361);
  EXPECT_NEAR(sum_2 / kCount, 1.0, 5.0 * 0.0031623);
  EXPECT_NEAR(sum_4 / kCount, 3.0, 5.0 * 0.0219089);
  EXPECT_NEAR(beyond_two / double{kCount}, 0.0455003, 5.0 * 0.000466);
}

}  // namespace
}  // namespace errmap::turning_centre
