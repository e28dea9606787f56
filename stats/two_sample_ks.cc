#include "stats/two_sample_ks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "stats/kolmogorov_smirnov.h"
#include "stats/not_a_number.h"

namespace errmap::stats {
namespace {

// |i/n - j/m| in whole steps of 1/(n m), so that equal distances are equal.
std::int64_t Steps(Index i, Index j, Index n, Index m) {
  return std::abs(static_cast<std::int64_t>(i) * m -
                  static_cast<std::int64_t>(j) * n);
}

struct Distance {
  std::int64_t steps = 0;
  /// By number of pooled values up to x: is there a gap after them? Inside a
  /// tie the distribution functions have no value of their own.
  std::vector<bool> ends_tie;
};

Distance FindDistance(const VectorXd& a, const VectorXd& b) {
  const Index n = a.size();
  const Index m = b.size();
  Distance distance;
  distance.ends_tie.assign(static_cast<std::size_t>(n + m) + 1, false);
  Index i = 0;
  Index j = 0;
  while (i < n || j < m) {
    const double x = j == m || (i < n && a[i] <= b[j]) ? a[i] : b[j];
    while (i < n && a[i] == x) ++i;
    while (j < m && b[j] == x) ++j;
    distance.ends_tie[static_cast<std::size_t>(i + j)] = true;
    distance.steps = std::max(distance.steps, Steps(i, j, n, m));
  }
  return distance;
}

// Probability that a random path from (0, 0) to (n, m) reaches the distance at
// a point that counts. All terms are positive, so small ones keep their digits.
double PathsThatReach(const Distance& distance, Index n, Index m) {
  const auto reached = [&](Index i, Index j) {
    return distance.ends_tie[static_cast<std::size_t>(i + j)] &&
           Steps(i, j, n, m) >= distance.steps;
  };
  VectorXd column = VectorXd::Zero(m + 1);  // for this i, by j
  for (Index i = 0; i <= n; ++i) {
    for (Index j = 0; j <= m; ++j) {
      if (reached(i, j)) {
        column[j] = 1.0;
        continue;
      }
      const double total = static_cast<double>(i + j);
      // The last step to (i, j) came from (i-1, j) in i of i + j cases.
      const double from_left =
          i > 0 ? static_cast<double>(i) / total * column[j] : 0.0;
      const double from_below =
          j > 0 ? static_cast<double>(j) / total * column[j - 1] : 0.0;
      column[j] = from_left + from_below;
    }
  }
  return column[m];
}

}  // namespace

TwoSampleKs ComputeTwoSampleKs(const Eigen::Ref<const VectorXd>& a,
                               const Eigen::Ref<const VectorXd>& b) {
  if (a.size() == 0 || b.size() == 0) {
    throw std::invalid_argument("ComputeTwoSampleKs: a sample has no values");
  }
  if (!a.allFinite() || !b.allFinite()) {
    throw std::invalid_argument(
        "ComputeTwoSampleKs: a value is not finite; leave such rows out");
  }
  VectorXd first = a;
  VectorXd second = b;
  std::sort(first.begin(), first.end());
  std::sort(second.begin(), second.end());
  const Distance distance = FindDistance(first, second);
  const double n = static_cast<double>(a.size());
  const double m = static_cast<double>(b.size());
  TwoSampleKs result;
  result.d = static_cast<double>(distance.steps) / (n * m);
  result.p_asymptotic =
      KolmogorovComplement(std::sqrt(n * m / (n + m)) * result.d);
  result.p_exact = n * m <= kMostPairsForExactKs
                       ? PathsThatReach(distance, a.size(), b.size())
                       : kNaN;
  return result;
}

}  // namespace errmap::stats
