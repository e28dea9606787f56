#include "stats/normality/normality.h"

#include <cmath>
#include <span>
#include <string>

#include "stats/kolmogorov_smirnov.h"
#include "stats/normality/bimodality.h"
#include "stats/normality/kolmogorov_exact.h"
#include "stats/normality/lilliefors.h"
#include "stats/normality/ordered_sample.h"
#include "stats/normality/simulated_quantiles.h"
#include "stats/not_a_number.h"
#include "stats/random.h"
#include "stats/require.h"

namespace errmap::stats {
namespace {

// A test whose p can be simulated, and which of its ends is extreme.
struct SimulatedTest {
  TestResult Normality::*test;
  bool small_is_extreme;
};

// The last two take longer.
constexpr SimulatedTest kTests[] = {{&Normality::lilliefors, false},
                                    {&Normality::shapiro_wilk, true},
                                    {&Normality::anderson_darling, false},
                                    {&Normality::jarque_bera, false},
                                    {&Normality::dagostino_pearson, false},
                                    {&Normality::normal_ppcc, true},
                                    {&Normality::tukey_ppcc, true},
                                    {&Normality::dip, false}};
constexpr std::size_t kQuickTests = 6;

// A share of simulated samples at least as extreme as an observed one.
class Share {
 public:
  Share(const SimulatedTest& simulated, const Normality& observed)
      : test_(simulated.test),
        observed_((observed.*test_).statistic),
        ok_((observed.*test_).ok()),
        sign_(simulated.small_is_extreme ? -1.0 : 1.0) {}

  void Add(const Normality& simulated) {
    // Rounding must not part a sample from its own shifted copy.
    constexpr double kRounding = 1e-12;
    const double excess = sign_ * ((simulated.*test_).statistic - observed_);
    if (excess >= -kRounding * std::abs(observed_)) ++count_;
  }

  double P(Index draws) const {
    return ok_ ? static_cast<double>(1 + count_) /
                     static_cast<double>(1 + draws)
               : kNaN;
  }

  void PutP(Index draws, Normality* result) const {
    if (ok_) (result->*test_).p = P(draws);
  }

 private:
  TestResult Normality::*test_;
  double observed_;
  bool ok_;
  double sign_;
  Index count_ = 0;
};

// Normal samples of one size, rounded as an observed one is whose `step` (in
// its sd; 0: not rounded) has a grid through its smallest value.
class NormalSamples {
 public:
  NormalSamples(const OrderedSample& like, double step, std::uint64_t seed)
      : n_(like.size()), step_(step), random_(seed) {
    if (step_ == 0.0) return;
    origin_ = like.z()[0];
    // Rounding adds step^2 / 12 to the variance (Sheppard 1898).
    constexpr double kOfRounding = 12.0;
    sd_ = std::sqrt(1.0 - step_ * step_ / kOfRounding);
  }

  // One that varies, as the observed one does.
  OrderedSample Draw() {
    for (;;) {
      VectorXd sample = NormalSample(n_, &random_);
      if (step_ > 0.0) {
        sample = origin_ +
                 step_ * ((sd_ * sample.array() - origin_) / step_).round();
      }
      OrderedSample drawn(sample);
      if (drawn.why_not().empty()) return drawn;
    }
  }

