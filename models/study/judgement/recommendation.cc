#include "models/study/judgement/recommendation.h"

#include <algorithm>
#include <tuple>

#include "models/study/judgement/blend_or_simpler.h"
#include "models/study/judgement/extrapolated_rows.h"
#include "models/study/judgement/holdout_comparison.h"

namespace errmap::models {

namespace {

// Share of the held-out rows with an input outside what its fold trained on.
double ExtrapolatedShare(const data::Dataset& dataset,
                         const Holdout& holdout,
                         const FittedModel& fitted) {
  Index outside = 0;
  Index all = 0;
  for (const auto& rows : ExtrapolatedRows(dataset, holdout, fitted)) {
    outside += rows.count();
    all += rows.size();
  }
  return all > 0 ? static_cast<double>(outside) / static_cast<double>(all)
                 : 0.0;
}

// Models with an RMSE within the margin of `best`, by RMSE.
std::vector<std::size_t> NearTheBest(const HoldoutComparison& comparison,
                                     const Wanted& wanted,
                                     double best,
                                     double indifference) {
  const double most =
      best + stats::Margin{.indifference = indifference}.Of(best);
  std::vector<std::size_t> near;
  for (const std::size_t model : comparison.models) {
    const double rmse = RmseOf(comparison, model);
    if (wanted(model) && rmse >= best && rmse <= most) near.push_back(model);
  }
  std::ranges::stable_sort(
      near, {}, [&](std::size_t model) { return RmseOf(comparison, model); });
  return near;
}

// Takes the first tier that holds a map: predictions alone cannot be run.
// Leaves advice->first_tier empty if there is none.
void TakeFirstTier(const HoldoutComparison& comparison,
                   const Wanted& is_map,
                   double indifference,
                   Recommendation* advice) {
  for (const std::vector<Index>& tier : comparison.tests.tiers) {
    for (const Index place : tier) {
      const std::size_t model =
          comparison.models[static_cast<std::size_t>(place)];
      if (is_map(model)) {
        advice->first_tier.push_back(model);
      } else if (advice->first_tier.empty() && !advice->better_but_no_map) {
        advice->better_but_no_map = model;
      }
    }
    if (!advice->first_tier.empty()) break;
  }
  // One unit bounds no difference, so a tier is a model alone; what is near it
  // by the margin may be better just as well, and simpler.
  if (comparison.tests.num_units < 2 && !advice->first_tier.empty()) {
    advice->first_tier =
        NearTheBest(comparison,
                    is_map,
                    RmseOf(comparison, advice->first_tier.front()),
                    indifference);
  }
}

// Chooses from a tier's baselines, or from all if there are none: fewest
// sensors, then fewest parameters, then lowest error.
std::size_t SimplestOf(const std::vector<std::size_t>& tier,
                       const HoldoutComparison& comparison,
                       const StudyResult& study) {
  std::vector<std::size_t> candidates;
  std::ranges::copy_if(
      tier, std::back_inserter(candidates), [&](std::size_t model) {
        return ChoiceOf(study.models[model]) == Choice::kBaseline;
      });
  if (candidates.empty()) candidates = tier;
  return *std::ranges::min_element(candidates, {}, [&](std::size_t model) {
    const FittedModel& map = *study.models[model].final_fit;
    return std::tuple(SensorsOf(map).size(),
                      map.model->num_parameters(),
                      RmseOf(comparison, model));
  });
}

// What the model is worth beside baselines and beside the best of its tier.
void WeighAgainstOthers(const HoldoutComparison& comparison,
                        const StudyResult& study,
                        double indifference,
                        Recommendation* advice) {
  const auto best_baseline = BestOf(comparison, study, Choice::kBaseline);
  advice->has_baseline = best_baseline.has_value();
  advice->best_baseline = best_baseline.value_or(0);
  advice->choice = ChoiceOf(study.models[advice->model]);
  const double margin = MarginOf(comparison, indifference);
  if (advice->choice == Choice::kBaseline) {
    advice->against_baseline =
        ThatNothingIsBetter(comparison, study, advice->model, margin);
  } else if (best_baseline) {
    advice->against_baseline =
        comparison.ThatItIsBetter(advice->model, *best_baseline);
  }
  const auto in_tier = [&](Choice choice) {
    return std::ranges::any_of(advice->first_tier, [&](std::size_t model) {
      return ChoiceOf(study.models[model]) == choice;
    });
  };
  if (advice->choice != Choice::kBaseline && in_tier(Choice::kPolynomial) &&
      in_tier(Choice::kNeural)) {
    advice->choice = Choice::kNoPracticalDifference;
  }
}

// The cheapest map that is proven to lose at most the margin to `model`, or
// `model` itself if there is none: fewest sensors, then fewest parameters.
std::size_t CheapestNear(std::size_t model,
                         const HoldoutComparison& comparison,
                         const StudyResult& study,
                         const Wanted& is_map,
                         double indifference) {
  const double margin =
      stats::Margin{.indifference = indifference}.Of(RmseOf(comparison, model));
  std::vector<std::size_t> near{model};
  for (const std::size_t other : comparison.models) {
    if (other != model && is_map(other) &&
        comparison.ThatItLosesAtMost(margin, other, model) ==
            Confidence::kEstablished) {
      near.push_back(other);
    }
  }
  return SimplestOf(near, comparison, study);
}

}  // namespace

std::string_view ToString(Choose choose) {
  return choose == Choose::kBest    ? "best"
         : choose == Choose::kBlend ? "blend"
                                    : "auto";
}

std::string_view ToString(Prefer prefer) {
  return prefer == Prefer::kSmall ? "small" : "least-error";
}

std::optional<Recommendation> Recommend(
    const data::Dataset& dataset,
    const std::vector<Holdout>& holdouts,
    const StudyResult& study,
    const std::vector<HoldoutComparison>& comparisons,
    const JudgeOptions& options) {
  if (dataset.num_rows() < kFewestRowsToRecommend) return std::nullopt;
  const auto strictest = StrictestHoldout(holdouts, comparisons);
  const auto decisive = DecisiveHoldout(holdouts, comparisons);
  if (!strictest || !decisive) return std::nullopt;
  const HoldoutComparison& comparison = comparisons[*strictest];
  const HoldoutComparison& decides = comparisons[*decisive];
  const Wanted is_map = [&](std::size_t model) {
    return study.models[model].final_fit.has_value() &&
           comparison.PlaceOf(model) && decides.PlaceOf(model);
  };
  Recommendation advice;
  advice.holdout = *strictest;
  advice.decided_by = *decisive;
  // What decides may be another hold-out than what is promised by.
  Recommendation decided;
  TakeFirstTier(decides, is_map, options.indifference, &decided);
  TakeFirstTier(comparison, is_map, options.indifference, &advice);
  if (advice.first_tier.empty() || decided.first_tier.empty()) {
    return std::nullopt;
  }
  const std::size_t simplest = SimplestOf(decided.first_tier, decides, study);
  const auto is_blend = [&](std::size_t model) {
    return ChoiceOf(study.models[model]) == Choice::kBlend;
  };
  const auto blend = BestWhere(decides, [&](std::size_t model) {
    return is_map(model) && is_blend(model);
  });
  advice.model = simplest;
  if (options.choose == Choose::kBest) {
    advice.model = *BestWhere(decides, is_map);
  } else if (blend) {
    advice.model = *blend;
    if (options.choose == Choose::kAuto) {
      const BlendOrSimpler chosen =
          ChooseBlendOrSimpler(*blend,
                               decides,
                               comparison,
                               ForwardOverSessions(holdouts, comparisons),
                               study,
                               is_map);
      advice.model = chosen.model;
      if (chosen.vetoed_by) advice.fails_in = chosen.vetoed_by->holdout;
    }
  }
  if (options.prefer == Prefer::kSmall) {
    advice.model = CheapestNear(
        advice.model, decides, study, is_map, options.indifference);
  }
  if (options.choose == Choose::kAuto) {
    if (const auto instead =
            BetterWithoutSensors(advice.model, comparison, study, is_map)) {
      advice.model = *instead;
      advice.fails_in.clear();
    }
  }
  if (is_blend(advice.model)) {
    advice.single = BestWhere(decides, [&](std::size_t model) {
      return is_map(model) && !is_blend(model);
    });
  } else if (blend && decides.units.separate_sessions &&
             decides.ThatItIsBetter(advice.model, *blend) ==
                 Confidence::kEstablished) {
    advice.proven_better_than = blend;
  }
  WeighAgainstOthers(comparison, study, options.indifference, &advice);
  advice.extrapolated_share = ExtrapolatedShare(
      dataset, holdouts[*strictest], *study.models[advice.model].final_fit);
  return advice;
}

std::vector<std::string> SensorsOf(const FittedModel& fitted) {
  std::vector<std::string> sensors;
  for (const TrainedInput& input : fitted.inputs) {
    if (data::IsReadBySensor(input.column)) {
      sensors.push_back(input.column.name);
    }
  }
  return sensors;
}

}  // namespace errmap::models
