#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "stats/normality/normality_tests.h"
#include "stats/normality/ordered_sample.h"
#include "stats/normality/probability_plot.h"
#include "stats/normality/shapiro_wilk.h"
#include "stats/test_result.h"

namespace errmap::stats {

/// All that is asked of a sample's shape. Each entry says why where it does
/// not apply, as below kFewestForShape; all but `ks_*` take mean and sd as
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
  ShapeMoments shape;      // NaN where the values do not vary
  TukeyPpcc curve;         // empty where tukey_ppcc does not apply
  /// Of rounded readings whose step is not small beside their scatter (grid.h),
  /// that step, in their unit; else 0. Ties make distances from a continuous
  /// distribution too large, so each p is then that of kGridDraws normal
  /// samples rounded alike, and `ks`, `ks_exact` have a statistic only.
  double step = 0.0;
};

inline constexpr Eigen::Index kGridDraws = 999;

/// Fewer values have no shape: of three, two equal ones reject at any level.
inline constexpr Eigen::Index kFewestForShape = 4;

/// Null distributions simulated for one size: the p of tests whose own p is
/// asymptotic or approximate, mean and sd estimated.
struct MonteCarloP {
  Eigen::Index draws = 0;  // 0: not asked for
  double lilliefors = 0.0;
  double shapiro_wilk = 0.0;
  double anderson_darling = 0.0;
  double jarque_bera = 0.0;
  double dagostino_pearson = 0.0;
  double normal_ppcc = 0.0;
};

/// The tests for samples of one size; what depends on the size only is made
/// once, so that simulations of thousands of samples are quick.
class NormalityTests {
 public:
  explicit NormalityTests(Eigen::Index n);

  /// Throws std::invalid_argument for a sample of another size.
  Normality operator()(const OrderedSample& sample) const;

  /// p = (1 + #{simulated at least as extreme}) / (draws + 1) of each test in
  /// `observed` among `draws` seeded normal samples, rounded as `sample` is;
  /// NaN where a test does not apply. Throws std::invalid_argument for draws <
  /// 1.
  MonteCarloP Simulate(const OrderedSample& sample,
                       const Normality& observed,
                       Eigen::Index draws,
                       std::uint64_t seed) const;

 private:
  Eigen::Index n_;
  ShapiroWilkTest shapiro_wilk_;
  Eigen::VectorXd normal_medians_;
  std::vector<TukeyPlot> tukey_plot_;  // one, or none for n < 4

  // What has a p of its own below; only these are simulated at will.
  void Fill(const OrderedSample& sample, Normality* result) const;
  // Tukey's family and the dip, which take longer.
  void FillSlow(const OrderedSample& sample, Normality* result) const;
  // Replaces p by those among samples of the same step (in sd).
  void CompareOnGrid(const OrderedSample& sample,
                     double step,
                     Normality* result) const;
};

/// NormalityTests of one sample.
Normality AssessNormality(const OrderedSample& sample);

/// Correlation of the normal (or the best of Tukey's family's) probability
/// plot that `share` of normal samples of n >= 4 values fall below: simulated,
/// see simulated_quantiles.h.
double CriticalNormalPpcc(double share, Eigen::Index n);
double CriticalTukeyPpcc(double share, Eigen::Index n);

}  // namespace errmap::stats
