#include "stats/bias.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "stats/distributions.h"
#include "stats/not_a_number.h"
#include "stats/summary.h"

namespace errmap::stats {
BiasByLevel ComputeBias(const Eigen::Ref<const VectorXd>& values,
                        const std::vector<Index>& codes) {
  if (std::ssize(codes) != values.size()) {
    throw std::invalid_argument("ComputeBias: " + std::to_string(codes.size()) +
                                " codes for " + std::to_string(values.size()) +
                                " values");
  }
  std::vector<std::vector<double>> members;
  for (Index i = 0; i < values.size(); ++i) {
    const Index code = codes[static_cast<std::size_t>(i)];
    if (code < 0) {
      throw std::invalid_argument("ComputeBias: negative code " +
                                  std::to_string(code));
    }
    const auto level = static_cast<std::size_t>(code);
    if (level >= members.size()) members.resize(level + 1);
    members[level].push_back(values[i]);
  }
  const SampleSummary all = Summarize(values);
  BiasByLevel bias;
  bias.explained = kNaN;
  double within = 0.0;
  double between = 0.0;
  Index in_use = 0;
  for (const std::vector<double>& level : members) {
    if (level.empty()) {
      bias.levels.push_back({.n = 0, .mean = kNaN, .standard_error = kNaN});
      continue;
    }
    const SampleSummary summary =
        Summarize(Eigen::Map<const VectorXd>(level.data(), std::ssize(level)));
    bias.levels.push_back(
        {.n = summary.n,
         .mean = summary.mean,
         .standard_error = StandardError(summary.sd, summary.n)});
    const double size = static_cast<double>(summary.n);
    const double offset = (summary.mean - all.mean) / all.sd;
    const double spread = summary.n > 1 ? summary.sd / all.sd : 0.0;
    between += size * offset * offset;
    within += (size - 1.0) * spread * spread;
    ++in_use;
  }
  if (!values.allFinite()) {
    bias.anova = NotApplicable("values that are not finite");
  } else if (in_use < 2) {
    bias.anova = NotApplicable("needs at least 2 levels, found " +
                               std::to_string(in_use));
  } else if (values.size() <= in_use) {
    bias.anova = NotApplicable("no level has 2 values");
  } else if (!(all.sd > 0.0)) {
    bias.anova = NotApplicable("the values do not vary");
  } else if (!(within > 0.0)) {
    bias.anova = NotApplicable("the values do not vary within any level");
    bias.explained = 1.0;
  } else {
    const double levels = static_cast<double>(in_use) - 1.0;
    const double rest = static_cast<double>(values.size() - in_use);
    const double f = (between / levels) / (within / rest);
    bias.anova = {.statistic = f, .p = FUpperTail(f, levels, rest)};
    bias.explained = between / (between + within);
  }
  return bias;
}

std::vector<Index> CodesOfValues(const Eigen::Ref<const VectorXd>& at,
                                 std::vector<double>* distinct) {
  std::vector<double> sorted(at.begin(), at.end());
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  std::vector<Index> codes;
  codes.reserve(static_cast<std::size_t>(at.size()));
  for (const double value : at) {
    codes.push_back(std::lower_bound(sorted.begin(), sorted.end(), value) -
                    sorted.begin());
  }
  if (distinct != nullptr) *distinct = std::move(sorted);
  return codes;
}

TestResult BreuschPagan(const Eigen::Ref<const VectorXd>& residuals,
                        const Eigen::Ref<const VectorXd>& fitted) {
  const Index n = residuals.size();
  if (fitted.size() != n) {
    throw std::invalid_argument(
        "BreuschPagan: " + std::to_string(fitted.size()) +
        " fitted values for " + std::to_string(n) + " residuals");
  }
  constexpr Index kFewest = 4;
  if (n < kFewest) {
    return NotApplicable("needs at least 4 values, found " + std::to_string(n));
  }
  if (!residuals.allFinite() || !fitted.allFinite()) {
    return NotApplicable("values that are not finite");
  }
  if (fitted.minCoeff() == fitted.maxCoeff()) {
    return NotApplicable("the fitted values do not vary");
  }
  const double size_of_residuals = residuals.cwiseAbs().maxCoeff();
  if (!(size_of_residuals > 0.0)) {
    return NotApplicable("all residuals are 0");
  }
  const VectorXd squares = (residuals / size_of_residuals).cwiseAbs2();
  const Eigen::ArrayXd y = squares.array() - squares.mean();
  const double size_of_fitted = fitted.cwiseAbs().maxCoeff();
  const VectorXd scaled = fitted / size_of_fitted;
  const Eigen::ArrayXd x = scaled.array() - scaled.mean();
  const double total = y.square().sum();
  constexpr double kRounding = 1e-24;  // of squares that are all the same
  if (!(total > kRounding * static_cast<double>(n))) {
    return NotApplicable("the squared residuals do not vary");
  }
  const double products = (x * y).sum();
  const double lm =
      static_cast<double>(n) * products * products / (x.square().sum() * total);
  return {.statistic = lm, .p = ChiSquaredUpperTail(lm, 1.0)};
}

}  // namespace errmap::stats
