#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace errmap::fitting {

/// Criterion to select a term, stop a selection or choose among its models.
enum class Criterion {
  kPValue,      // of the partial F test
  kAic,         // Akaike 1973
  kAicc,        // Hurvich and Tsai 1989
  kBic,         // Schwarz 1978
  kAdjustedR2,  // Wherry 1931; the only one where higher is better
  kPress,       // Allen 1974
  kCp,          // Mallows 1973
  kCv,          // squared error on held-out folds
  kNone,        // as a stopping criterion: never stops
};

/// "p", "aic", "aicc", "bic", "adjr2", "press", "cp", "cv", "none".
std::string_view ToString(Criterion criterion);

/// Names of the criteria in the order of the enum, `kNone` last.
const std::vector<std::string>& CriterionWords();

/// n ln(RSS / n) + 2 k with k coefficients, including the intercept: the
/// constant of R's step() and extractAIC(). R's AIC() adds n (1 + ln 2 pi) + 2.
double Aic(double rss, double n, double k);

/// AIC + 2 (k + 1) (k + 2) / (n - k - 2), which counts the error variance as a
/// parameter (Hurvich and Tsai 1989). Infinite unless n > k + 2.
double Aicc(double rss, double n, double k);

/// n ln(RSS / n) + k ln n.
double Bic(double rss, double n, double k);

/// 1 - (RSS / (n - k)) / (TSS / (n - 1)); minus infinity unless n > k.
double AdjustedR2(double rss, double tss, double n, double k);

/// RSS / sigma2 - n + 2 k.
double MallowsCp(double rss, double sigma2, double n, double k);

}  // namespace errmap::fitting
