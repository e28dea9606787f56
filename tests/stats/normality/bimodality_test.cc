#include "stats/normality/bimodality.h"

#include <algorithm>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stats/random.h"
#include "tests/models/serial_reference.h"
#include "tests/stats/golden_samples.h"

namespace errmap::stats {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kBimodalityRounding = 1e-14;

VectorXd Sorted(VectorXd values) {
  std::sort(values.begin(), values.end());
  return values;
}

// golden/normality/serial_reference.csv: R's diptest.
TEST(DipStatistic, ReproducesDiptestOnEverySample) {
  for (const std::string& name : GoldenSampleNames()) {
    if (name == "sample_uniform_5000") continue;  // not among R's
    EXPECT_NEAR(DipStatistic(Sorted(GoldenSample(name))),
                SerialReference(name).at("dip"),
                kBimodalityRounding)
        << name;
  }
}

TEST(DipStatistic, ReproducesDiptestWithTiesAndTwoModes) {
  const VectorXd once{{1, 2, 3, 3, 3, 9, 9, 9, 10}};
  EXPECT_NEAR(DipStatistic(Sorted(once.replicate(4, 1))),
              SerialReference("ties_1_to_20").at("dip"),
              kBimodalityRounding);
  VectorXd two_modes(40);
  for (Index i = 0; i < 20; ++i) {
    two_modes[i] = static_cast<double>(i + 1);
    two_modes[i + 20] = static_cast<double>(i + 101);
  }
  EXPECT_NEAR(DipStatistic(two_modes),
              SerialReference("two_modes").at("dip"),
              kBimodalityRounding);
  EXPECT_EQ(DipProbability(DipStatistic(two_modes), 40), 0.001);
}

TEST(DipStatistic, IsHalfAStepAtLeastAndAQuarterAtMost) {
  EXPECT_EQ(DipStatistic(VectorXd()), 0.0);
  EXPECT_DOUBLE_EQ(DipStatistic(VectorXd{{3.0}}), 0.5);
  EXPECT_DOUBLE_EQ(DipStatistic(VectorXd::Constant(5, 2.0)), 0.1);
  EXPECT_DOUBLE_EQ(DipStatistic(VectorXd::LinSpaced(10, 0.0, 1.0)), 0.05);
  VectorXd poles = VectorXd::Zero(100);
  poles.tail(50).setOnes();
  EXPECT_LE(DipStatistic(poles), 0.25);
  EXPECT_GT(DipStatistic(poles), 0.24);
}

TEST(DipStatistic, DoesNotDependOnShiftOrScaleOrSign) {
  Random random(9);
  const VectorXd x = Sorted(NormalSample(200, &random));
  const double dip = DipStatistic(x);
  EXPECT_NEAR(DipStatistic(1e3 * x.array() + 5.0), dip, 1e-12);
  EXPECT_NEAR(DipStatistic(Sorted(-x)), dip, kBimodalityRounding);
}

// The report's Figures 15 and 15A look bimodal; this is how such a histogram
// would show: two normal heaps of sd 1 two and a half sd to either side.
TEST(DipProbability, FindsTwoHeapsAndLeavesOneAlone) {
  Random random(15);
  VectorXd x = NormalSample(397, &random);
  EXPECT_GT(DipProbability(DipStatistic(Sorted(x)), x.size()), 0.1);
  for (Index i = 0; i < x.size(); ++i) x[i] += i % 2 == 0 ? 2.5 : -2.5;
  EXPECT_LE(DipProbability(DipStatistic(Sorted(x)), x.size()), 0.001);
}

TEST(DipProbability, OfTooFewValuesIsOne) {
  EXPECT_EQ(DipProbability(0.5, 1), 1.0);
  EXPECT_EQ(DipProbability(0.25, 3), 1.0);
}

}  // namespace
}  // namespace errmap::stats
