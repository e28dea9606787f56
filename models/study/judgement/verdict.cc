#include "models/study/judgement/verdict.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <tuple>
#include <variant>

#include "data/measurements/column_roles.h"
#include "models/study/judgement/extrapolated_rows.h"

namespace errmap::models {
namespace {

using Eigen::Index;

using IsMap = std::function<bool(std::size_t)>;

double RmseOf(const HoldoutComparison& comparison, std::size_t model) {
  return comparison.tests.rmse[*comparison.PlaceOf(model)];
}

// The model of lowest RMSE among those that `wanted` accepts.
std::optional<std::size_t> BestWhere(
    const HoldoutComparison& comparison,
    const std::function<bool(std::size_t)>& wanted) {
  std::optional<std::size_t> best;
  for (const std::size_t model : comparison.models) {
    if (!wanted(model)) continue;
    if (!best || RmseOf(comparison, model) < RmseOf(comparison, *best)) {
      best = model;
    }
  }
  return best;
}

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

std::optional<std::size_t> BestOf(const HoldoutComparison& comparison,
                                  const StudyResult& study,
                                  Choice choice) {
  return BestWhere(comparison, [&](std::size_t model) {
    return ChoiceOf(study.models[model]) == choice;
  });
}

// What does not matter beside the lowest error of all.
double MarginOf(const HoldoutComparison& comparison, double indifference) {
  return stats::Margin{.indifference = indifference}.Of(
      comparison.tests.rmse.minCoeff());
}

// That no model is better than `baseline` by more than the margin. A baseline
// of the lowest error may owe that to chance, so the bound is asked for there
// too. Without another model there is nothing to hold it against.
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

// How much a hold-out tells of another day, from 0: whole sessions, whole
// groups, another file, whole blocks, few sessions, rows. Of the same kind one
// that judges all sessions comes before one that judges the later ones alone.
// Sessions count as such from `fewest` on.
std::pair<int, bool> RankOf(const Holdout& holdout,
                            const HoldoutComparison& comparison,
                            Index fewest) {
  const auto kind = [&] {
    if (comparison.units.are_sessions &&
        static_cast<Index>(comparison.units.labels.size()) >= fewest) {
      return 0;
    }
    if (holdout.whole_groups && holdout.test_data == nullptr) return 1;
    if (holdout.test_data != nullptr) return 2;
    if (holdout.inner == InnerHoldout::kBlocks) return 3;
    if (holdout.whole_sessions) return 4;
    return 5;
  };
  return {kind(), holdout.forward};
}

// The first of the hold-outs that tell most.
std::optional<std::size_t> HoldoutThatTellsMost(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons,
    Index fewest_sessions) {
  std::optional<std::size_t> most;
  for (std::size_t h = 0; h < holdouts.size(); ++h) {
    if (comparisons[h].models.empty()) continue;
    if (!most ||
        RankOf(holdouts[h], comparisons[h], fewest_sessions) <
            RankOf(holdouts[*most], comparisons[*most], fewest_sessions)) {
      most = h;
    }
  }
  return most;
}

// What a promise is made by: two sessions say more of a third than any number
// of groups of the same days.
std::optional<std::size_t> StrictestHoldout(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons) {
  constexpr Index kFewestSessions = 2;
  return HoldoutThatTellsMost(holdouts, comparisons, kFewestSessions);
}

// Null where no later sessions were foretold.
const HoldoutComparison* ForwardOverSessions(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons) {
  for (std::size_t h = 0; h < holdouts.size(); ++h) {
    if (holdouts[h].forward && comparisons[h].units.are_sessions &&
        !comparisons[h].models.empty()) {
      return &comparisons[h];
    }
  }
  return nullptr;
}

// What a map is chosen by: with fewer sessions a fold lacks too much of what
// all rows have, and its errors tell maps apart less well than groups do.
std::optional<std::size_t> DecisiveHoldout(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons) {
  return HoldoutThatTellsMost(holdouts, comparisons, kFewestSessionsToDecide);
}

std::optional<InterpolationGap> MeasureGap(
    const std::vector<Holdout>& holdouts,
    const std::vector<HoldoutComparison>& comparisons) {
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
  InterpolationGap gap{*neighbours, *unseen, {}};
  for (const std::size_t model : comparisons[*neighbours].models) {
    if (!comparisons[*unseen].PlaceOf(model)) continue;
    gap.rows.push_back({model,
                        RmseOf(comparisons[*neighbours], model),
                        RmseOf(comparisons[*unseen], model)});
  }
  return gap;
}

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
std::vector<std::size_t> NearTheBest(
    const HoldoutComparison& comparison,
    const std::function<bool(std::size_t)>& wanted,
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

// The geometric mean over sessions: one that errs far more than the others, as
// the first may that were foretold from few, does not decide alone.
double TypicalRmse(const HoldoutComparison& comparison, std::size_t model) {
  const auto of_units = comparison.unit_rmse.col(*comparison.PlaceOf(model));
  return std::exp(
      of_units.array().max(std::numeric_limits<double>::min()).log().mean());
}

// The model of least typical error.
std::optional<std::size_t> MostTypical(const HoldoutComparison& comparison,
                                       const IsMap& wanted) {
  std::optional<std::size_t> best;
  for (const std::size_t model : comparison.models) {
    if (wanted(model) && (!best || TypicalRmse(comparison, model) <
                                       TypicalRmse(comparison, *best))) {
      best = model;
    }
  }
  return best;
}

// A constant, a line of one column or a plane of all: what a map must not lose
// to where it has never been.
bool IsSimple(const ModelResult& model) {
  if (model.baseline) return true;
  if (!model.final_fit || model.final_fit->history != nullptr) return false;
  const ModelDescription form = model.final_fit->model->Describe();
  const auto* polynomial = std::get_if<PolynomialForm>(&form);
  return polynomial != nullptr &&
         std::ranges::all_of(polynomial->terms, [](const PolynomialTerm& term) {
           return std::accumulate(term.powers.begin(), term.powers.end(), 0) ==
                  1;
         });
}

// A choice between the average of maps and what is simpler.
class BlendOrSimpler {
 public:
  /// `decides` chooses; `strictest` and `forward`, which may be null, veto.
  BlendOrSimpler(const HoldoutComparison& decides,
                 const std::vector<HoldoutComparison>& all,
                 std::size_t strictest,
                 const HoldoutComparison* forward,
                 const StudyResult& study,
                 const IsMap& is_map)
      : decides_(decides), forward_(forward), study_(study), is_map_(is_map) {
    vetoes_.push_back(&all[strictest]);
    if (forward != nullptr) vetoes_.push_back(forward);
  }

  // One choice among near-equals is a gamble, which an average of maps that
  // see the inputs differently is not: it is used unless a single map is
  // established to be better by days that are separate. An average that a
  // baseline beats, in the later sessions as well where these were foretold, is
  // no map at all. Folds lack sessions, so that a map of many columns looks
  // worse there than it is: a veto takes twice the error.
  struct Chosen {
    std::size_t model = 0;
    const HoldoutComparison* vetoed_by = nullptr;  // null: by none
  };
  Chosen Choose(std::size_t blend) const {
    const auto proven = BestWhere(decides_, [&](std::size_t model) {
      return is_map_(model) && model != blend &&
             decides_.units.separate_sessions && !IsVetoed(model) &&
             decides_.ThatItIsBetter(model, blend) == Confidence::kEstablished;
    });
    const std::size_t use = proven.value_or(blend);
    for (const HoldoutComparison* veto : vetoes_) {
      if (const auto simple = FarBetter(*veto, use)) {
        return {.model = *simple, .vetoed_by = veto};
      }
    }
    const auto baseline = BestWhere(decides_, [&](std::size_t model) {
      return is_map_(model) && study_.models[model].baseline;
    });
    const bool beaten =
        baseline && RmseOf(decides_, *baseline) < RmseOf(decides_, use) &&
        (forward_ == nullptr || !forward_->PlaceOf(*baseline) ||
         !forward_->PlaceOf(use) ||
         TypicalRmse(*forward_, *baseline) < TypicalRmse(*forward_, use));
    return {.model = beaten ? *baseline : use};
  }

 private:
  std::optional<std::size_t> FarBetter(const HoldoutComparison& veto,
                                       std::size_t model) const {
    constexpr double kFar = 2.0;
    const auto simple = MostTypical(veto, [&](std::size_t other) {
      return is_map_(other) && IsSimple(study_.models[other]);
    });
    return simple && veto.PlaceOf(model) &&
                   TypicalRmse(veto, model) > kFar * TypicalRmse(veto, *simple)
               ? simple
               : std::nullopt;
  }

  bool IsVetoed(std::size_t model) const {
    return std::ranges::any_of(vetoes_, [&](const HoldoutComparison* veto) {
      return FarBetter(*veto, model).has_value();
    });
  }

  const HoldoutComparison& decides_;
  const HoldoutComparison* forward_;
  const StudyResult& study_;
  const IsMap& is_map_;
  std::vector<const HoldoutComparison*> vetoes_;
};

// The first tier that holds a map: predictions alone cannot be run. Nothing is
// left in advice->first_tier where there is none.
void TakeFirstTier(const HoldoutComparison& comparison,
                   const IsMap& is_map,
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

// Of a tier, its baselines if it has some: fewest sensors, then fewest
// parameters, then the lowest error.
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
  if (advice->model != advice->first_tier.front()) {
    advice->within_tier = comparison.ThatItLosesAtMost(
        margin, advice->model, advice->first_tier.front());
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

// The cheapest map that loses at most the margin to `model`, which it is where
// that can be said of no other: fewest sensors, then fewest parameters.
std::size_t CheapestNear(std::size_t model,
                         const HoldoutComparison& comparison,
                         const StudyResult& study,
                         const IsMap& is_map,
                         double indifference) {
  const double margin =
      stats::Margin{.indifference = indifference}.Of(RmseOf(comparison, model));
  std::vector<std::size_t> near{model};
  for (const std::size_t other : comparison.models) {
    if (other != model && is_map(other) &&
        comparison.tests.ExcessAtMost(*comparison.PlaceOf(other),
                                      *comparison.PlaceOf(model)) <= margin) {
      near.push_back(other);
    }
  }
  return SimplestOf(near, comparison, study);
}

std::optional<Recommendation> Recommend(
    const data::Dataset& dataset,
    const std::vector<Holdout>& holdouts,
    const StudyResult& study,
    const std::vector<HoldoutComparison>& comparisons,
    const JudgeOptions& options) {
  const auto strictest = StrictestHoldout(holdouts, comparisons);
  const auto decisive = DecisiveHoldout(holdouts, comparisons);
  if (!strictest || !decisive) return std::nullopt;
  const HoldoutComparison& comparison = comparisons[*strictest];
  const HoldoutComparison& decides = comparisons[*decisive];
  const IsMap is_map = [&](std::size_t model) {
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
      const auto chosen =
          BlendOrSimpler(decides,
                         comparisons,
                         *strictest,
                         ForwardOverSessions(holdouts, comparisons),
                         study,
                         is_map)
              .Choose(*blend);
      advice.model = chosen.model;
      if (chosen.vetoed_by) advice.fails_in = chosen.vetoed_by->holdout;
    }
  }
  if (options.prefer == Prefer::kSmall) {
    advice.model = CheapestNear(
        advice.model, decides, study, is_map, options.indifference);
  }
  if (is_blend(advice.model)) {
    // Alone in its tier: the best of the others.
    advice.single = !is_blend(simplest)
                        ? simplest
                        : BestWhere(decides, [&](std::size_t model) {
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

}  // namespace

std::string_view ToString(Choose choose) {
  return choose == Choose::kBest    ? "best"
         : choose == Choose::kBlend ? "blend"
                                    : "auto";
}

std::string_view ToString(Prefer prefer) {
  return prefer == Prefer::kSmall ? "small" : "least-error";
}

std::string_view ToString(Choice choice) {
  switch (choice) {
    case Choice::kPolynomial:
      return "polynomial";
    case Choice::kNeural:
      return "neural";
    case Choice::kNoPracticalDifference:
      return "no practical difference";
    case Choice::kBlend:
      return "blend";
    case Choice::kBaseline:
      return "baseline";
    case Choice::kGiven:
      return "given";
  }
  return "";
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

Judgement JudgeStudy(const data::Dataset& dataset,
                     const std::vector<Holdout>& holdouts,
                     const StudyResult& study,
                     const JudgeOptions& options) {
  Judgement judgement;
  judgement.comparisons = CompareHoldouts(
      dataset, holdouts, study, options.indifference, options.seed);
  for (const HoldoutComparison& comparison : judgement.comparisons) {
    judgement.verdicts.push_back(
        comparison.models.empty()
            ? std::nullopt
            : std::optional(
                  JudgeHoldout(comparison, study, options.indifference)));
  }
  judgement.gap = MeasureGap(holdouts, judgement.comparisons);
  judgement.recommendation =
      Recommend(dataset, holdouts, study, judgement.comparisons, options);
  for (const ModelResult& model : study.models) {
    std::vector<GoalJudgement>& goals = judgement.goals.emplace_back();
    for (const HoldoutResult& result : model.holdouts) {
      goals.push_back(JudgeGoal(
          options.goal, result.test, result.ok() && !study.interrupted));
    }
  }
  return judgement;
}

std::vector<std::string> SensorsOf(const FittedModel& fitted) {
  std::vector<std::string> sensors;
  for (const TrainedInput& input : fitted.inputs) {
    if (data::IsSensor(input.column)) {
      sensors.push_back(input.column.name);
    }
  }
  return sensors;
}

}  // namespace errmap::models