 private:
  Index n_;
  double step_;
  Random random_;
  double origin_ = 0.0;
  double sd_ = 1.0;
};

// The step of `sample` in its sd; 0: it has none that matters.
double StepOf(const OrderedSample& sample) {
  return sample.why_not().empty() ? FindStep(sample.z()).value_or(0.0) : 0.0;
}

void LeaveOut(const std::string& why, Normality* result) {
  for (const SimulatedTest& simulated : kTests) {
    result->*simulated.test = NotApplicable(why);
  }
}

}  // namespace

NormalityTests::NormalityTests(Index n) : n_(n), shapiro_wilk_(n) {
  if (n < kFewestSimulated) return;
  normal_medians_ = NormalMedians(n);
  tukey_plot_.emplace_back(n);
}

void NormalityTests::Fill(const OrderedSample& sample,
                          Normality* result) const {
  result->lilliefors = Lilliefors(sample);
  result->shapiro_wilk = shapiro_wilk_(sample);
  result->anderson_darling = AndersonDarling(sample);
  result->jarque_bera = JarqueBera(sample);
  result->dagostino_pearson = DAgostinoPearson(sample);
  const double r = PlotCorrelation(sample.z(), normal_medians_);
  result->normal_ppcc = {
      .statistic = r,
      .p = SimulatedProbability(SimulatedStatistic::kNormalPpcc, 1.0 - r, n_)};
}

void NormalityTests::FillSlow(const OrderedSample& sample,
                              Normality* result) const {
  result->curve = tukey_plot_.front().Curve(sample.z());
  result->tukey_ppcc = {
      .statistic = result->curve.best_r,
      .p = SimulatedProbability(
          SimulatedStatistic::kTukeyMaxPpcc, 1.0 - result->curve.best_r, n_)};
  const double dip = DipStatistic(sample.z());
  result->dip = {.statistic = dip, .p = DipProbability(dip, n_)};
}

void NormalityTests::CompareOnGrid(const OrderedSample& sample,
                                   double step,
                                   Normality* result) const {
  for (TestResult* given : {&result->ks, &result->ks_exact}) {
    given->p = kNaN;
    given->why_not = "for values without steps";
  }
  constexpr double kCoarsest = 2.0;
  constexpr Index kMost = 5000;
  if (step > kCoarsest || n_ > kMost) {
    LeaveOut(step > kCoarsest ? "steps as wide as the scatter"
                              : "too many rounded values to simulate",
             result);
    return;
  }
  std::vector<Share> shares;
  for (const SimulatedTest& simulated : kTests) {
    shares.emplace_back(simulated, *result);
  }
  NormalSamples samples(sample, step, 1);
  for (Index draw = 0; draw < kGridDraws; ++draw) {
    const OrderedSample drawn = samples.Draw();
    Normality simulated;
    Fill(drawn, &simulated);
    FillSlow(drawn, &simulated);
    for (Share& share : shares) share.Add(simulated);
  }
  for (const Share& share : shares) share.PutP(kGridDraws, result);
}

Normality NormalityTests::operator()(const OrderedSample& sample) const {
  Require(sample.size() == n_,
          "NormalityTests: made for " + std::to_string(n_) + " values",
          sample.size());
  Normality result;
  const std::string why_not = sample.WhyNotWith(kFewestForShape);
  if (!why_not.empty()) {
    result.ks = result.ks_exact = NotApplicable(why_not);
    LeaveOut(why_not, &result);
    result.shape = sample.why_not().empty()
                       ? ComputeShapeMoments(sample)
                       : ShapeMoments{.skewness = kNaN, .kurtosis = kNaN};
    return result;
  }
  Fill(sample, &result);
  FillSlow(sample, &result);
  const double d = KsDistanceFromStandardNormal(sample.z());
  result.ks = {.statistic = d, .p = KsProbabilityMeanSdGiven(d, n_)};
  result.ks_exact = {.statistic = d, .p = KsProbabilityExact(d, n_)};
  result.shape = ComputeShapeMoments(sample);
  if (const double step = StepOf(sample); step > 0.0) {
    result.step = step * sample.summary().sd;
    CompareOnGrid(sample, step, &result);
  }
  return result;
}

MonteCarloP NormalityTests::Simulate(const OrderedSample& sample,
                                     const Normality& observed,
                                     Index draws,
                                     std::uint64_t seed) const {
  Require(draws >= 1, "NormalityTests::Simulate: needs at least 1 draw", draws);
  std::vector<Share> shares;
  for (const SimulatedTest& simulated : std::span(kTests).first(kQuickTests)) {
    shares.emplace_back(simulated, observed);
  }
  NormalSamples samples(sample, StepOf(sample), seed);
  const bool any_applies = n_ >= kFewestForShape && sample.why_not().empty();
  for (Index draw = 0; any_applies && draw < draws; ++draw) {
    Normality simulated;
    Fill(samples.Draw(), &simulated);
    for (Share& share : shares) share.Add(simulated);
  }
  return {.draws = draws,
          .lilliefors = shares[0].P(draws),
          .shapiro_wilk = shares[1].P(draws),
          .anderson_darling = shares[2].P(draws),
          .jarque_bera = shares[3].P(draws),
          .dagostino_pearson = shares[4].P(draws),
          .normal_ppcc = shares[5].P(draws)};
}

Normality AssessNormality(const OrderedSample& sample) {
  return NormalityTests(sample.size())(sample);
}

double CriticalNormalPpcc(double share, Index n) {
  return 1.0 -
         SimulatedCriticalValue(SimulatedStatistic::kNormalPpcc, share, n);
}

double CriticalTukeyPpcc(double share, Index n) {
  return 1.0 -
         SimulatedCriticalValue(SimulatedStatistic::kTukeyMaxPpcc, share, n);
}

}  // namespace errmap::stats
