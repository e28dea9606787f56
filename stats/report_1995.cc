#include "stats/report_1995.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace errmap::stats {
namespace {

// Complementary error function with fractional error below 1.2e-7: the
// Chebyshev fit of Press et al. that Appendix A uses (function ERFCC).
template <typename Scalar>
Scalar ErfcApproximation(Scalar x) {
  const Scalar z = std::abs(x);
  const Scalar t = Scalar(1) / (Scalar(1) + Scalar(0.5) * z);
  constexpr Scalar kCoefficients[] = {Scalar(1.00002368),
                                      Scalar(0.37409196),
                                      Scalar(0.09678418),
                                      Scalar(-0.18628806),
                                      Scalar(0.27886807),
                                      Scalar(-1.13520398),
                                      Scalar(1.48851587),
                                      Scalar(-0.82215223),
                                      Scalar(0.17087277)};
  Scalar series = 0;
  for (auto c = std::rbegin(kCoefficients); c != std::rend(kCoefficients);
       ++c) {
    series = *c + t * series;
  }
  const Scalar value = t * std::exp(-z * z - Scalar(1.26551223) + t * series);
  return x < Scalar(0) ? Scalar(2) - value : value;
}

template <typename Scalar>
Scalar NormalCdf(Scalar x) {
  const Scalar half_width =
      Scalar(1) - ErfcApproximation(std::abs(x) / std::sqrt(Scalar(2)));
  const Scalar upper = Scalar(0.5) * (Scalar(1) + half_width);
  return x >= Scalar(0) ? upper : Scalar(1) - upper;
}

template <typename Scalar>
Scalar KsDistance(VectorOf<Scalar> sample) {
  std::sort(sample.begin(), sample.end());
  const auto n = static_cast<Scalar>(sample.size());
  Scalar distance = 0;
  Scalar below = 0;
  for (Index j = 0; j < sample.size(); ++j) {
    const Scalar above = static_cast<Scalar>(j + 1) / n;
    const Scalar cdf = NormalCdf(sample[j]);
    distance =
        std::max({distance, std::abs(below - cdf), std::abs(above - cdf)});
    below = above;
  }
  return distance;
}

template <typename Scalar>
Scalar KsProbability(Scalar lambda) {
  constexpr Scalar kTermRatio = Scalar(0.001);
  constexpr Scalar kSumRatio = Scalar(1e-8);
  const Scalar exponent = Scalar(-2) * (lambda * lambda);
  Scalar factor = 2;
  Scalar sum = 0;
  Scalar last = 0;
  for (int j = 1; j <= 100; ++j) {
    const Scalar term =
        factor * std::exp(exponent * static_cast<Scalar>(j * j));
    sum += term;
    if (std::abs(term) < kTermRatio * last ||
        std::abs(term) < kSumRatio * sum) {
      return sum;
    }
    factor = -factor;
    last = std::abs(term);
  }
  return 1;
}

// np and j stand one past their limits after the loops: np*j = (P+1)(J+1).
template <typename Scalar>
Scalar DivisorOf(const MatrixOf<Scalar>& values) {
  return static_cast<Scalar>((values.rows() + 1) * (values.cols() + 1));
}

// Pattern by pattern, output by output.
template <typename Scalar>
Scalar MeanAsPrinted(const MatrixOf<Scalar>& values) {
  Scalar sum = 0;
  for (Index p = 0; p < values.rows(); ++p) {
    for (const Scalar value : values.row(p)) sum += value;
  }
  return sum / DivisorOf(values);
}

template <typename Scalar>
Scalar SquaresAbout(Scalar centre, const MatrixOf<Scalar>& values) {
  Scalar sum = 0;
  for (Index p = 0; p < values.rows(); ++p) {
    for (const Scalar value : values.row(p)) {
      sum += (value - centre) * (value - centre);
    }
  }
  return sum;
}

}  // namespace

template <typename Scalar>
Report1995Statistics StatisticsOf1995(const MatrixOf<Scalar>& errors) {
  if (errors.size() == 0) {
    throw std::invalid_argument("StatisticsOf1995: no residuals");
  }
  const Scalar mean = MeanAsPrinted(errors);
  const Scalar sd =
      std::sqrt(SquaresAbout(mean, errors) / (DivisorOf(errors) - Scalar(1)));
  Report1995Statistics printed;
  printed.n = errors.rows();
  printed.mean = static_cast<double>(mean);
  printed.sd = static_cast<double>(sd);
  constexpr Scalar kFirstMin = Scalar(1e20);
  constexpr Scalar kFirstMax = Scalar(1e-20);
  printed.min = static_cast<double>(std::min(kFirstMin, errors.minCoeff()));
  printed.max = static_cast<double>(std::max(kFirstMax, errors.maxCoeff()));
  const VectorOf<Scalar> standardised = (errors.col(0).array() - mean) / sd;
  const Scalar distance = KsDistance<Scalar>(standardised);
  printed.ks_d = static_cast<double>(distance);
  printed.ks_probability = static_cast<double>(
      KsProbability(std::sqrt(static_cast<Scalar>(errors.rows())) * distance));
  return printed;
}

template <typename Scalar>
double RSquaredOf1995(const MatrixOf<Scalar>& targets,
                      const MatrixOf<Scalar>& predicted) {
  if (targets.size() == 0 || targets.rows() != predicted.rows() ||
      targets.cols() != predicted.cols()) {
    throw std::invalid_argument(
        "RSquaredOf1995: needs as many predictions as targets, at least one; "
        "found " +
        std::to_string(predicted.size()) + " and " +
        std::to_string(targets.size()));
  }
  const Scalar mean = MeanAsPrinted(targets);
  return static_cast<double>(SquaresAbout(mean, predicted) /
                             SquaresAbout(mean, targets));
}

template Report1995Statistics StatisticsOf1995(const MatrixOf<float>&);
template Report1995Statistics StatisticsOf1995(const MatrixOf<double>&);
template double RSquaredOf1995(const MatrixOf<float>&, const MatrixOf<float>&);
template double RSquaredOf1995(const MatrixOf<double>&,
                               const MatrixOf<double>&);

}  // namespace errmap::stats
