#include "stats/summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stats/random.h"
#include "tests/models/serial_reference.h"
#include "tests/stats/golden_samples.h"

namespace errmap::stats {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// -log10 of the relative error, as NIST's Statistical Reference Datasets
// (StRD) are judged; 15 where nothing differs.
double AgreeingDigits(double found, double certified) {
  constexpr double kMost = 15.0;
  if (found == certified) return kMost;
  return std::min(
      kMost, -std::log10(std::abs(found - certified) / std::abs(certified)));
}

// The pattern of NIST StRD NumAcc2 to NumAcc4 (www.itl.nist.gov/div898/strd):
// base + 0.2, then 500 pairs of base + 0.1, base + 0.3. Built in decimal, so
// that each number is the double nearest to what the file says.
VectorXd NumAcc(Index base) {
  constexpr Index kPairs = 500;
  const auto number = [base](int tenths) {
    return std::stod(std::to_string(base) + "." + std::to_string(tenths));
  };
  VectorXd sample(2 * kPairs + 1);
  sample[0] = number(2);
  for (Index pair = 0; pair < kPairs; ++pair) {
    sample[2 * pair + 1] = number(1);
    sample[2 * pair + 2] = number(3);
  }
  return sample;
}

VectorXd Random397(std::uint64_t seed) {
  Random random(seed);
  VectorXd sample(397);
  for (double& value : sample) value = random.Uniform() - 0.3;
  return sample;
}

TEST(Summarize, GivesTheFiguresOfASmallSample) {
  const SampleSummary summary = Summarize(VectorXd{{2.0, 4.0, 4.0, 6.0}});
  EXPECT_EQ(summary.n, 4);
  EXPECT_DOUBLE_EQ(summary.mean, 4.0);
  EXPECT_DOUBLE_EQ(summary.sd, std::sqrt(8.0 / 3.0));  // divisor n - 1
  EXPECT_EQ(summary.min, 2.0);
  EXPECT_EQ(summary.max, 6.0);
  EXPECT_EQ(summary.range, 4.0);
}

TEST(Summarize, OfNothingIsNotANumber) {
  const SampleSummary summary = Summarize(VectorXd());
  EXPECT_EQ(summary.n, 0);
  EXPECT_TRUE(std::isnan(summary.mean));
  EXPECT_TRUE(std::isnan(summary.sd));
  EXPECT_TRUE(std::isnan(summary.min));
  EXPECT_TRUE(std::isnan(summary.max));
  EXPECT_TRUE(std::isnan(summary.range));
}

TEST(Summarize, OfOneValueHasNoSpread) {
  const SampleSummary summary = Summarize(VectorXd{{-3.25}});
  EXPECT_EQ(summary.n, 1);
  EXPECT_EQ(summary.mean, -3.25);
  EXPECT_TRUE(std::isnan(summary.sd));
  EXPECT_EQ(summary.min, -3.25);
  EXPECT_EQ(summary.max, -3.25);
  EXPECT_EQ(summary.range, 0.0);
}

TEST(Summarize, OfEqualValuesHasExactlyZeroSd) {
  for (const double value : {0.1, 1e6 + 0.1, -1e-9, 0.0}) {
    const SampleSummary summary = Summarize(VectorXd::Constant(1001, value));
    EXPECT_EQ(summary.mean, value);
    EXPECT_EQ(summary.sd, 0.0);
  }
}

// Certified values: NIST StRD, univariate. The digits that any program can
// reach end where the data, read as doubles, differ from the decimals: half a
// unit of 1e6 (or 1e7) against a deviation of 0.1.
TEST(Summarize, ReachesTheDigitsThatNumAccDataCarry) {
  constexpr double kAllDigits = 14.9;
  constexpr double kDigitsOfSdAtOneMillion = 9.4;
  constexpr double kDigitsOfSdAtTenMillions = 8.2;

  const SampleSummary one =
      Summarize(VectorXd{{10000001.0, 10000003.0, 10000002.0}});
  EXPECT_EQ(one.mean, 10000002.0);
  EXPECT_EQ(one.sd, 1.0);

  const SampleSummary two = Summarize(NumAcc(1));
  EXPECT_GE(AgreeingDigits(two.mean, 1.2), kAllDigits);
  EXPECT_GE(AgreeingDigits(two.sd, 0.1), kAllDigits);

  const SampleSummary three = Summarize(NumAcc(1000000));
  EXPECT_EQ(three.n, 1001);
  EXPECT_GE(AgreeingDigits(three.mean, 1000000.2), kAllDigits);
  EXPECT_GE(AgreeingDigits(three.sd, 0.1), kDigitsOfSdAtOneMillion);

  const SampleSummary four = Summarize(NumAcc(10000000));
  EXPECT_GE(AgreeingDigits(four.mean, 10000000.2), kAllDigits);
  EXPECT_GE(AgreeingDigits(four.sd, 0.1), kDigitsOfSdAtTenMillions);
}

// Against the doubles themselves no digit is lost: what the decimals differ by
// is taken out by working on deviations, which are exact differences here.
TEST(Summarize, LosesNoDigitsOfTheDoublesItIsGiven) {
  constexpr double kAllDigits = 14.9;
  for (const Index base : {1000000, 10000000}) {
    const VectorXd sample = NumAcc(base);
    const VectorXd moved = sample.array() - static_cast<double>(base);
    const double sd = Summarize(moved).sd;
    EXPECT_GE(AgreeingDigits(Summarize(sample).sd, sd), kAllDigits) << base;
  }
}

// Against sums in 64 binary digits, whose rounding no double sees.
TEST(Summarize, MeanIsTheDoubleNearestToTheTrueOne) {
  Random random(5);
  for (int draw = 0; draw < 2000; ++draw) {
    VectorXd sample(7);
    for (double& value : sample) value = 1.0 + random.Uniform();
    long double sum = 0.0L;
    for (const double value : sample) sum += value;
    EXPECT_EQ(Summarize(sample).mean, static_cast<double>(sum / 7.0L)) << draw;
  }
}

TEST(Summarize, ShiftMovesTheMeanAndKeepsTheSpread) {
  // Multiples of 2^-30 within 1, moved by a power of two: every sum is exact.
  constexpr double kQuantum = 0x1.0p-30;
  constexpr double kShift = 0x1.0p20;
  constexpr double kRounding = 1e-15;  // of divisions and the root
  VectorXd sample = Random397(1);
  for (double& value : sample) value = std::round(value / kQuantum) * kQuantum;
  const VectorXd shifted = sample.array() + kShift;
  const SampleSummary before = Summarize(sample);
  const SampleSummary after = Summarize(shifted);
  EXPECT_DOUBLE_EQ(after.mean, before.mean + kShift);
  EXPECT_NEAR(after.sd, before.sd, kRounding);
  EXPECT_EQ(after.range, before.range);
  EXPECT_EQ(after.min, before.min + kShift);
  EXPECT_EQ(after.max, before.max + kShift);
}

TEST(Summarize, ScaleByAPowerOfTwoScalesEveryFigureExactly) {
  constexpr double kScale = 1024.0;
  const VectorXd sample = Random397(2);
  const SampleSummary before = Summarize(sample);
  const SampleSummary after = Summarize(kScale * sample);
  EXPECT_EQ(after.mean, kScale * before.mean);
  EXPECT_EQ(after.sd, kScale * before.sd);
  EXPECT_EQ(after.range, kScale * before.range);
}

// Whose squares are not numbers.
TEST(Summarize, KnowsTheSpreadOfVeryLargeAndVerySmallValues) {
  const VectorXd sample{{3.0, -1.0, 4.0, 1.5}};
  const SampleSummary plain = Summarize(sample);
  for (const int power : {1000, 600, -600, -1000}) {
    const double scale = std::scalbn(1.0, power);
    const SampleSummary scaled = Summarize(sample * scale);
    EXPECT_EQ(scaled.mean, plain.mean * scale);
    EXPECT_EQ(scaled.sd, plain.sd * scale);
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(std::isfinite(Summarize(VectorXd{{0.0, kInfinity}}).mean));
}

TEST(Summarize, OrderOfTheRowsDoesNotMatter) {
  constexpr double kRounding = 1e-16;  // of one sum of 397 values below 1
  const VectorXd sample = Random397(3);
  const SampleSummary before = Summarize(sample);
  std::vector<double> values(sample.begin(), sample.end());
  Random random(4);
  for (int repeat = 0; repeat < 10; ++repeat) {
    random.Shuffle(values);
    const SampleSummary after = Summarize(Eigen::Map<const VectorXd>(
        values.data(), static_cast<Index>(values.size())));
    EXPECT_NEAR(after.mean, before.mean, kRounding);
    EXPECT_NEAR(after.sd, before.sd, kRounding);
    EXPECT_EQ(after.min, before.min);
    EXPECT_EQ(after.max, before.max);
  }
}

TEST(CompensatedSum, KeepsWhatPlainAdditionLoses) {
  EXPECT_EQ(CompensatedSum(VectorXd()), 0.0);
  EXPECT_EQ(CompensatedSum(VectorXd{{1.0, 1e100, 1.0, -1e100}}), 2.0);
  EXPECT_EQ(CompensatedSum(VectorXd::Constant(10, 0.1)), 1.0);
}

TEST(CompensatedSum, TellsOfOverflowAndOfWhatIsNoNumber) {
  constexpr double kMax = std::numeric_limits<double>::max();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(CompensatedSum(VectorXd{{kMax, kMax}}), kInfinity);
  EXPECT_EQ(CompensatedSum(VectorXd{{1.0, -kInfinity, 1.0}}), -kInfinity);
  EXPECT_TRUE(std::isnan(CompensatedSum(VectorXd{{kInfinity, -kInfinity}})));
  EXPECT_TRUE(std::isnan(CompensatedSum(VectorXd{{1.0, std::nan("")}})));
}

// golden/normality/serial_reference.csv: R's quantile(), type 7.
TEST(Quantile, AgreesWithROnEverySample) {
  constexpr double kRounding = 1e-14;
  for (const char* name :
       {"appendix_b_residual", "sample_normal_20", "sample_t3_397"}) {
    VectorXd sorted = GoldenSample(name);
    std::sort(sorted.begin(), sorted.end());
    for (const int percent : {10, 25, 50, 75, 99}) {
      EXPECT_NEAR(Quantile(sorted, percent / 100.0),
                  SerialReference(name).at("q" + std::to_string(percent)),
                  kRounding)
          << name << " " << percent;
    }
  }
}

TEST(Quantile, OfTheEndsAndOfLittle) {
  const VectorXd x{{1.0, 2.0, 4.0}};
  EXPECT_EQ(Quantile(x, 0.0), 1.0);
  EXPECT_EQ(Quantile(x, 1.0), 4.0);
  EXPECT_EQ(Quantile(x, 0.75), 3.0);
  EXPECT_EQ(Quantile(VectorXd{{7.0}}, 0.3), 7.0);
  EXPECT_TRUE(std::isnan(Quantile(VectorXd(), 0.5)));
  EXPECT_THROW(Quantile(x, 1.1), std::invalid_argument);
  EXPECT_THROW(Quantile(x, std::nan("")), std::invalid_argument);
}

TEST(Standardise, GivesMeanZeroAndSdOneInTheSameOrder) {
  const VectorXd z = Standardise(VectorXd{{6.0, 2.0, 4.0}});
  EXPECT_EQ(z, (VectorXd{{1.0, -1.0, 0.0}}));
  EXPECT_THROW(Standardise(VectorXd{{1.0}}), std::invalid_argument);
  EXPECT_THROW(Standardise(VectorXd::Ones(3)), std::invalid_argument);
}

TEST(StandardError, IsTheSdOverTheRootOfN) {
  EXPECT_DOUBLE_EQ(StandardError(std::sqrt(8.0 / 3.0), 4),
                   std::sqrt(8.0 / 3.0) / 2.0);
}

TEST(MakeHistogram, CountsEveryValueOnce) {
  // IQR 4.5 of 0 .. 9: width 2 * 4.5 / 10^(1/3) = 4.18, so 3 bins.
  const VectorXd x = VectorXd::LinSpaced(10, 0.0, 9.0);
  const Histogram automatic = MakeHistogram(x, 0);
  EXPECT_EQ(automatic.counts, (std::vector<Eigen::Index>{3, 3, 4}));
  EXPECT_DOUBLE_EQ(automatic.width, 3.0);
  const Histogram fixed = MakeHistogram(x, 2);
  EXPECT_EQ(fixed.counts, (std::vector<Eigen::Index>{5, 5}));
  EXPECT_EQ(fixed.low, 0.0);
}

TEST(MakeHistogram, OfEqualAndOfHeapedValues) {
  EXPECT_EQ(MakeHistogram(VectorXd::Constant(4, 2.0), 0).counts,
            (std::vector<Eigen::Index>{4}));
  VectorXd heaped = VectorXd::Zero(20);  // IQR 0
  heaped[19] = 1.0;
  EXPECT_EQ(MakeHistogram(heaped, 0).counts.size(), 6U);  // log2(20) + 1
  VectorXd far = VectorXd::LinSpaced(100, 0.0, 1.0);
  far[99] = 1e9;
  EXPECT_EQ(MakeHistogram(far, 0).counts.size(), 1000U);
  EXPECT_THROW(MakeHistogram(VectorXd(), 0), std::invalid_argument);
  EXPECT_THROW(MakeHistogram(heaped, -1), std::invalid_argument);
}

TEST(Correlation, IsOneOfWhatGoesTogetherAndZeroOfAConstant) {
  const Eigen::VectorXd rising{{1.0, 2.0, 4.0}};
  EXPECT_NEAR(Correlation(rising, 3.0 * rising), 1.0, 1e-15);
  EXPECT_NEAR(Correlation(rising, -rising), -1.0, 1e-15);
  EXPECT_EQ(Correlation(rising, Eigen::VectorXd::Ones(3)), 0.0);
  // By hand: deviations (-1, 0, 1) and (1, -2, 1).
  EXPECT_EQ(Correlation(Eigen::VectorXd{{1.0, 2.0, 3.0}},
                        Eigen::VectorXd{{3.0, 0.0, 3.0}}),
            0.0);
}

}  // namespace
}  // namespace errmap::stats
