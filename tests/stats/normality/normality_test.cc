#include "stats/normality/normality.h"

#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "stats/normality/lilliefors.h"
#include "stats/random.h"
#include "tests/numbers.h"
#include "tests/places.h"
#include "tests/stats/golden_samples.h"

namespace errmap::stats {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Json = nlohmann::json;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// golden/normality.json: scipy 1.10.1, statsmodels 0.13.5, R 4.2.2.
const Json& Golden() {
  static const Json golden = [] {
    std::ifstream file(tests::TestDir() + "/golden/normality.json");
    return Json::parse(file)["data"];
  }();
  return golden;
}

Normality Assess(const VectorXd& values) {
  return AssessNormality(OrderedSample(values));
}

// Absolute for what is of size 1 or smaller, relative beyond.
void ExpectClose(double found,
                 double expected,
                 double tolerance,
                 const std::string& what) {
  EXPECT_NEAR(found, expected, tolerance * std::max(1.0, std::abs(expected)))
      << what;
}

TEST(Normality, ReproducesTheStatisticsOfEverySample) {
  constexpr double kStatistic = 1e-10;
  ASSERT_EQ(Golden().size(), GoldenSampleNames().size());
  for (const std::string& name : GoldenSampleNames()) {
    const Json& python = Golden()[name]["python"];
    const Json& r = Golden()[name]["R"];
    const Normality found = Assess(GoldenSample(name));
    ExpectClose(found.ks.statistic, r["lillie_D"], kStatistic, name);
    ExpectClose(found.lilliefors.statistic, r["lillie_D"], kStatistic, name);
    ExpectClose(found.anderson_darling.statistic, r["ad_A"], kStatistic, name);
    ExpectClose(found.jarque_bera.statistic,
                python["jarque_bera"][0],
                kStatistic,
                name);
    ExpectClose(found.dagostino_pearson.statistic,
                python["normaltest"][0],
                kStatistic,
                name);
    ExpectClose(found.shape.skewness, r["skew_b1"], kStatistic, name);
    ExpectClose(found.shape.kurtosis, r["kurt_b2"], kStatistic, name);
    ExpectClose(found.normal_ppcc.statistic,
                python["probplot_normal_r"],
                kStatistic,
                name);
  }
}

TEST(Normality, ReproducesThePOfEverySample) {
  constexpr double kRelative = 1e-8;
  for (const std::string& name : GoldenSampleNames()) {
    const Json& python = Golden()[name]["python"];
    const Json& r = Golden()[name]["R"];
    const Normality found = Assess(GoldenSample(name));
    const double asymptotic = python["kstest_fitted_asymp"][1];
    EXPECT_NEAR(found.ks.p, asymptotic, kRelative * asymptotic) << name;
    const double ad = r["ad_p"];
    EXPECT_NEAR(found.anderson_darling.p, ad, kRelative * ad) << name;
    const double jb = python["jarque_bera"][1];
    EXPECT_NEAR(found.jarque_bera.p, jb, kRelative * jb + 1e-300) << name;
    const double k2 = python["normaltest"][1];
    EXPECT_NEAR(found.dagostino_pearson.p, k2, kRelative * k2 + 1e-300) << name;
  }
}

// R's ks.test: good to about n units in the last place of 1.
TEST(Normality, ReproducesTheExactKsPOfEverySample) {
  constexpr double kAbsolute = 1e-11;
  for (const std::string& name : GoldenSampleNames()) {
    EXPECT_NEAR(Assess(GoldenSample(name)).ks_exact.p,
                Golden()[name]["R"]["ks_fitted_exact_p"].get<double>(),
                kAbsolute)
        << name;
  }
}

TEST(ShapiroWilk, ReproducesROnEverySample) {
  constexpr double kW = 1e-7;
  constexpr double kRelativeP = 1e-4;
  for (const std::string& name : GoldenSampleNames()) {
    const Json& r = Golden()[name]["R"];
    const Normality found = Assess(GoldenSample(name));
    const double p = r["shapiro_p"];
    EXPECT_NEAR(found.shapiro_wilk.statistic, r["shapiro_W"].get<double>(), kW)
        << name;
    EXPECT_NEAR(found.shapiro_wilk.p, p, kRelativeP * p) << name;
  }
}

// golden/normality/serial_reference.csv: x = 1, 4, 9 ... n^2.
TEST(ShapiroWilk, ReproducesROnSmallSamples) {
  struct Reference {
    Index n;
    double w;
    double p;
  };
  constexpr double kW = 1e-7;
  constexpr double kRelativeP = 1e-4;
  for (const Reference& r : std::vector<Reference>{
           {3, 0.97959183673469408, 0.72622630994205595},
           {5, 0.94982453465555883, 0.7359347808849005},
           {7, 0.93421051167723057, 0.5872501520049821},
           {11, 0.91863204475925186, 0.30741084749323166},
           {12, 0.91629244147428457, 0.25667346766162569},
           {50, 0.89812479966181002, 0.00041688515189459426}}) {
    const VectorXd x = VectorXd::LinSpaced(r.n, 1.0, static_cast<double>(r.n));
    // The test itself: AssessNormality takes whole numbers for rounded.
    const VectorXd squares = x.cwiseAbs2();
    const TestResult found = ShapiroWilkTest(r.n)(OrderedSample(squares));
    EXPECT_NEAR(found.statistic, r.w, kW) << r.n;
    EXPECT_NEAR(found.p, r.p, kRelativeP * r.p) << r.n;
  }
}

TEST(Lilliefors, PublishedFormulaIsThatOfNortest) {
  constexpr double kRelative = 1e-9;
  for (const std::string& name : GoldenSampleNames()) {
    const Json& r = Golden()[name]["R"];
    const double p = r["lillie_p"];
    if (p > 0.1) continue;  // nortest has another formula there
    EXPECT_NEAR(DallalWilkinsonProbability(r["lillie_D"], r["n"].get<Index>()),
                p,
                kRelative * p)
        << name;
  }
}

// golden/normality/lilliefors_monte_carlo.csv: a million samples by R for each
// n; their own error at p = 0.5 is 0.0005.
TEST(Lilliefors, PIsThatOfAMillionSamples) {
  constexpr double kPromised = 0.005;
  const std::string path =
      tests::TestDir() + "/golden/normality/lilliefors_monte_carlo.csv";
  const VectorXd n = ReadCsvColumn(path, "n");
  const VectorXd p = ReadCsvColumn(path, "p");
  const VectorXd d = ReadCsvColumn(path, "d");
  ASSERT_EQ(n.size(), 44);
  double worst = 0.0;
  for (Index i = 0; i < n.size(); ++i) {
    const double found = LillieforsProbability(d[i], static_cast<Index>(n[i]));
    EXPECT_NEAR(found, p[i], kPromised) << n[i] << " " << d[i];
    worst = std::max(worst, std::abs(found - p[i]));
  }
  RecordProperty("worst_difference", std::to_string(worst));
}

TEST(Lilliefors, BeyondTheTableFollowsThePublishedTail) {
  for (const Index n : {5, 20, 397, 5000, 100000}) {
    double last = 1.0;
    for (double z = 0.3; z < 4.0; z += 0.01) {
      const double p =
          LillieforsProbability(z / std::sqrt(static_cast<double>(n)), n);
      EXPECT_LE(p, last + 1e-12) << n << " " << z;
      last = p;
    }
    if (n > 5) {
      EXPECT_LT(last, 1e-20) << n;
    }
  }
}

// scipy's ppcc_max (Brent on all lambdas) and probplot.
TEST(TukeyPlot, FindsTheMaximumThatScipyFinds) {
  constexpr double kFlatTop = 2e-6;  // what a maximum of r can tell of lambda
  for (const std::string& name : GoldenSampleNames()) {
    const Json& python = Golden()[name]["python"];
    const Normality found = Assess(GoldenSample(name));
    EXPECT_NEAR(found.curve.best_lambda,
                python["ppcc_max_tukeylambda"].get<double>(),
                kFlatTop)
        << name;
    EXPECT_EQ(found.curve.lambda.size(), 81);
    EXPECT_EQ(found.curve.lambda[0], -2.0);
    EXPECT_EQ(found.curve.lambda[80], 2.0);
    EXPECT_GE(found.curve.best_r, found.curve.r.maxCoeff()) << name;
    EXPECT_GE(found.curve.best_r, found.curve.r_at_014) << name;
  }
}

TEST(TukeyPlot, IsStraightForItsOwnQuantiles) {
  constexpr double kRounding = 1e-14;
  constexpr Index kSize = 101;
  const TukeyPlot plot(kSize);
  const VectorXd p = UniformMedians(kSize);
  // lambda 1 and 2 are both uniform, 0 is the logistic.
  EXPECT_NEAR(plot.Correlation(p, 1.0), 1.0, kRounding);
  EXPECT_NEAR(plot.Correlation(p, 2.0), 1.0, kRounding);
  const VectorXd logistic = (p.array() / (1.0 - p.array())).log();
  EXPECT_NEAR(plot.Correlation(logistic, 0.0), 1.0, kRounding);
  // No step where the series about 0 takes over.
  const VectorXd x = NormalMedians(kSize);
  EXPECT_NEAR(plot.Correlation(x, 0.9e-5), plot.Correlation(x, 1.1e-5), 1e-6);
  EXPECT_NEAR(plot.Correlation(x, 0.0), plot.Correlation(x, 1e-6), 1e-6);
}

// Large samples are not tabulated: the same curve by another way.
TEST(TukeyPlot, GivesTheSameCurveWithAndWithoutItsTable) {
  constexpr double kRounding = 1e-13;
  for (const Index n : {2000, 2001}) {
    Random random(8);
    const OrderedSample sample(NormalSample(n, &random));
    const TukeyPlot plot(n);
    const TukeyPpcc curve = plot.Curve(sample.z());
    for (Index i = 0; i < curve.lambda.size(); ++i) {
      EXPECT_NEAR(
          curve.r[i], plot.Correlation(sample.z(), curve.lambda[i]), kRounding);
    }
  }
}

// NIST/SEMATECH e-Handbook, 1.3.3.21 and 1.3.3.22; simulated for n = 397.
TEST(CriticalPpcc, AreThoseSimulatedFor397Values) {
  constexpr double kPromised = 2e-4;
  EXPECT_NEAR(CriticalNormalPpcc(0.05, 397), 0.9963, kPromised);
  EXPECT_NEAR(CriticalNormalPpcc(0.01, 397), 0.9949, kPromised);
  EXPECT_NEAR(CriticalTukeyPpcc(0.05, 397), 0.9968, kPromised);
  EXPECT_NEAR(CriticalTukeyPpcc(0.01, 397), 0.9955, kPromised);
}

// Filliben (1975), Table 1, n = 4 ... 100, 5 % and 1 % points.
TEST(CriticalPpcc, AgreesWithFillibensTable) {
  constexpr double kHisSimulation = 0.003;
  EXPECT_NEAR(CriticalNormalPpcc(0.05, 10), 0.917, kHisSimulation);
  EXPECT_NEAR(CriticalNormalPpcc(0.05, 50), 0.977, kHisSimulation);
  EXPECT_NEAR(CriticalNormalPpcc(0.05, 100), 0.987, kHisSimulation);
  EXPECT_NEAR(CriticalNormalPpcc(0.01, 100), 0.981, kHisSimulation);
}

// What the report calls "near normality", its best correlation 0.9911880, is
// below what one normal sample in a hundred has.
TEST(CriticalPpcc, TheReportsBestCorrelationIsTooSmall) {
  constexpr double kReports = 0.9911880;
  EXPECT_LT(kReports, CriticalTukeyPpcc(0.01, 397));
  EXPECT_LT(kReports, CriticalNormalPpcc(0.01, 397));
}

TEST(Normality, DoesNotDependOnShiftScaleOrOrder) {
  constexpr double kRounding = 1e-9;
  const VectorXd x = GoldenSample("sample_t3_397");
  const Normality a = Assess(x);
  const VectorXd moved = 1024.0 * x.array() + 7.0;
  for (const VectorXd& other : {moved,
                                VectorXd(1e-200 * x),
                                VectorXd(1e200 * x),
                                VectorXd(x.reverse())}) {
    const Normality b = Assess(other);
    const std::pair<TestResult, TestResult> pairs[] = {
        {a.ks, b.ks},
        {a.ks_exact, b.ks_exact},
        {a.lilliefors, b.lilliefors},
        {a.shapiro_wilk, b.shapiro_wilk},
        {a.anderson_darling, b.anderson_darling},
        {a.jarque_bera, b.jarque_bera},
        {a.dagostino_pearson, b.dagostino_pearson},
        {a.normal_ppcc, b.normal_ppcc},
        {a.tukey_ppcc, b.tukey_ppcc},
        {a.dip, b.dip}};
    for (const auto& [one, two] : pairs) {
      ExpectClose(two.statistic, one.statistic, kRounding, "statistic");
      ExpectClose(two.p, one.p, kRounding, "p");
    }
  }
}

// Every test gives finite figures or says why not; never a NaN that passes for
// a figure.
TEST(Normality, SaysWhyWhereATestDoesNotApply) {
  const VectorXd samples[] = {
      VectorXd(),
      VectorXd{{1.0}},
      VectorXd{{1.0, 2.0}},
      VectorXd{{1.0, 2.0, 4.0}},
      VectorXd{{1.0, 2.0, 4.0, 4.0}},
      VectorXd{{1.0, 2.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0}},
      VectorXd::Constant(30, 0.1),
      VectorXd{{1.0, kInfinity, 2.0}},
      VectorXd{{1.0, std::nan(""), 2.0}},
      VectorXd{{0.0, 1e308, -1e308, 1e308, 3.0}},
      VectorXd{{5e-324, 0.0, 5e-324, 0.0}}};
  for (const VectorXd& sample : samples) {
    const Normality found = Assess(sample);
    for (const TestResult* test : {&found.ks,
                                   &found.ks_exact,
                                   &found.lilliefors,
                                   &found.shapiro_wilk,
                                   &found.anderson_darling,
                                   &found.jarque_bera,
                                   &found.dagostino_pearson,
                                   &found.normal_ppcc,
                                   &found.tukey_ppcc,
                                   &found.dip}) {
      SCOPED_TRACE(::testing::PrintToString(sample.transpose()));
      if (test->ok()) {
        EXPECT_TRUE(std::isfinite(test->statistic));
        EXPECT_GE(test->p, 0.0);
        EXPECT_LE(test->p, 1.0);
      } else {
        EXPECT_TRUE(std::isnan(test->p));
      }
    }
  }
  EXPECT_EQ(Assess(VectorXd()).lilliefors.why_not, "there are no values");
  EXPECT_EQ(Assess(VectorXd{{1.0}}).jarque_bera.why_not,
            "needs at least 2 values, found 1");
  EXPECT_EQ(Assess(VectorXd{{1.0, 2.0}}).shapiro_wilk.why_not,
            "needs at least 4 values, found 2");
  // Two equal ones of three would have p = 0 by Shapiro and Wilk.
  for (const VectorXd& three :
       {VectorXd{{1.0, 2.0, 4.0}}, VectorXd{{100.0, 101.0, 100.0}}}) {
    EXPECT_EQ(Assess(three).shapiro_wilk.why_not,
              "needs at least 4 values, found 3");
    EXPECT_FALSE(Assess(three).ks.ok());
  }
  EXPECT_EQ(Assess(VectorXd{{1.0, 2.0, 4.0}}).lilliefors.why_not,
            "needs at least 4 values, found 3");
  EXPECT_EQ(Assess(VectorXd::Constant(30, 0.1)).anderson_darling.why_not,
            "the values do not vary");
  EXPECT_EQ(Assess(VectorXd{{1.0, kInfinity}}).ks.why_not,
            "values that are not finite");
  Random random(1);
  EXPECT_EQ(Assess(NormalSample(5001, &random)).shapiro_wilk.why_not,
            "calibrated up to 5000 values, found 5001");
}

TEST(NormalityTests, RefusesASampleOfAnotherSize) {
  const NormalityTests tests(5);
  EXPECT_THAT(
      [&] {
        tests(OrderedSample(VectorXd{{1.0, 2.0}}));
      },
      ThrowsMessage<std::invalid_argument>(
          HasSubstr("made for 5 values, found 2")));
  EXPECT_THAT(
      [&] {
        tests.Simulate(
            OrderedSample(VectorXd{{1.0, 2.0, 4.0, 5.0, 7.0}}), {}, 0, 1);
      },
      ThrowsMessage<std::invalid_argument>(
          HasSubstr("needs at least 1 draw, found 0")));
}

TEST(NormalityTests, SimulatesTheSamePForTheSameSeed) {
  const VectorXd x = GoldenSample("sample_normal_20");
  const NormalityTests tests(20);
  const OrderedSample sample(x);
  const Normality found = tests(sample);
  const MonteCarloP one = tests.Simulate(sample, found, 500, 7);
  const MonteCarloP two = tests.Simulate(sample, found, 500, 7);
  EXPECT_EQ(one.draws, 500);
  EXPECT_EQ(one.jarque_bera, two.jarque_bera);
  EXPECT_NE(one.lilliefors, tests.Simulate(sample, found, 500, 8).lilliefors);
}

// The p of the tests that have a good one of their own, within what 20000
// draws leave (three standard deviations: 0.011).
TEST(NormalityTests, SimulatedPAgreesWithTheTestsOwn) {
  constexpr Index kDraws = 20000;
  constexpr double kThreeSigma = 0.011;
  const NormalityTests tests(20);
  for (const char* name : {"sample_normal_20", "sample_uniform_20"}) {
    const OrderedSample sample(GoldenSample(name));
    const Normality found = tests(sample);
    const MonteCarloP drawn = tests.Simulate(sample, found, kDraws, 3);
    EXPECT_NEAR(drawn.lilliefors, found.lilliefors.p, kThreeSigma);
    EXPECT_NEAR(drawn.shapiro_wilk, found.shapiro_wilk.p, kThreeSigma);
    EXPECT_NEAR(drawn.normal_ppcc, found.normal_ppcc.p, kThreeSigma);
  }
}

}  // namespace
}  // namespace errmap::stats
