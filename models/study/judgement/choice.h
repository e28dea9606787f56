#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "models/study/judgement/holdout_comparison.h"
#include "models/study/study.h"

namespace errmap::models {

/// The class of model that a hold-out favours. kGiven: predictions without a
/// map.
enum class Choice {
  kPolynomial,
  kNeural,
  kBlend,
  kNoPracticalDifference,  // a polynomial and a net share the first tier
  kBaseline,               // a baseline is in the first tier
  kGiven,
};

/// "polynomial", "neural", "blend", "no practical difference", "baseline",
/// "given".
std::string_view ToString(Choice choice);

/// Returns the class of a model; never kNoPracticalDifference.
Choice ChoiceOf(const ModelResult& model);

/// True for an accepted model: index into StudyResult::models.
using Wanted = std::function<bool(std::size_t)>;

/// Returns the RMSE of a model with results; target's unit.
double RmseOf(const HoldoutComparison& comparison, std::size_t model);

/// Returns the model of lowest RMSE among those that `wanted` accepts, if any.
std::optional<std::size_t> BestWhere(const HoldoutComparison& comparison,
                                     const Wanted& wanted);

/// Returns the model of lowest RMSE in that class, if any.
std::optional<std::size_t> BestOf(const HoldoutComparison& comparison,
                                  const StudyResult& study,
                                  Choice choice);

/// Returns the difference from the lowest error that does not matter; target's
/// unit.
double MarginOf(const HoldoutComparison& comparison, double indifference);

/// Checks whether no model is better than `baseline` by more than the margin.
/// Even the lowest error may be due to chance, so the bound is checked, too.
/// Without another model, nothing can be established.
Confidence ThatNothingIsBetter(const HoldoutComparison& comparison,
                               const StudyResult& study,
                               std::size_t baseline,
                               double margin);

}  // namespace errmap::models
