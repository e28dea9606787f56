#include "models/study/judgement/choice.h"

#include <array>

#include "data/text.h"

namespace errmap::models {

std::string_view ToString(Choice choice) {
  constexpr auto kNames =
      std::to_array<std::string_view>({"polynomial",
                                       "neural",
                                       "blend",
                                       "no practical difference",
                                       "baseline",
                                       "given"});
  return data::NameOf(kNames, choice);
}

Choice ChoiceOf(const ModelResult& model) {
  if (model.baseline) return Choice::kBaseline;
  // An existing map is what it was fitted as.
  ModelKind kind = model.kind;
  if (kind == ModelKind::kFile && model.final_fit) {
    kind = model.final_fit->kind;
  }
  switch (kind) {
    case ModelKind::kBaseline:
      return Choice::kBaseline;
    case ModelKind::kPolynomial:
      return Choice::kPolynomial;
    case ModelKind::kNet:
      return Choice::kNeural;
    case ModelKind::kBlend:
      return Choice::kBlend;
    default:  // it speaks for no class that verdicts tell apart
      return Choice::kGiven;
  }
}

double RmseOf(const HoldoutComparison& comparison, std::size_t model) {
  return comparison.tests.rmse[*comparison.PlaceOf(model)];
}

std::optional<std::size_t> BestWhere(const HoldoutComparison& comparison,
                                     const Wanted& wanted) {
  std::optional<std::size_t> best;
  for (const std::size_t model : comparison.models) {
    if (!wanted(model)) continue;
    if (!best || RmseOf(comparison, model) < RmseOf(comparison, *best)) {
      best = model;
    }
  }
  return best;
}

std::optional<std::size_t> BestOf(const HoldoutComparison& comparison,
                                  const StudyResult& study,
                                  Choice choice) {
  return BestWhere(comparison, [&](std::size_t model) {
    return ChoiceOf(study.models[model]) == choice;
  });
}

double MarginOf(const HoldoutComparison& comparison, double indifference) {
  return stats::Margin{.indifference = indifference}.Of(
      comparison.tests.rmse.minCoeff());
}

Confidence ThatNothingIsBetter(const HoldoutComparison& comparison,
                               const StudyResult& study,
                               std::size_t baseline,
                               double margin) {
  const auto best = BestWhere(comparison, [&](std::size_t model) {
    return ChoiceOf(study.models[model]) != Choice::kBaseline;
  });
  return best ? comparison.ThatItLosesAtMost(margin, baseline, *best)
              : Confidence::kNotShown;
}

}  // namespace errmap::models
