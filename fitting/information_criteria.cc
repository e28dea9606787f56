#include "fitting/information_criteria.h"

#include <cmath>
#include <limits>

namespace errmap::fitting {

const std::vector<std::string>& CriterionWords() {
  static const std::vector<std::string> words = {
      "p", "aic", "aicc", "bic", "adjr2", "press", "cp", "cv", "none"};
  return words;
}

std::string_view ToString(Criterion criterion) {
  return CriterionWords()[static_cast<std::size_t>(criterion)];
}

double Aic(double rss, double n, double k) {
  return n * std::log(rss / n) + 2.0 * k;
}

double Aicc(double rss, double n, double k) {
  if (!(n > k + 2.0)) return std::numeric_limits<double>::infinity();
  return Aic(rss, n, k) + 2.0 * (k + 1.0) * (k + 2.0) / (n - k - 2.0);
}

double Bic(double rss, double n, double k) {
  return n * std::log(rss / n) + k * std::log(n);
}

double AdjustedR2(double rss, double tss, double n, double k) {
  if (!(n > k)) return -std::numeric_limits<double>::infinity();
  return 1.0 - (rss / (n - k)) / (tss / (n - 1.0));
}

double MallowsCp(double rss, double sigma2, double n, double k) {
  return rss / sigma2 - n + 2.0 * k;
}

}  // namespace errmap::fitting
