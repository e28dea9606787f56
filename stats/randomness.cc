#include "stats/randomness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>

#include "stats/distributions.h"
#include "stats/not_a_number.h"
#include "stats/order_statistic.h"
#include "stats/random.h"
#include "stats/require.h"
#include "stats/two_sample_ks.h"

namespace errmap::stats {
namespace {

Index NumValues(const Segments& segments) {
  Index n = 0;
  for (const VectorXd& segment : segments) n += segment.size();
  return n;
}

VectorXd Pool(const Segments& segments) {
  VectorXd all(NumValues(segments));
  Index begin = 0;
  for (const VectorXd& segment : segments) {
    all.segment(begin, segment.size()) = segment;
    begin += segment.size();
  }
  return all;
}

double MedianOf(VectorXd values) {
  const Index middle = values.size() / 2;
  std::nth_element(values.begin(), values.begin() + middle, values.end());
  const double upper = values[middle];
  if (values.size() % 2 == 1) return upper;
  const double lower =
      *std::max_element(values.begin(), values.begin() + middle);
  return lower + 0.5 * (upper - lower);
}

double LogChoose(Index n, Index k) {
  if (k < 0 || k > n) return -std::numeric_limits<double>::infinity();
  return static_cast<double>(LogFactorial(n) - LogFactorial(k) -
                             LogFactorial(n - k));
}

// P(runs = r) for counts a, b >= 1 in random order.
double RunsProbability(Index runs, Index a, Index b) {
  const double log_all = LogChoose(a + b, a);
  const Index half = runs / 2;
  const auto term = [&](Index of_a, Index of_b) {
    return std::exp(LogChoose(a - 1, of_a - 1) + LogChoose(b - 1, of_b - 1) -
                    log_all);
  };
  return runs % 2 == 0 ? 2.0 * term(half, half)
                       : term(half, half + 1) + term(half + 1, half);
}

double ExactRunsP(Index runs, Index a, Index b) {
  double few = 0.0;
  double many = 0.0;
  const Index most = 2 * std::min(a, b) + (a == b ? 0 : 1);
  for (Index r = 2; r <= most; ++r) {
    const double p = RunsProbability(r, a, b);
    if (r <= runs) few += p;
    if (r >= runs) many += p;
  }
  return std::min(1.0, 2.0 * std::min(few, many));
}

void TestRuns(const Segments& segments, double median, SerialTests* tests) {
  double expected = 0.0;
  double variance = 0.0;
  Index runs = 0;
  Index above = 0;
  Index below = 0;
  for (const VectorXd& segment : segments) {
    Index segment_above = 0;
    Index segment_below = 0;
    int last = 0;
    for (const double value : segment) {
      if (value == median) continue;
      const int side = value > median ? 1 : -1;
      ++(side > 0 ? segment_above : segment_below);
      if (side != last) ++runs;
      last = side;
    }
    above += segment_above;
    below += segment_below;
    const double a = static_cast<double>(segment_above);
    const double b = static_cast<double>(segment_below);
    const double n = a + b;
    if (n == 0.0) continue;
    expected += 1.0 + 2.0 * a * b / n;
    if (n > 1.0) {
      variance += 2.0 * a * b * (2.0 * a * b - n) / (n * n * (n - 1.0));
    }
  }
  tests->num_runs = runs;
  tests->expected_runs = expected;
  if (!(variance > 0.0)) {
    tests->runs = NotApplicable("too few values on both sides of the median");
    return;
  }
  constexpr Index kMostForExact = 10;
  const double z = (static_cast<double>(runs) - expected) / std::sqrt(variance);
  tests->runs = {
      .statistic = z,
      .p = segments.size() == 1 && std::min(above, below) <= kMostForExact
               ? ExactRunsP(runs, above, below)
               : NormalTwoSided(z)};
}

// Variance of the lag-k autocorrelation of n independent normal values (Dufour
// & Roy 1985).
double LagVariance(double n, double k) {
  return (std::pow(n, 4) - (k + 3.0) * std::pow(n, 3) + 3.0 * k * n * n +
          2.0 * k * (k + 1.0) * n - 4.0 * k * k) /
         ((n + 1.0) * n * n * (n - 1.0) * (n - 1.0));
}

// The lag-k autocorrelation of all segments together. Given the segments' sums
// of squares, which for normal values tell nothing of the order, its mean and
// variance add up.
struct LagCorrelation {
  double r = 0.0;
  double expected = 0.0;
  double score = 0.0;
  bool ok = false;
};

LagCorrelation Correlate(const Segments& deviations, Index lag) {
  double products = 0.0;
  double squares = 0.0;
  double expected = 0.0;
  double variance = 0.0;
  for (const VectorXd& d : deviations) {
    const Index size = d.size();
    const double n = static_cast<double>(size);
    const double k = static_cast<double>(lag);
    const double of_segment = d.squaredNorm();
    squares += of_segment;
    if (size <= lag + 1) continue;
    products += d.head(size - lag).dot(d.tail(size - lag));
    expected -= of_segment * (n - k) / (n * (n - 1.0));
    variance += of_segment * of_segment * std::max(0.0, LagVariance(n, k));
  }
  LagCorrelation result;
  if (!(squares > 0.0 && variance > 0.0)) return result;
  result.ok = true;
  result.r = products / squares;
  result.expected = expected / squares;
  result.score = (products - expected) / std::sqrt(variance);
  return result;
}

TestResult TestDurbinWatson(const Segments& deviations) {
  double steps = 0.0;
  double squares = 0.0;
  double variance = 0.0;
  for (const VectorXd& d : deviations) {
    if (d.size() < 2) continue;
    const double n = static_cast<double>(d.size());
    const double of_segment = d.squaredNorm();
    steps += (d.tail(d.size() - 1) - d.head(d.size() - 1)).squaredNorm();
    squares += of_segment;
    variance += of_segment * of_segment * 4.0 * (n - 2.0) / (n * n - 1.0);
  }
  if (!(variance > 0.0)) return NotApplicable("too few values");
  return {.statistic = steps / squares,
          .p = NormalTwoSided((steps - 2.0 * squares) / std::sqrt(variance))};
}

Index NumLags(const Segments& segments) {
  constexpr Index kMostLags = 10;
  if (segments.size() == 1) {
    return std::clamp<Index>(segments.front().size() / 5, 1, kMostLags);
  }
  std::vector<Index> lengths;
  for (const VectorXd& segment : segments) lengths.push_back(segment.size());
  return std::clamp<Index>(UpperMedian(std::move(lengths)) / 2, 1, kMostLags);
}

TestResult TestLjungBox(const Segments& deviations, Index num_lags) {
  const bool whole = deviations.size() == 1;
  double q = 0.0;
  Index used = 0;
  for (Index lag = 1; lag <= num_lags; ++lag) {
    const LagCorrelation correlation = Correlate(deviations, lag);
    if (!correlation.ok) continue;
    ++used;
    if (whole) {
      const double n = static_cast<double>(deviations.front().size());
      q += n * (n + 2.0) * correlation.r * correlation.r /
           (n - static_cast<double>(lag));
    } else {
      q += correlation.score * correlation.score;
    }
  }
  if (used == 0) return NotApplicable("too few values");
  return {.statistic = q,
          .p = ChiSquaredUpperTail(q, static_cast<double>(used))};
}

SerialTests NotTested(const std::string& why) {
  SerialTests tests;
  tests.runs = tests.lag1 = tests.durbin_watson = tests.ljung_box =
      NotApplicable(why);
  return tests;
}

}  // namespace

Segments SegmentsByGroup(const Eigen::Ref<const VectorXd>& values,
                         const std::vector<Index>& group_codes) {
  if (std::ssize(group_codes) != values.size()) {
    throw std::invalid_argument(
        "SegmentsByGroup: " + std::to_string(group_codes.size()) +
        " group codes for " + std::to_string(values.size()) + " values");
  }
  std::map<Index, std::vector<double>> groups;
  for (Index i = 0; i < values.size(); ++i) {
    groups[group_codes[static_cast<std::size_t>(i)]].push_back(values[i]);
  }
  Segments segments;
  for (const auto& [code, members] : groups) {
    segments.emplace_back(
        Eigen::Map<const VectorXd>(members.data(), std::ssize(members)));
  }
  return segments;
}

SerialTests TestSerially(const Segments& segments) {
  constexpr Index kFewest = 4;
  const VectorXd all = Pool(segments);
  if (all.size() < kFewest) {
    return NotTested("needs at least 4 values, found " +
                     std::to_string(all.size()));
  }
  if (!all.allFinite()) return NotTested("values that are not finite");
  if (all.minCoeff() == all.maxCoeff())
    return NotTested("the values do not vary");
  SerialTests tests;
  TestRuns(segments, MedianOf(all), &tests);
  // Brought to size 1: squares of very large or small values would be lost.
  const double scale = all.cwiseAbs().maxCoeff();
  Segments deviations;
  for (const VectorXd& segment : segments) {
    const VectorXd scaled = segment / scale;
    deviations.emplace_back(scaled.array() - scaled.mean());
  }
  const LagCorrelation lag1 = Correlate(deviations, 1);
  tests.expected_lag1 = lag1.expected;
  tests.lag1 =
      lag1.ok ? TestResult{.statistic = lag1.r, .p = NormalTwoSided(lag1.score)}
              : NotApplicable("no group has 3 different values");
  tests.durbin_watson = TestDurbinWatson(deviations);
  tests.num_lags = NumLags(segments);
  tests.ljung_box = TestLjungBox(deviations, tests.num_lags);
  return tests;
}

SerialShuffles ShuffleSerially(const Segments& segments,
                               Index draws,
                               std::uint64_t seed) {
  Require(draws >= 1, "ShuffleSerially: needs at least 1 draw", draws);
  const SerialTests observed = TestSerially(segments);
  Index runs = 1;
  Index lag1 = 1;
  Index durbin_watson = 1;
  Index ljung_box = 1;
  const auto count = [](const TestResult& shuffled,
                        const TestResult& as_measured,
                        Index* extreme) {
    // Equal statistics must count as equal whatever the last digit.
    constexpr double kRounding = 1e-9;
    if (shuffled.p <= as_measured.p * (1.0 + kRounding)) ++*extreme;
  };
  Random random(seed);
  for (Index draw = 0; draw < draws; ++draw) {
    Segments shuffled;
    for (const VectorXd& segment : segments) {
      std::vector<double> values(segment.begin(), segment.end());
      random.Shuffle(values);
      shuffled.emplace_back(
          Eigen::Map<const VectorXd>(values.data(), segment.size()));
    }
    const SerialTests tests = TestSerially(shuffled);
    count(tests.runs, observed.runs, &runs);
    count(tests.lag1, observed.lag1, &lag1);
    count(tests.durbin_watson, observed.durbin_watson, &durbin_watson);
    count(tests.ljung_box, observed.ljung_box, &ljung_box);
  }
  const auto share = [draws](const TestResult& test, Index extreme) {
    return test.ok() ? static_cast<double>(extreme) /
                           (static_cast<double>(draws) + 1.0)
                     : kNaN;
  };
  return {.draws = draws,
          .runs = share(observed.runs, runs),
          .lag1 = share(observed.lag1, lag1),
          .durbin_watson = share(observed.durbin_watson, durbin_watson),
          .ljung_box = share(observed.ljung_box, ljung_box)};
}

TestResult CompareHalves(const Eigen::Ref<const VectorXd>& values) {
  constexpr Index kFewest = 4;
  const Index n = values.size();
  if (n < kFewest) {
    return NotApplicable("needs at least 4 values, found " + std::to_string(n));
  }
  if (!values.allFinite()) return NotApplicable("values that are not finite");
  const TwoSampleKs ks =
      ComputeTwoSampleKs(values.head(n / 2), values.tail(n - n / 2));
  return {.statistic = ks.d,
          .p = std::isnan(ks.p_exact) ? ks.p_asymptotic : ks.p_exact};
}

}  // namespace errmap::stats
