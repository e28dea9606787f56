#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "models/study/judgement/holdout_comparison.h"
#include "models/study/study.h"

namespace errmap::models {

/// What a hold-out speaks for. kGiven: predictions without a map.
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

/// The class of a model by what it is; never kNoPracticalDifference.
Choice ChoiceOf(const ModelResult& model);

/// Accepts a model: index into StudyResult::models.
using Wanted = std::function<bool(std::size_t)>;

/// The RMSE of a model that was judged; target's unit.
double RmseOf(const HoldoutComparison& comparison, std::size_t model);

/// The model of lowest RMSE among those that `wanted` accepts, if any.
std::optional<std::size_t> BestWhere(const HoldoutComparison& comparison,
                                     const Wanted& wanted);

/// The model of lowest RMSE of that class, if any.
std::optional<std::size_t> BestOf(const HoldoutComparison& comparison,
                                  const StudyResult& study,
                                  Choice choice);

/// What does not matter beside the lowest error of all; target's unit.
double MarginOf(const HoldoutComparison& comparison, double indifference);

/// That no model is better than `baseline` by more than the margin. A baseline
/// of the lowest error may owe that to chance, so the bound is asked for there
/// too. Without another model there is nothing to hold it against.
Confidence ThatNothingIsBetter(const HoldoutComparison& comparison,
                               const StudyResult& study,
                               std::size_t baseline,
                               double margin);

}  // namespace errmap::models
