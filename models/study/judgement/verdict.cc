#include "models/study/judgement/verdict.h"

#include <algorithm>

#include "models/study/judgement/holdout_comparison.h"

namespace errmap::models {

namespace {

std::vector<std::size_t> FirstTier(const HoldoutComparison& comparison) {
  std::vector<std::size_t> models;
  for (const Index place : comparison.tests.tiers.front()) {
    models.push_back(comparison.models[static_cast<std::size_t>(place)]);
  }
  return models;
}

// That both statements hold: what the first lacks, else the second.
Confidence Both(Confidence first, Confidence second) {
  return first == Confidence::kEstablished ? second : first;
}

Confidence ConfidenceOf(const Verdict& verdict,
                        const HoldoutComparison& comparison,
                        const StudyResult& study,
                        double margin) {
  const auto& baseline = verdict.best_baseline;
  if (verdict.choice == Choice::kBaseline) {
    return ThatNothingIsBetter(comparison, study, *baseline, margin);
  }
  if (verdict.choice == Choice::kNoPracticalDifference) {
    const std::size_t one = *BestOf(comparison, study, Choice::kPolynomial);
    const std::size_t other = *BestOf(comparison, study, Choice::kNeural);
    return Both(comparison.ThatItLosesAtMost(margin, one, other),
                comparison.ThatItLosesAtMost(margin, other, one));
  }
  if (!verdict.rival) return Confidence::kNotShown;
  const Confidence against_rival =
      comparison.ThatItIsBetter(verdict.best, *verdict.rival);
  return baseline ? Both(against_rival,
                         comparison.ThatItIsBetter(verdict.best, *baseline))
                  : against_rival;
}

}  // namespace

Verdict JudgeHoldout(const HoldoutComparison& comparison,
                     const StudyResult& study,
                     double indifference) {
  Verdict verdict;
  verdict.holdout = comparison.holdout;
  const std::vector<std::size_t> tier = FirstTier(comparison);
  verdict.best = tier.front();
  const auto in_tier = [&](Choice choice) {
    return std::ranges::any_of(tier, [&](std::size_t model) {
      return ChoiceOf(study.models[model]) == choice;
    });
  };
  const Choice of_best = ChoiceOf(study.models[verdict.best]);
  if (in_tier(Choice::kBaseline)) {
    verdict.choice = Choice::kBaseline;
  } else if (in_tier(Choice::kPolynomial) && in_tier(Choice::kNeural)) {
    verdict.choice = Choice::kNoPracticalDifference;
  } else {
    verdict.choice = of_best;
  }
  verdict.best_baseline = BestOf(comparison, study, Choice::kBaseline);
  verdict.rival = BestWhere(comparison, [&](std::size_t model) {
    const Choice choice = ChoiceOf(study.models[model]);
    // A blend is made of the others: it settles nothing between them.
    return choice != of_best && choice != Choice::kBaseline &&
           choice != Choice::kBlend;
  });
  if (!verdict.rival && of_best != Choice::kBaseline) {
    verdict.rival = verdict.best_baseline;
  }
  verdict.confidence = ConfidenceOf(
      verdict, comparison, study, MarginOf(comparison, indifference));
  return verdict;
}

std::optional<InterpolationGap> MeasureGap(
    const std::vector<Holdout>& holdouts,
    const StudyResult& study,
    const std::vector<HoldoutComparison>& comparisons) {
  constexpr double kFlatteringRatio = 2.0;
  std::optional<std::size_t> neighbours;
  for (std::size_t h = 0; h < holdouts.size(); ++h) {
    if (comparisons[h].models.empty()) continue;
    if (!neighbours && holdouts[h].among_neighbours) neighbours = h;
  }
  const auto unseen = StrictestHoldout(holdouts, comparisons);
  if (!unseen ||
      !(holdouts[*unseen].whole_groups || holdouts[*unseen].whole_sessions)) {
    return std::nullopt;
  }
  if (!neighbours) return std::nullopt;
  InterpolationGap gap{.neighbours = holdouts[*neighbours].name,
                       .unseen = holdouts[*unseen].name};
  for (const std::size_t model : comparisons[*neighbours].models) {
    if (!comparisons[*unseen].PlaceOf(model)) continue;
    InterpolationGap::Row& row = gap.models.emplace_back();
    row.model = study.models[model].name;
    row.neighbours_rmse = RmseOf(comparisons[*neighbours], model);
    row.unseen_rmse = RmseOf(comparisons[*unseen], model);
    row.ratio = row.unseen_rmse / row.neighbours_rmse;
    row.flatters = row.ratio >= kFlatteringRatio;
  }
  return gap;
}

}  // namespace errmap::models
