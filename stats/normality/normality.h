#pragma once

#include <cstdint>
#include <vector>

#include "stats/eigen.h"
#include "stats/normality/normality_tests.h"
#include "stats/normality/ordered_sample.h"
#include "stats/normality/probability_plot.h"
#include "stats/normality/shapiro_wilk.h"
#include "stats/test_result.h"

namespace errmap::stats {

/// Results of all tests of a sample's shape. An entry that does not apply says
/// why, as all do below kFewestForShape. All but `ks_*` use mean and sd
/// estimated from the values.
struct Normality {
  TestResult ks;  // D from the normal with the sample's mean and sd; p: Eq. 140
                  // as if they had been given, asymptotic
  TestResult ks_exact;  // the same D; p exact for finite n
  TestResult lilliefors;
  TestResult shapiro_wilk;
  TestResult anderson_darling;
  TestResult jarque_bera;
  TestResult dagostino_pearson;
  TestResult normal_ppcc;  // r of the normal probability plot; p simulated
  TestResult tukey_ppcc;   // largest r over Tukey's family; p simulated
  TestResult dip;          // p of the null hypothesis of one mode
  ShapeMoments shape;      // NaN if the values do not vary
  TukeyPpcc curve;         // empty if tukey_ppcc does not apply
  /// Rounding step of the readings, in their unit, if it matters compared with
  /// their scatter (FindStep); else 0. Ties make distances from a continuous
  /// distribution too large. So each p then comes from kGridDraws normal
  /// samples rounded in the same way; `ks` and `ks_exact` have no p.
  double step = 0.0;
};

inline constexpr Index kGridDraws = 999;

/// Fewest values for a test of shape. Of three values, two equal ones would
/// reject at any level.
inline constexpr Index kFewestForShape = 4;

/// p from a simulated null distribution for one size, mean and sd estimated.
/// For tests whose own p is asymptotic or approximate.
struct MonteCarloP {
  Index draws = 0;  // 0: not simulated
  double lilliefors = 0.0;
  double shapiro_wilk = 0.0;
  double anderson_darling = 0.0;
  double jarque_bera = 0.0;
  double dagostino_pearson = 0.0;
  double normal_ppcc = 0.0;
};

/// The tests for samples of one size. Whatever depends only on the size is
/// computed once, so simulating thousands of samples is quick.
class NormalityTests {
 public:
  explicit NormalityTests(Index n);

  /// Throws std::invalid_argument if `sample` has another size.
  Normality operator()(const OrderedSample& sample) const;

  /// Returns p = (1 + #{simulated at least as extreme}) / (draws + 1) of each
  /// test in `observed` among `draws` seeded normal samples, rounded as
  /// `sample` is. NaN if a test does not apply. Throws std::invalid_argument if
  /// draws < 1.
  MonteCarloP Simulate(const OrderedSample& sample,
                       const Normality& observed,
                       Index draws,
                       std::uint64_t seed) const;

 private:
  Index n_;
  ShapiroWilkTest shapiro_wilk_;
  VectorXd normal_medians_;
  std::vector<TukeyPlot> tukey_plot_;  // one, or none for n < 4

  // Tests with a p of their own; only these are simulated on request.
  void Fill(const OrderedSample& sample, Normality* result) const;
  // Tukey's family and the dip, which are slower.
  void FillSlow(const OrderedSample& sample, Normality* result) const;
  // Replaces p by that among samples with the same step (in sd).
  void CompareOnGrid(const OrderedSample& sample,
                     double step,
                     Normality* result) const;
};

/// Runs NormalityTests on one sample.
Normality AssessNormality(const OrderedSample& sample);

/// Returns the critical correlation of the normal probability plot, or the
/// critical maximum over Tukey's family. A `share` of normal samples of n >= 4
/// values lies below it. Simulated, see simulated_quantiles.h.
double CriticalNormalPpcc(double share, Index n);
double CriticalTukeyPpcc(double share, Index n);

}  // namespace errmap::stats
