#include "stats/comparison/signed_rank.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "stats/distributions.h"

namespace errmap::stats {
namespace {

struct Ranking {
  double positive = 0.0;  // sum of ranks of positive differences
  double ties = 0.0;      // sum of t^3 - t over groups of t equal magnitudes
};

// `sorted` ascends by magnitude and holds no 0; equal ones share a mean rank.
Ranking Rank(const std::vector<double>& sorted) {
  Ranking ranking;
  std::size_t begin = 0;
  while (begin < sorted.size()) {
    std::size_t end = begin + 1;
    while (end < sorted.size() &&
           std::abs(sorted[end]) == std::abs(sorted[begin])) {
      ++end;
    }
    const double t = static_cast<double>(end - begin);
    const double rank = 0.5 * static_cast<double>(begin + end + 1);
    ranking.ties += t * t * t - t;
    for (; begin < end; ++begin) {
      if (sorted[begin] > 0.0) ranking.positive += rank;
    }
  }
  return ranking;
}

// P(V <= v) for n differences without ties: each rank is in the sum or not.
double LowerTail(Index v, Index n) {
  std::vector<double> probability(static_cast<std::size_t>(v) + 1, 0.0);
  probability[0] = 1.0;
  for (Index rank = 1; rank <= n; ++rank) {
    for (Index sum = v; sum >= 0; --sum) {
      const std::size_t i = static_cast<std::size_t>(sum);
      const double with =
          sum >= rank ? probability[i - static_cast<std::size_t>(rank)] : 0.0;
      probability[i] = 0.5 * (probability[i] + with);
    }
  }
  double tail = 0.0;
  for (const double p : probability) tail += p;
  return tail;
}

double ExactP(double positive, Index n) {
  const double all = 0.5 * static_cast<double>(n * (n + 1));
  // V and all - V have the same distribution.
  const double smaller = std::min(positive, all - positive);
  return std::min(1.0, 2.0 * LowerTail(std::lround(smaller), n));
}

double NormalP(const Ranking& ranking, Index num) {
  const double n = static_cast<double>(num);
  const double variance =
      n * (n + 1.0) * (2.0 * n + 1.0) / 24.0 - ranking.ties / 48.0;
  const double off = std::abs(ranking.positive - 0.25 * n * (n + 1.0));
  constexpr double kContinuity = 0.5;
  if (off == 0.0) return 1.0;
  return std::min(1.0,
                  NormalTwoSided((off - kContinuity) / std::sqrt(variance)));
}

}  // namespace

SignedRankTest TestSignedRanks(const Eigen::Ref<const VectorXd>& differences) {
  SignedRankTest result;
  if (differences.size() == 0) {
    result.test = NotApplicable("no units");
    return result;
  }
  if (!differences.allFinite()) {
    result.test = NotApplicable("differences that are not finite");
    return result;
  }
  std::vector<double> sorted;
  for (const double difference : differences) {
    if (difference != 0.0) sorted.push_back(difference);
  }
  std::sort(sorted.begin(), sorted.end(), [](double a, double b) {
    return std::abs(a) < std::abs(b);
  });
  const Ranking ranking = Rank(sorted);
  const Index n = std::ssize(sorted);
  constexpr Index kFewestForNormal = 50;
  result.exact =
      n == differences.size() && ranking.ties == 0.0 && n < kFewestForNormal;
  result.test.statistic = ranking.positive;
  if (n == 0) {
    result.test.p = 1.0;
  } else {
    result.test.p =
        result.exact ? ExactP(ranking.positive, n) : NormalP(ranking, n);
  }
  return result;
}

}  // namespace errmap::stats
