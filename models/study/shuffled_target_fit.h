#pragma once

#include <string>
#include <string_view>

#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "stats/not_a_number.h"

namespace errmap::models {

/// How much noise a fit follows.
enum class NoiseLearning { kUnknown, kLittle, kSome, kMuch };
/// "unknown", "little", "some", "much".
std::string_view ToString(NoiseLearning learning);

/// Evidence on whether a model memorises its training rows.
struct ShuffledTargetFit {
  /// R2 on the training rows, about their mean.
  double train_r2 = stats::kNaN;
  /// R2 of the same fit to targets in a seeded random order. Such targets
  /// cannot be learnt, so this is the share of noise that the fit follows.
  double shuffled_r2 = stats::kNaN;
  double weights_per_row = stats::kNaN;
  /// net_effective_parameters.h, at the fitted weights; NaN for other models.
  double effective_parameters = stats::kNaN;
  double effective_per_row = stats::kNaN;
  /// Reason if a value is missing that this model should have, else "".
  std::string why_not;

  /// Classifies the share of noise that a fit follows by the larger of
  /// shuffled_r2 and effective_per_row, two estimates of it. (For a linear fit
  /// of p coefficients to n rows, both are p / n.) kUnknown if both are NaN.
  NoiseLearning learning() const;
};

/// Shares from which a fit follows some and much of the noise. A linear fit
/// with share s has s / (1 - s) of the target's noise variance in its
/// predictions (for one row p / (n - p)). That is a quarter at 0.2, the limit
/// for trying full polynomials (recipe_catalog.h), and as much as the noise
/// itself at 0.5.
inline constexpr double kSomeNoise = 0.2;
inline constexpr double kMuchNoise = 0.5;

/// Judges `fitted`, the fit of `recipe` to `training` in `context`. Tuned
/// choices (hidden nodes, wfactor, start) stay fixed, so it costs one fit,
/// within the recipe's own limits. A fit that fails or is interrupted leaves
/// NaN and `why_not`; nothing throws.
ShuffledTargetFit FitShuffledTargets(const ModelRecipe& recipe,
                                     const data::Dataset& training,
                                     const FittedModel& fitted,
                                     const FitContext& context);

/// Returns `dataset` with its targets in a seeded random order over all rows.
/// Inputs, groups and weights are unchanged.
data::Dataset ShuffleTargets(const data::Dataset& dataset, std::uint64_t seed);

}  // namespace errmap::models
