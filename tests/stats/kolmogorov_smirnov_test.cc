#include "stats/kolmogorov_smirnov.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "stats/random.h"
#include "stats/summary.h"
#include "tests/numbers.h"
#include "tests/places.h"

namespace errmap::stats {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd ReadColumn(const std::string& path, const std::string& column) {
  const data::CsvTable table = data::ReadCsv(path);
  const auto index = table.Find(column);
  if (index < 0) throw std::runtime_error(path + " has no " + column);
  const std::vector<double> values =
      table.columns[static_cast<std::size_t>(index)].values;
  return Eigen::Map<const VectorXd>(values.data(),
                                    static_cast<Index>(values.size()));
}

VectorXd AppendixB() {
  return ReadColumn(tests::SourceDir() + "/data/sets/nistir5367_appendix_b.csv",
                    "residual_mm");
}

// What scipy 1.10.1 gives for the samples of tests/golden, as it stands in
// golden/normality.json under "python": mean, sd_ddof1, kstest_fitted_exact[0],
// kstest_fitted_asymp[1], kstest_N01_exact[0].
struct GoldenKs {
  std::string name;
  double mean;
  double sd;
  double d;           // from the normal with that mean and sd
  double p;           // of d, mean and sd taken as given
  double d_standard;  // from the normal with mean 0 and sd 1
};

const std::vector<GoldenKs>& GoldenSamples() {
  static const std::vector<GoldenKs> samples = {
      {"appendix_b_residual",
       5.0686546599496165e-06,
       0.00024111894234620553,
       0.038008178957008976,
       0.6148791466005002,
       0.49973230974993815},
      {"sample_normal_20",
       -0.015008356386972866,
       0.8096066568336877,
       0.14780224343473508,
       0.7747945154119417,
       0.191100409155969},
      {"sample_t3_20",
       0.5804066564018149,
       0.912060506079081,
       0.14731403713628452,
       0.7782445779550383,
       0.3830500462457592},
      {"sample_uniform_20",
       0.4279519700487023,
       0.27887292879410885,
       0.0937713044667986,
       0.9946316132095085,
       0.5098715406775259},
      {"sample_normal_397",
       0.05830210360848679,
       0.9852177090441965,
       0.03315552720246928,
       0.7753841748195215,
       0.05564408341312077},
      {"sample_t3_397",
       -0.014933521219087498,
       1.5327000715773624,
       0.09134083594205966,
       0.002654994806551503,
       0.0535273464752221},
      {"sample_uniform_397",
       0.4819539595022722,
       0.282431348607091,
       0.06719831653350211,
       0.055450117499188344,
       0.5013838292175884},
      {"sample_normal_5000",
       -7.352093087213092e-05,
       1.0093658890984984,
       0.013924180622056137,
       0.2868880538519604,
       0.013597045231884042},
      {"sample_t3_5000",
       -0.046035506491578136,
       1.6990919102149022,
       0.09347266532189119,
       2.2704750677650696e-38,
       0.05290230784458195},
  };
  return samples;
}

VectorXd ReadSample(const std::string& name) {
  if (name == "appendix_b_residual") return AppendixB();
  return ReadColumn(tests::TestDir() + "/golden/samples/" + name + ".csv",
                    "value");
}

TEST(KsDistanceFromNormal, AgreesWithScipyOnEverySample) {
  // Two programs' roundings of mean and sd, and of the normal distribution.
  constexpr double kRounding = 1e-13;
  for (const GoldenKs& golden : GoldenSamples()) {
    const VectorXd sample = ReadSample(golden.name);
    const SampleSummary summary = Summarize(sample);
    EXPECT_NEAR(summary.mean, golden.mean, kRounding * golden.sd)
        << golden.name;
    EXPECT_NEAR(summary.sd, golden.sd, kRounding * golden.sd) << golden.name;
    EXPECT_NEAR(KsDistanceFromNormal(sample, summary.mean, summary.sd),
                golden.d,
                kRounding)
        << golden.name;
    EXPECT_NEAR(
        KsDistanceFromNormal(sample, 0.0, 1.0), golden.d_standard, kRounding)
        << golden.name;
  }
}

TEST(KsProbabilityMeanSdGiven, AgreesWithScipyOnEverySample) {
  // Relative: the last sample's p is 2e-38, where d's last digit is worth
  // 4 n d = 1900 times itself.
  constexpr double kRelative = 1e-11;
  for (const GoldenKs& golden : GoldenSamples()) {
    const Index n = ReadSample(golden.name).size();
    EXPECT_NEAR(
        KsProbabilityMeanSdGiven(golden.d, n), golden.p, kRelative * golden.p)
        << golden.name;
  }
}

// The values that the report's Appendix B leads to without the loop-variable
// slip: mean 0.00507 um, sd 0.24112 um, D 0.03801 (as the golden files have
// them to all digits).
TEST(KsDistanceFromNormal, OfTheReportsOwnResidualsFindsThemNormal) {
  constexpr double kLastPrintedDigit = 0.5e-5;
  constexpr double kMicrometresPerMillimetre = 1000.0;
  const VectorXd residuals_um = kMicrometresPerMillimetre * AppendixB();
  const SampleSummary summary = Summarize(residuals_um);
  EXPECT_EQ(summary.n, 397);
  EXPECT_NEAR(summary.mean, 0.00507, kLastPrintedDigit);
  EXPECT_NEAR(summary.sd, 0.24112, kLastPrintedDigit);
  const double d = KsDistanceFromNormal(residuals_um, summary.mean, summary.sd);
  EXPECT_NEAR(d, 0.03801, kLastPrintedDigit);
  EXPECT_GT(KsProbabilityMeanSdGiven(d, summary.n), 0.5);
}

TEST(KsDistanceFromNormal, LooksAtBothSidesOfEveryStep) {
  // One value at the mean: the step from 0 to 1 is half a unit off either way.
  EXPECT_DOUBLE_EQ(KsDistanceFromNormal(VectorXd{{3.0}}, 3.0, 2.0), 0.5);
  // One value far out: the side below, and the side above, the step.
  EXPECT_NEAR(KsDistanceFromNormal(VectorXd{{40.0}}, 0.0, 1.0), 1.0, 1e-15);
  EXPECT_NEAR(KsDistanceFromNormal(VectorXd{{-40.0}}, 0.0, 1.0), 1.0, 1e-15);
  // Ties make one high step: 4 equal values at the mean.
  EXPECT_DOUBLE_EQ(KsDistanceFromNormal(VectorXd::Constant(4, 1.0), 1.0, 1.0),
                   0.5);
}

TEST(KsDistanceFromNormal, LiesBetweenHalfAStepAndOne) {
  Random random(5);
  for (const Index n : {1, 2, 3, 10, 100}) {
    VectorXd sample(n);
    for (double& value : sample) value = random.Uniform();
    const double d = KsDistanceFromNormal(sample, 0.5, 0.3);
    EXPECT_GE(d, 0.5 / static_cast<double>(n));
    EXPECT_LE(d, 1.0);
  }
}

TEST(KsDistanceFromNormal, KeepsItsInvariances) {
  constexpr double kRounding = 1e-14;
  const VectorXd sample = ReadSample("sample_t3_397");
  const double d = KsDistanceFromNormal(sample, 0.1, 1.4);
  EXPECT_EQ(KsDistanceFromNormal(sample.reverse(), 0.1, 1.4), d);
  const VectorXd moved = 1000.0 * sample.array() + 5.0;
  EXPECT_NEAR(KsDistanceFromNormal(moved, 105.0, 1400.0), d, kRounding);
  EXPECT_NEAR(KsDistanceFromNormal(-sample, -0.1, 1.4), d, kRounding);
}

TEST(KsDistanceFromNormal, IsNotANumberWhereNothingCanBeSaid) {
  const VectorXd sample{{1.0, 2.0}};
  EXPECT_TRUE(std::isnan(KsDistanceFromNormal(VectorXd(), 0.0, 1.0)));
  EXPECT_TRUE(std::isnan(KsDistanceFromNormal(sample, 0.0, 0.0)));
  EXPECT_TRUE(std::isnan(KsDistanceFromNormal(sample, 0.0, -1.0)));
  EXPECT_TRUE(std::isnan(KsDistanceFromNormal(sample, 0.0, std::nan(""))));
  EXPECT_TRUE(
      std::isnan(KsProbabilityMeanSdGiven(std::nan(""), sample.size())));
}

// Eq. 139 summed with 60 significant digits by Python's decimal module:
// 2 * sum((-1)**(j-1) * (-2*j*j*l*l).exp() for j in range(1, 400)).
TEST(KolmogorovComplement, AgreesWithTheSeriesInManyDigits) {
  struct Reference {
    double lambda;
    double q;
  };
  // A few units in the last place; the exponent's rounding grows with it.
  constexpr double kRelative = 3e-15;
  constexpr double kRelativePerExponent = 2e-16;
  for (const auto& [lambda, q] :
       std::vector<Reference>{{0.3, 9.9999069419866543337e-1},
                              {0.5, 9.6394524366487509439e-1},
                              {0.8, 5.4414241157419814900e-1},
                              {0.99, 2.8087383922554891197e-1},
                              {0.999999, 2.7000074362745641005e-1},
                              {1.0, 2.6999967167735452120e-1},
                              {1.000001, 2.6999859973033969547e-1},
                              {1.01, 2.5943416909359745207e-1},
                              {1.2, 1.1224966667072496091e-1},
                              {1.63, 9.8463648884865244086e-3},
                              {2.0, 6.7092525577969534654e-4},
                              {3.0, 3.0459959489425256872e-8},
                              {5.0, 3.8574996959278355660e-22}}) {
    const double exponent = 2.0 * lambda * lambda;
    EXPECT_NEAR(KolmogorovComplement(lambda),
                q,
                q * (kRelative + kRelativePerExponent * exponent))
        << lambda;
  }
}

TEST(KolmogorovComplement, FollowsTheSeriesAcrossTheCrossover) {
  // Cancellation costs the sum of the terms' sizes, below 2 / lambda here.
  constexpr double kRounding = 2e-15;
  constexpr int kTerms = 200;
  for (double lambda = 0.25; lambda < 2.5; lambda += 0.003) {
    long double sum = 0.0L;
    long double sign = 1.0L;
    for (int j = 1; j <= kTerms; ++j) {
      const long double root = static_cast<long double>(j) * lambda;
      sum += sign * std::exp(-2.0L * root * root);
      sign = -sign;
    }
    EXPECT_NEAR(KolmogorovComplement(lambda),
                static_cast<double>(2.0L * sum),
                kRounding)
        << lambda;
  }
}

TEST(KolmogorovComplement, FallsFromOneToZero) {
  EXPECT_EQ(KolmogorovComplement(0.0), 1.0);
  EXPECT_EQ(KolmogorovComplement(-1.0), 1.0);
  EXPECT_EQ(KolmogorovComplement(std::numeric_limits<double>::min()), 1.0);
  EXPECT_EQ(KolmogorovComplement(1e-3), 1.0);
  EXPECT_EQ(KolmogorovComplement(30.0), 0.0);
  EXPECT_EQ(KolmogorovComplement(kInfinity), 0.0);
  EXPECT_TRUE(std::isnan(KolmogorovComplement(std::nan(""))));
  double last = 1.0;
  for (double lambda = 0.0; lambda < 6.0; lambda += 0.0005) {
    const double q = KolmogorovComplement(lambda);
    EXPECT_LE(q, last) << lambda;
    EXPECT_GE(q, 0.0) << lambda;
    last = q;
  }
}

TEST(KolmogorovComplement, DoesNotJumpWhereItsFormsMeet) {
  // |Q'| is about 1.07 at 1: neighbours differ by one last place at most.
  constexpr double kLastPlaces = 4e-16;
  const double below = KolmogorovComplement(std::nextafter(1.0, 0.0));
  const double at = KolmogorovComplement(1.0);
  EXPECT_NEAR(below, at, kLastPlaces);
}

// In no order: sorting a NaN is undefined.
TEST(KsDistanceFromNormal, IsNotKnownWhereAValueIsNot) {
  VectorXd sample = VectorXd::LinSpaced(50, -2.0, 2.0);
  for (const Index at : {0, 20, 49}) {
    VectorXd unknown = sample;
    unknown[at] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(std::isnan(KsDistanceFromNormal(unknown, 0.0, 1.0)));
  }
  EXPECT_TRUE(std::isnan(KsDistanceFromNormal(
      sample, std::numeric_limits<double>::quiet_NaN(), 1.0)));
}

}  // namespace
}  // namespace errmap::stats
