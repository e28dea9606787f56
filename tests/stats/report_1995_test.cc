#include "stats/report_1995.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stats/kolmogorov_smirnov.h"
#include "stats/random.h"
#include "stats/summary.h"
#include "tests/places.h"
#include "tests/stats/golden_samples.h"

namespace errmap::stats {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

VectorXd AppendixBInReport1995() { return errmap::AppendixB("residual_mm"); }

// NISTIR 5367, section 9 (the run without the dead thermocouples) and the run
// results of Appendix B: mean 0.0025278 um, sd 0.1701827 um, minimum -0.67104
// um, maximum 0.7603451 um, K-S D 0.0915280, probability 0.0025838.
TEST(Report1995, PrintsWhatTheReportPrintsForAppendixB) {
  constexpr double kMillimetresPerMicrometre = 1e-3;
  // The residuals are printed with four digits, the statistics come from all.
  constexpr double kOfMean = 1e-6;
  constexpr double kOfSd = 1e-5;
  constexpr double kOfExtremes = 0.5e-4;
  constexpr double kOfDistance = 2e-5;
  constexpr double kOfProbability = 1e-5;
  const Report1995Statistics printed =
      ComputeAsPrinted1995(AppendixBInReport1995());
  EXPECT_EQ(printed.n, 397);
  EXPECT_NEAR(printed.mean / kMillimetresPerMicrometre, 0.0025278, kOfMean);
  EXPECT_NEAR(printed.sd / kMillimetresPerMicrometre, 0.1701827, kOfSd);
  EXPECT_NEAR(printed.min / kMillimetresPerMicrometre, -0.67104, kOfExtremes);
  EXPECT_NEAR(printed.max / kMillimetresPerMicrometre, 0.7603451, kOfExtremes);
  EXPECT_NEAR(printed.ks_d, 0.0915280, kOfDistance);
  EXPECT_NEAR(printed.ks_probability, 0.0025838, kOfProbability);
}

// What this arithmetic gives on the shipped file, so that a change is seen.
TEST(Report1995, KeepsItsOwnFiguresOfAppendixB) {
  // Half of the last digit that is written down here.
  constexpr double kSixDecimals = 0.5e-6;
  constexpr double kFiveDecimals = 0.5e-5;
  constexpr double kMillimetresPerMicrometre = 1e-3;
  const Report1995Statistics printed =
      ComputeAsPrinted1995(AppendixBInReport1995());
  EXPECT_NEAR(printed.mean / kMillimetresPerMicrometre, 0.002528, kSixDecimals);
  EXPECT_NEAR(printed.sd / kMillimetresPerMicrometre, 0.17018, kFiveDecimals);
  EXPECT_NEAR(printed.ks_d, 0.09154, kFiveDecimals);
  EXPECT_NEAR(printed.ks_probability, 0.00258, kFiveDecimals);
}

TEST(Report1995, SaysNotNormalWhereTheCorrectArithmeticSaysNormal) {
  const VectorXd residuals = AppendixBInReport1995();
  const SampleSummary correct = Summarize(residuals);
  const Report1995Statistics printed = ComputeAsPrinted1995(residuals);
  const double d = KsDistanceFromNormal(residuals, correct.mean, correct.sd);
  EXPECT_LT(printed.ks_probability, 0.01);
  EXPECT_GT(KsProbabilityMeanSdGiven(d, correct.n), 0.5);
}

TEST(Report1995, HalvesTheMeanAndTakesARootOfTwoFromTheSd) {
  constexpr double kSingle = 1e-5;  // 397 additions in single precision
  const VectorXd residuals = AppendixBInReport1995();
  const SampleSummary correct = Summarize(residuals);
  const Report1995Statistics printed = ComputeAsPrinted1995(residuals);
  // Exactly: divisor 2 (n + 1), and squares about the halved mean.
  const double n = static_cast<double>(correct.n);
  const double divisor = 2.0 * (n + 1.0);
  const double mean = correct.mean * n / divisor;
  const double offset = correct.mean - mean;
  const double sd =
      std::sqrt(((n - 1.0) * correct.sd * correct.sd + n * offset * offset) /
                (divisor - 1.0));
  EXPECT_NEAR(printed.mean, mean, kSingle * correct.sd);
  EXPECT_NEAR(printed.sd, sd, kSingle * correct.sd);
  EXPECT_NEAR(printed.sd, correct.sd / std::sqrt(2.0), 0.01 * correct.sd);
  // Minimum and maximum are right, but for single precision.
  EXPECT_EQ(printed.min, static_cast<double>(static_cast<float>(correct.min)));
  EXPECT_EQ(printed.max, static_cast<double>(static_cast<float>(correct.max)));
}

// By hand for the one residual 4: divisor 2 (1 + 1) = 4, mean 1, sd
// sqrt(9 / 3), z = sqrt(3), D = Phi(sqrt(3)) = 0.9583677, Q(D) = 0.3173211
// (Python: math.erfc and the alternating series in double precision).
TEST(Report1995, FollowsTheProgramOnOneResidual) {
  constexpr double kSingle = 2e-6;  // its error function is good to 1.2e-7
  // The series is cut at the first term below a thousandth of the last.
  constexpr double kSeriesCut = 1e-3 * 0.32;
  const Report1995Statistics printed = ComputeAsPrinted1995(VectorXd{{4.0}});
  EXPECT_EQ(printed.n, 1);
  EXPECT_EQ(printed.mean, 1.0);
  EXPECT_NEAR(printed.sd, std::sqrt(3.0), kSingle);
  EXPECT_EQ(printed.min, 4.0);
  EXPECT_EQ(printed.max, 4.0);
  EXPECT_NEAR(printed.ks_d, 0.9583677, kSingle);
  EXPECT_NEAR(printed.ks_probability, 0.3173211, kSeriesCut);
}

TEST(Report1995, KeepsItsInvariances) {
  // Row order only matters through single precision sums; powers of two and
  // the sign change no digit at all.
  constexpr double kSingle = 1e-5;
  const VectorXd residuals = AppendixBInReport1995();
  const Report1995Statistics plain = ComputeAsPrinted1995(residuals);
  const Report1995Statistics reversed =
      ComputeAsPrinted1995(residuals.reverse());
  EXPECT_NEAR(reversed.mean, plain.mean, kSingle * plain.sd);
  EXPECT_NEAR(reversed.sd, plain.sd, kSingle * plain.sd);
  EXPECT_NEAR(reversed.ks_d, plain.ks_d, kSingle);

  const Report1995Statistics scaled = ComputeAsPrinted1995(1024.0 * residuals);
  EXPECT_EQ(scaled.mean, 1024.0 * plain.mean);
  EXPECT_EQ(scaled.sd, 1024.0 * plain.sd);
  EXPECT_EQ(scaled.ks_d, plain.ks_d);
  EXPECT_EQ(scaled.ks_probability, plain.ks_probability);

  const Report1995Statistics negated = ComputeAsPrinted1995(-residuals);
  EXPECT_EQ(negated.mean, -plain.mean);
  EXPECT_EQ(negated.sd, plain.sd);
  EXPECT_NEAR(negated.ks_d, plain.ks_d, kSingle);
}

TEST(Report1995, ProbabilityFollowsEq139DownToWhereItsSeriesIsCut) {
  constexpr double kSeriesCut = 1e-3;  // of the last term, which is below one
  Random random(3);
  for (const Index n : {2, 3, 10, 100}) {
    VectorXd sample(n);
    for (double& value : sample) value = random.Uniform() - 0.5;
    const Report1995Statistics printed = ComputeAsPrinted1995(sample);
    const double lambda = std::sqrt(static_cast<double>(n)) * printed.ks_d;
    EXPECT_NEAR(
        printed.ks_probability, KolmogorovComplement(lambda), kSeriesCut)
        << n;
  }
}

TEST(Report1995, RefusesNoResiduals) {
  EXPECT_THAT([] { ComputeAsPrinted1995(VectorXd()); },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("StatisticsOf1995: no residuals")));
}

// Appendix B: "R-SQ of nonlinear fit = 0.9961917". The residuals are printed
// to more digits than the measured errors, so the target is made from them.
TEST(Report1995, PrintsTheRSquaredOfAppendixB) {
  constexpr double kOfFourDigits = 5e-6;
  const std::string path =
      tests::SourceDir() + "/data/sets/nistir5367_appendix_b.csv";
  const VectorXd predicted = ReadCsvColumn(path, "predicted_mm");
  EXPECT_NEAR(
      RSquaredAsPrinted1995(predicted + AppendixBInReport1995(), predicted),
      0.9961917,
      kOfFourDigits);
  EXPECT_THAT([&] { RSquaredAsPrinted1995(VectorXd(), VectorXd()); },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("as many predictions as targets")));
}

// Its search for the extremes begins at 1e20 and 1e-20.
TEST(Report1995, NeverPrintsANegativeMaximum) {
  const Report1995Statistics printed =
      ComputeAsPrinted1995(VectorXd{{-3.0, -1.0, -2.0}});
  EXPECT_EQ(printed.max, static_cast<double>(1e-20F));
  EXPECT_EQ(printed.min, -3.0);
}

}  // namespace
}  // namespace errmap::stats
