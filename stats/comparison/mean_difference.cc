#include "stats/comparison/mean_difference.h"

#include <cmath>
#include <string>

#include "stats/distributions.h"
#include "stats/require.h"

namespace errmap::stats {
namespace {

// Why no t can be made of `d`, or "".
std::string WhyNot(const VectorXd& d, Index fewest, const std::string& what) {
  if (d.size() < fewest) {
    return "needs at least " + std::to_string(fewest) + " " + what +
           ", found " + std::to_string(d.size());
  }
  if (!d.allFinite()) return "differences that are not finite";
  if (d[0] != 0.0 && d.minCoeff() == d.maxCoeff()) {
    return "the differences do not vary";
  }
  return "";
}

// The test by t_of(differences), which have size 1 then: squares of very small
// losses would be lost.
template <typename Statistic>
MeanDifferenceTest TestMean(const VectorXd& differences,
                            const std::string& what,
                            const Statistic& t_of) {
  constexpr Index kFewest = 2;
  const std::string why_not = WhyNot(differences, kFewest, what);
  if (!why_not.empty()) return {.test = NotApplicable(why_not)};
  const double scale = differences.cwiseAbs().maxCoeff();
  const double freedom = static_cast<double>(differences.size()) - 1.0;
  const double t = scale == 0.0 ? 0.0 : t_of(VectorXd(differences / scale));
  return {.test = {.statistic = t, .p = StudentTwoSided(t, freedom)},
          .degrees_of_freedom = freedom};
}

}  // namespace

MeanDifferenceTest CorrectedResampledT(
    const Eigen::Ref<const VectorXd>& fold_differences, double test_to_train) {
  Require(test_to_train >= 0.0 && std::isfinite(test_to_train),
          "CorrectedResampledT: test_to_train must be finite and at least 0",
          test_to_train);
  return TestMean(fold_differences, "folds", [&](const VectorXd& d) {
    const double folds = static_cast<double>(d.size());
    const double variance =
        (d.array() - d.mean()).square().sum() / (folds - 1.0);
    return d.mean() / std::sqrt((1.0 / folds + test_to_train) * variance);
  });
}

MeanDifferenceTest DieboldMariano(
    const Eigen::Ref<const VectorXd>& differences) {
  return TestMean(differences, "units", [](const VectorXd& d) {
    const double n = static_cast<double>(d.size());
    const VectorXd deviations = d.array() - d.mean();
    const double variance = deviations.squaredNorm() / n;
    // Harvey, Leybourne & Newbold (1997), Eq. 9.
    const double correction = std::sqrt((n - 1.0) / n);
    return correction * d.mean() / std::sqrt(variance / n);
  });
}

}  // namespace errmap::stats
