#include "stats/comparison/mean_square_bounds.h"

#include <cmath>

#include <gtest/gtest.h>

#include "stats/random.h"

namespace errmap::stats {
namespace {

constexpr std::uint64_t kSeedOfBounds = 1;
constexpr int kProcesses = 400;

// Share of processes of mean `mean` and variance 1 whose mean square the bounds
// of a series hold. Without a mean the series is what leave-one-out leaves of
// each value: then the error of a map is the mean that it takes for zero.
struct Held {
  double share = 0.0;
  double factor = 0.0;  // of the upper bound, in the geometric mean
};

Held HeldBy95(Index size, double memory, const double* mean = nullptr) {
  MeanSquareBounds bounds(size, kSeedOfBounds);
  Random random(2);
  Held held;
  for (int i = 0; i < kProcesses; ++i) {
    VectorXd x = AutoregressionSample(size, memory, &random);
    const double offset = mean == nullptr ? x.mean() : *mean;
    if (mean == nullptr) {
      const auto n = static_cast<double>(size);
      x = (x.array() - offset) * n / (n - 1.0);
    } else {
      x.array() += offset;
    }
    const Bounds95 found = bounds.OfRoot(x, bounds.LargestMemory(x));
    const double truth = std::hypot(1.0, offset);
    held.share += found.lower <= truth && truth <= found.upper;
    held.factor +=
        std::log(found.upper * std::sqrt(static_cast<double>(size)) / x.norm());
  }
  held.share /= kProcesses;
  held.factor = std::exp(held.factor / kProcesses);
  return held;
}

TEST(MeanSquareBounds, HoldWhatIsToComeWhateverTheMemory) {
  constexpr double kTwo = 2.0;
  for (const Index size : {5, 6, 8, 12, 20, 40}) {
    for (const double memory : {0.0, 0.3, 0.6, 0.9}) {
      EXPECT_GE(HeldBy95(size, memory).share, 0.9) << size << ", " << memory;
      EXPECT_GE(HeldBy95(size, memory, &kTwo).share, 0.88)
          << size << ", " << memory;
    }
  }
}

TEST(MeanSquareBounds, TellIndependentValuesFromAMemoryBeTheyEnough) {
  EXPECT_LE(HeldBy95(6, 0.0).factor, 7.0);
  EXPECT_LE(HeldBy95(12, 0.0).factor, 3.0);
  EXPECT_LE(HeldBy95(40, 0.0).factor, 1.4);
  EXPECT_LE(HeldBy95(40, 0.0).factor * 1.4, HeldBy95(40, 0.9).factor);
}

TEST(MeanSquareBounds, ExcludeNothingByFourValues) {
  MeanSquareBounds of_four(4, kSeedOfBounds);
  EXPECT_EQ(of_four.LargestMemory(VectorXd{{1.0, -1.0, 1.0, -1.0}}), 0.9);
  MeanSquareBounds of_ten(10, kSeedOfBounds);
  VectorXd x(10);
  for (Index i = 0; i < 10; ++i) x[i] = i % 2 == 0 ? 1.0 : -1.0;
  EXPECT_EQ(of_ten.LargestMemory(x), 0.0);
  EXPECT_EQ(of_ten.LargestMemory(VectorXd::LinSpaced(10, -1.0, 1.0)), 0.9);
}

TEST(MeanSquareBounds, AreInTheUnitAndAddWhatIsKnown) {
  const VectorXd x{{0.3, -1.0, 0.7, 0.2, -0.4, 1.1}};
  MeanSquareBounds bounds(6, kSeedOfBounds);
  const Bounds95 one = bounds.OfRoot(x, 0.9);
  const Bounds95 other = bounds.OfRoot(1e3 * x, 0.9);
  EXPECT_EQ(bounds.LargestMemory(x), bounds.LargestMemory(1e3 * x));
  EXPECT_NEAR(1e3 * one.upper, other.upper, 1e-9 * other.upper);
  EXPECT_LT(one.lower, one.at_least);
  EXPECT_LT(one.at_least, one.at_most);
  EXPECT_LT(one.at_most, one.upper);
  EXPECT_EQ(bounds.OfRoot(VectorXd::Constant(6, 3.0), 0.9, 16.0).upper, 5.0);
}

}  // namespace
}  // namespace errmap::stats
