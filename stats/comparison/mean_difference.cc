#include "stats/comparison/mean_difference.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "stats/distributions.h"

namespace errmap::stats {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

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

MeanDifferenceTest MakeTest(double t, double degrees_of_freedom) {
  return {.test = {.statistic = t, .p = StudentTwoSided(t, degrees_of_freedom)},
          .degrees_of_freedom = degrees_of_freedom};
}

}  // namespace

MeanDifferenceTest CorrectedResampledT(
    const Eigen::Ref<const VectorXd>& fold_differences, double test_to_train) {
  if (!(test_to_train >= 0.0 && std::isfinite(test_to_train))) {
    throw std::invalid_argument(
        "CorrectedResampledT: test_to_train must be finite and at least 0, "
        "found " +
        std::to_string(test_to_train));
  }
  constexpr Index kFewest = 2;
  MeanDifferenceTest result;
  const std::string why_not = WhyNot(fold_differences, kFewest, "folds");
  if (!why_not.empty()) {
    result.test = NotApplicable(why_not);
    return result;
  }
  // Brought to size 1: squares of very small losses would be lost.
  const double scale = fold_differences.cwiseAbs().maxCoeff();
  const double folds = static_cast<double>(fold_differences.size());
  if (scale == 0.0) return MakeTest(0.0, folds - 1.0);
  const VectorXd d = fold_differences / scale;
  const double variance = (d.array() - d.mean()).square().sum() / (folds - 1.0);
  return MakeTest(
      d.mean() / std::sqrt((1.0 / folds + test_to_train) * variance),
      folds - 1.0);
}

MeanDifferenceTest DieboldMariano(
    const Eigen::Ref<const VectorXd>& differences) {
  constexpr Index kFewest = 2;
  MeanDifferenceTest result;
  const std::string why_not = WhyNot(differences, kFewest, "units");
  if (!why_not.empty()) {
    result.test = NotApplicable(why_not);
    return result;
  }
  const double scale = differences.cwiseAbs().maxCoeff();
  const double n = static_cast<double>(differences.size());
  if (scale == 0.0) return MakeTest(0.0, n - 1.0);
  const VectorXd d = differences / scale;
  const VectorXd deviations = d.array() - d.mean();
  const double variance = deviations.squaredNorm() / n;
  // Harvey, Leybourne & Newbold (1997), Eq. 9.
  const double correction = std::sqrt((n - 1.0) / n);
  return MakeTest(correction * d.mean() / std::sqrt(variance / n), n - 1.0);
}

}  // namespace errmap::stats
