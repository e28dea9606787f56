#include "stats/comparison/point_optimal.h"

#include <algorithm>
#include <cmath>

#include "stats/random.h"

namespace errmap::stats {
namespace {

// Logarithm of the ratio of the two likelihoods, but for a constant.
double Statistic(const VectorXd& series, double memory) {
  constexpr double kMean = 1.5;  // in standard deviations
  const VectorXd x = series / series.cwiseAbs().maxCoeff();
  const Index n = x.size();
  const auto count = static_cast<double>(n);
  const double sum = x.sum();
  const double squares = x.squaredNorm();
  const double fresh = (x.tail(n - 1) - memory * x.head(n - 1)).squaredNorm();
  const double with_memory = x[0] * x[0] + fresh / (1.0 - memory * memory);
  const double shift = kMean * sum;
  const double scale =
      (std::sqrt(shift * shift + 4.0 * count * squares) - shift) /
      (2.0 * count);
  return 0.5 * count * std::log(with_memory) - count * std::log(scale) -
         (0.5 * squares / scale - shift) / scale;
}

}  // namespace

PointOptimalTest::PointOptimalTest(Index size,
                                   double memory,
                                   Index draws,
                                   std::uint64_t seed)
    : memory_(memory) {
  Random random(seed);
  for (Index draw = 0; draw < draws; ++draw) {
    drawn_.push_back(
        Statistic(AutoregressionSample(size, memory, &random), memory));
  }
}

double PointOptimalTest::P(const VectorXd& series) const {
  const double found = Statistic(series, memory_);
  const auto above = std::ranges::count_if(
      drawn_, [&](double drawn) { return drawn >= found; });
  return static_cast<double>(above + 1) /
         static_cast<double>(drawn_.size() + 1);
}

}  // namespace errmap::stats
