#include "stats/comparison/sign_flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "stats/random.h"
#include "stats/require.h"

namespace errmap::stats {
namespace {

// Sums that are equal in exact arithmetic must count as equal: a share of the
// sum of all magnitudes, far above rounding and far below any real difference.
constexpr double kRounding = 1e-11;

// The smallest |sum| that counts as at least as extreme as the observed one.
double Threshold(const VectorXd& differences) {
  return std::abs(differences.sum()) - kRounding * differences.lpNorm<1>();
}

// The sums of all 2^k sign patterns of `magnitudes`, ascending.
std::vector<double> AllSums(const double* begin, const double* end) {
  std::vector<double> sums{0.0};
  std::vector<double> minus;
  std::vector<double> plus;
  for (const double* magnitude = begin; magnitude != end; ++magnitude) {
    minus.clear();
    plus.clear();
    for (const double sum : sums) {
      minus.push_back(sum - *magnitude);
      plus.push_back(sum + *magnitude);
    }
    sums.resize(2 * sums.size());
    std::merge(
        minus.begin(), minus.end(), plus.begin(), plus.end(), sums.begin());
  }
  return sums;
}

// The share of the patterns of m >= 1 magnitudes with sum <= -threshold or >=
// threshold: by symmetry, twice that of the latter unless threshold <= 0.
double ShareAsExtreme(const std::vector<double>& magnitudes, double threshold) {
  if (threshold <= 0.0) return 1.0;
  const double* middle = magnitudes.data() + magnitudes.size() / 2;
  const std::vector<double> left = AllSums(magnitudes.data(), middle);
  const std::vector<double> right =
      AllSums(middle, magnitudes.data() + magnitudes.size());
  double count = 0.0;
  auto high = right.end();  // right sums from here on are enough
  for (const double sum : left) {
    while (high != right.begin() && sum + *(high - 1) >= threshold) --high;
    count += static_cast<double>(right.end() - high);
  }
  return 2.0 * count / std::ldexp(1.0, static_cast<int>(magnitudes.size()));
}

SignFlipTest TestExactly(const VectorXd& differences,
                         const std::vector<double>& magnitudes) {
  SignFlipTest result;
  result.exact = true;
  result.test.statistic = differences.mean();
  if (magnitudes.empty()) {
    result.test.p = 1.0;
    return result;
  }
  result.smallest_p = std::ldexp(2.0, -static_cast<int>(magnitudes.size()));
  result.test.p =
      std::min(1.0, ShareAsExtreme(magnitudes, Threshold(differences)));
  return result;
}

// The signs that a byte stands for, its lowest bit first.
using SignsOfByte = std::array<double, 8>;

std::array<SignsOfByte, 256> SignsOfBytes() {
  std::array<SignsOfByte, 256> signs{};
  for (std::size_t byte = 0; byte < signs.size(); ++byte) {
    for (std::size_t bit = 0; bit < signs[byte].size(); ++bit) {
      signs[byte][bit] = ((byte >> bit) & 1U) != 0 ? 1.0 : -1.0;
    }
  }
  return signs;
}

// Fills `signs` with -1 and 1, by the byte: quicker than bit by bit.
void DrawSigns(Random* random, MatrixXd* signs) {
  static const auto kSigns = SignsOfBytes();
  constexpr int kBytes = 4;
  for (Index at = 0; at < signs->size();) {
    std::uint64_t bits = random->Below(std::uint64_t{1} << (8 * kBytes));
    for (int byte = 0; byte < kBytes && at < signs->size(); ++byte) {
      const SignsOfByte& drawn = kSigns[bits & 0xFFU];
      const Index size = std::min(std::ssize(drawn), signs->size() - at);
      std::copy_n(drawn.begin(), size, signs->data() + at);
      bits >>= 8U;
      at += size;
    }
  }
}

// Number of `draws` patterns at least as extreme, for each column.
std::vector<Index> CountDrawn(const MatrixXd& differences,
                              Index draws,
                              std::uint64_t seed) {
  constexpr Index kAtATime = 256;  // keeps signs and sums in the cache
  const Index pairs = differences.cols();
  VectorXd threshold(pairs);
  for (Index pair = 0; pair < pairs; ++pair) {
    threshold[pair] = Threshold(differences.col(pair));
  }
  std::vector<Index> counts(static_cast<std::size_t>(pairs), 0);
  Random random(seed);
  for (Index done = 0; done < draws; done += kAtATime) {
    MatrixXd signs(std::min(kAtATime, draws - done), differences.rows());
    DrawSigns(&random, &signs);
    const MatrixXd sums = signs * differences;
    for (Index pair = 0; pair < pairs; ++pair) {
      counts[static_cast<std::size_t>(pair)] +=
          (sums.col(pair).array().abs() >= threshold[pair]).count();
    }
  }
  return counts;
}

std::vector<double> NonzeroMagnitudes(const VectorXd& differences) {
  std::vector<double> magnitudes;
  for (const double difference : differences) {
    if (difference != 0.0) magnitudes.push_back(std::abs(difference));
  }
  return magnitudes;
}

}  // namespace

std::vector<SignFlipTest> TestBySignFlips(const MatrixXd& differences,
                                          Index draws,
                                          std::uint64_t seed) {
  Require(draws >= 1, "TestBySignFlips: needs at least 1 draw", draws);
  if (!differences.allFinite()) {
    throw std::invalid_argument("TestBySignFlips: a difference is not finite");
  }
  std::vector<SignFlipTest> tests(static_cast<std::size_t>(differences.cols()));
  std::vector<Index> many;  // columns with too many differences to enumerate
  for (Index pair = 0; pair < differences.cols(); ++pair) {
    SignFlipTest& test = tests[static_cast<std::size_t>(pair)];
    if (differences.rows() == 0) {
      test.test = NotApplicable("no units");
      continue;
    }
    const std::vector<double> magnitudes =
        NonzeroMagnitudes(differences.col(pair));
    if (std::ssize(magnitudes) > kMostForExactFlips) {
      many.push_back(pair);
    } else {
      test = TestExactly(differences.col(pair), magnitudes);
    }
  }
  if (many.empty()) return tests;
  const MatrixXd drawn = differences(Eigen::all, many);
  const std::vector<Index> counts = CountDrawn(drawn, draws, seed);
  for (std::size_t i = 0; i < many.size(); ++i) {
    SignFlipTest& test = tests[static_cast<std::size_t>(many[i])];
    const double all = static_cast<double>(draws) + 1.0;
    test.test.statistic = drawn.col(static_cast<Index>(i)).mean();
    test.test.p = (static_cast<double>(counts[i]) + 1.0) / all;
    test.smallest_p = 1.0 / all;
  }
  return tests;
}

}  // namespace errmap::stats
