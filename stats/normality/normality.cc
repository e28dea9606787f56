#include "stats/normality/normality.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "stats/kolmogorov_smirnov.h"
#include "stats/normality/bimodality.h"
#include "stats/normality/kolmogorov_exact.h"
#include "stats/normality/lilliefors.h"
#include "stats/normality/monte_carlo.h"
#include "stats/normality/simulated_quantiles.h"
#include "stats/random.h"

namespace errmap::stats {
namespace {

using Eigen::Index;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// A share of simulated samples at least as extreme as an observed one.
class Share {
 public:
  Share(const TestResult& observed, bool small_is_extreme)
      : observed_(observed.statistic),
        ok_(observed.ok()),
        sign_(small_is_extreme ? -1.0 : 1.0) {}

  void Add(const TestResult& simulated) {
    // Rounding must not part a sample from its own shifted copy.
    constexpr double kRounding = 1e-12;
    const double excess = sign_ * (simulated.statistic - observed_);
    if (excess >= -kRounding * std::abs(observed_)) ++count_;
  }

  double P(Index draws) const {
    return ok_ ? static_cast<double>(1 + count_) /
                     static_cast<double>(1 + draws)
               : kNaN;
  }

 private:
  double observed_;
  bool ok_;
  double sign_;
  Index count_ = 0;
};

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
  const std::string why_not = sample.WhyNotWith(kFewestSimulated);
  if (!why_not.empty()) {
    result->normal_ppcc = NotApplicable(why_not);
    return;
  }
  const double r = PlotCorrelation(sample.z(), normal_medians_);
  result->normal_ppcc = {
      .statistic = r,
      .p = SimulatedProbability(SimulatedStatistic::kNormalPpcc, 1.0 - r, n_)};
}

Normality NormalityTests::operator()(const OrderedSample& sample) const {
  if (sample.size() != n_) {
    throw std::invalid_argument("NormalityTests: made for " +
                                std::to_string(n_) + " values, found " +
                                std::to_string(sample.size()));
  }
  Normality result;
  Fill(sample, &result);
  if (sample.why_not().empty()) {
    const double d = KsDistanceFromStandardNormal(sample.z());
    result.ks = {.statistic = d, .p = KsProbabilityMeanSdGiven(d, n_)};
    result.ks_exact = {.statistic = d, .p = KsProbabilityExact(d, n_)};
    result.shape = ComputeShapeMoments(sample);
  } else {
    result.ks = result.ks_exact = NotApplicable(sample.why_not());
    result.shape = {.skewness = kNaN, .kurtosis = kNaN};
  }
  if (!result.normal_ppcc.ok()) {
    result.tukey_ppcc = result.dip = NotApplicable(result.normal_ppcc.why_not);
    return result;
  }
  result.curve = tukey_plot_.front().Curve(sample.z());
  result.tukey_ppcc = {
      .statistic = result.curve.best_r,
      .p = SimulatedProbability(
          SimulatedStatistic::kTukeyMaxPpcc, 1.0 - result.curve.best_r, n_)};
  const double dip = DipStatistic(sample.z());
  result.dip = {.statistic = dip, .p = DipProbability(dip, n_)};
  return result;
}

MonteCarloP NormalityTests::Simulate(const Normality& observed,
                                     Index draws,
                                     std::uint64_t seed) const {
  if (draws < 1) {
    throw std::invalid_argument(
        "NormalityTests::Simulate: needs at least 1 draw, found " +
        std::to_string(draws));
  }
  Share lilliefors(observed.lilliefors, false);
  Share shapiro_wilk(observed.shapiro_wilk, true);
  Share anderson_darling(observed.anderson_darling, false);
  Share jarque_bera(observed.jarque_bera, false);
  Share dagostino_pearson(observed.dagostino_pearson, false);
  Share normal_ppcc(observed.normal_ppcc, true);
  Random random(seed);
  for (Index draw = 0; draw < draws; ++draw) {
    Normality simulated;
    Fill(OrderedSample(NormalSample(n_, &random)), &simulated);
    lilliefors.Add(simulated.lilliefors);
    shapiro_wilk.Add(simulated.shapiro_wilk);
    anderson_darling.Add(simulated.anderson_darling);
    jarque_bera.Add(simulated.jarque_bera);
    dagostino_pearson.Add(simulated.dagostino_pearson);
    normal_ppcc.Add(simulated.normal_ppcc);
  }
  return {.draws = draws,
          .lilliefors = lilliefors.P(draws),
          .shapiro_wilk = shapiro_wilk.P(draws),
          .anderson_darling = anderson_darling.P(draws),
          .jarque_bera = jarque_bera.P(draws),
          .dagostino_pearson = dagostino_pearson.P(draws),
          .normal_ppcc = normal_ppcc.P(draws)};
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
