#pragma once

#include <limits>
#include <string>
#include <string_view>

#include "data/measurements/dataset.h"
#include "models/error_model.h"

namespace errmap::models {

/// How much noise a fit can follow.
enum class NoiseLearning { kUnknown, kLittle, kSome, kMuch };
/// "unknown", "little", "some", "much".
std::string_view ToString(NoiseLearning learning);

/// Whether a model can learn its rows by heart.
struct Memorisation {
  static constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

  /// R2 on the training rows, about their mean.
  double train_r2 = kNaN;
  /// The same of the same fit to the targets in a seeded random order, where
  /// there is nothing to learn: what it follows there is noise.
  double shuffled_r2 = kNaN;
  double weights_per_row = kNaN;
  /// net_effective_parameters.h, at the fitted weights; NaN for other models.
  double effective_parameters = kNaN;
  double effective_per_row = kNaN;
  /// Why a figure is missing that this model should have; "" where none is.
  std::string why_not;

  /// By the larger of shuffled_r2 and effective_per_row, which estimate the
  /// same thing, the share of noise that a fit follows (a linear fit of p
  /// coefficients to n rows: p / n both); kUnknown where both are NaN.
  NoiseLearning learning() const;
};

/// Shares from which on a fit follows some and much of the noise. A linear fit
/// that follows the share s has noise of s / (1 - s) of the target's own noise
/// variance in its predictions (one row's p / (n - p)): a quarter at 0.2, from
/// where on full polynomials are not tried either (recipe_catalog.h), and as
/// much as the noise itself at 0.5.
inline constexpr double kSomeNoise = 0.2;
inline constexpr double kMuchNoise = 0.5;

/// Judges `fitted`, the fit of `recipe` to `training` in `context`. What the
/// recipe tuned (hidden nodes, wfactor, start) is fixed as it was, so that this
/// costs one fit, within the recipe's own limits. A fit that fails or is
/// interrupted leaves NaN and `why_not`; nothing throws.
Memorisation AssessMemorisation(const ModelRecipe& recipe,
                                const data::Dataset& training,
                                const FittedModel& fitted,
                                const FitContext& context);

/// `dataset` with its targets in a seeded random order over all rows; inputs,
/// groups and weights stay.
data::Dataset ShuffleTargets(const data::Dataset& dataset, std::uint64_t seed);

}  // namespace errmap::models
