#include "cli/report/verdict_json.h"

#include <algorithm>
#include <cmath>

#include "cli/report/verdict_text.h"

namespace errmap::cli {
namespace {

using models::HoldoutComparison;

const std::string& NameOf(const Comparison& comparison, std::size_t model) {
  return comparison.study.models[model].name;
}

Json NameOrNull(const Comparison& comparison,
                const std::optional<std::size_t>& model) {
  return model ? Json(NameOf(comparison, *model)) : Json();
}

Json BoundsJson(const stats::Bounds95& bounds) {
  if (!bounds.exist()) return {nullptr, nullptr};
  return {bounds.lower, bounds.upper};
}

Json RmseBoundsJson(const Comparison& comparison,
                    std::size_t model,
                    std::size_t h) {
  const HoldoutComparison& tests = comparison.judgement.comparisons[h];
  stats::Bounds95 bounds =
      tests.tests.rmse_bounds[static_cast<std::size_t>(*tests.PlaceOf(model))];
  bounds.lower = std::max(bounds.lower, 0.0);
  return BoundsJson(bounds);
}

Json MeanTestJson(const std::optional<stats::MeanDifferenceTest>& test) {
  if (!test) return nullptr;
  return {{"statistic", test->test.statistic},
          {"df", test->degrees_of_freedom},
          {"p", test->test.p}};
}

Json MeetsGoalJson(const models::GoalJudgement& judged) {
  switch (judged.standing) {
    case models::GoalStanding::kMet:
      return true;
    case models::GoalStanding::kMetAfterRezeroing:
    case models::GoalStanding::kMissed:
      return false;
    default:
      return nullptr;
  }
}

Json PairJson(const Comparison& comparison,
              const HoldoutComparison& tests,
              std::size_t index) {
  const stats::PairComparison& pair = tests.tests.pairs[index];
  const models::Confidence confidence = tests.differ[index];
  const auto model = [&](Eigen::Index place) {
    return tests.models[static_cast<std::size_t>(place)];
  };
  return {{"a", NameOf(comparison, model(pair.a))},
          {"b", NameOf(comparison, model(pair.b))},
          {"holdout", tests.holdout},
          {"rmse_a", tests.tests.rmse[pair.a]},
          {"rmse_b", tests.tests.rmse[pair.b]},
          {"difference", pair.difference},
          {"ci95", BoundsJson(pair.bounds)},
          {"p", pair.sign_flip.test.p},
          {"p_holm", pair.p_holm},
          {"test", "sign-flip permutation"},
          {"exact", pair.sign_flip.exact},
          {"smallest_p", pair.sign_flip.smallest_p},
          {"unit_of_analysis", tests.units.name},
          {"units", tests.tests.num_units},
          {"lag1", pair.lag1.statistic},
          {"correlated", pair.correlated},
          {"established", confidence == models::Confidence::kEstablished},
          {"confidence", models::ToString(confidence)},
          {"tests",
           {{"wilcoxon",
             {{"statistic", pair.wilcoxon.test.statistic},
              {"p", pair.wilcoxon.test.p},
              {"exact", pair.wilcoxon.exact}}},
            {"memory_t",
             {{"statistic", pair.memory.test.statistic},
              {"df", pair.memory.effective_units - 1.0},
              {"p", pair.memory.test.p},
              {"p_holm", pair.p_memory_holm},
              {"memory", pair.memory.memory}}},
            {"block_t", MeanTestJson(pair.block_t)},
            {"corrected_t", MeanTestJson(pair.corrected_t)},
            {"diebold_mariano", MeanTestJson(pair.diebold_mariano)}}}};
}

}  // namespace

Json DisplayJson(const Comparison& comparison) {
  const data::Unit& unit = comparison.data.dataset.target().unit;
  return {{"unit", unit.display_symbol}, {"scale", unit.display_scale}};
}

Json UnitsJson(const Comparison& comparison, std::size_t h) {
  const HoldoutComparison& tests = comparison.judgement.comparisons[h];
  return {{"unit_of_analysis", tests.units.name},
          {"units", tests.tests.num_units},
          {"unit_labels", tests.units.labels}};
}

Json StandingJson(const Comparison& comparison,
                  std::size_t model,
                  std::size_t h) {
  const HoldoutComparison& tests = comparison.judgement.comparisons[h];
  const Eigen::Index place = *tests.PlaceOf(model);
  Json unit_rmse = Json::array();
  for (const double rmse : tests.unit_rmse.col(place)) {
    unit_rmse.push_back(rmse);
  }
  const models::GoalJudgement& goal = comparison.judgement.goals[model][h];
  return {{"ci95", RmseBoundsJson(comparison, model, h)},
          {"tier", tests.TierOf(model)},
          {"meets_goal", MeetsGoalJson(goal)},
          {"goal_standing", models::ToString(goal.standing)},
          {"unit_rmse", std::move(unit_rmse)}};
}

Json MemorisationJson(const models::ModelResult& model) {
  if (!model.memorisation) return nullptr;
  const models::Memorisation& found = *model.memorisation;
  return {{"train_r2", found.train_r2},
          {"shuffled_r2", found.shuffled_r2},
          {"weights_per_row", found.weights_per_row},
          {"effective_parameters", found.effective_parameters},
          {"learning", models::ToString(found.learning())},
          {"why_not", found.why_not.empty() ? Json() : Json(found.why_not)},
          {"sentence", MemorisationSentence(model)}};
}

Json GapJson(const Comparison& comparison) {
  const auto& gap = comparison.judgement.gap;
  if (!gap) return nullptr;
  Json models = Json::array();
  for (const models::InterpolationGap::Row& row : gap->rows) {
    models.push_back({{"model", NameOf(comparison, row.model)},
                      {"neighbours_rmse", row.neighbours_rmse},
                      {"unseen_rmse", row.unseen_rmse},
                      {"ratio", row.ratio()},
                      {"flatters", row.flatters()}});
  }
  return {{"neighbours", comparison.holdouts[gap->neighbours].name},
          {"unseen", comparison.holdouts[gap->unseen].name},
          {"warning", GapSentence(comparison)},
          {"models", std::move(models)}};
}

Json ComparisonsJson(const Comparison& comparison) {
  Json pairs = Json::array();
  for (const HoldoutComparison& tests : comparison.judgement.comparisons) {
    for (std::size_t i = 0; i < tests.tests.pairs.size(); ++i) {
      pairs.push_back(PairJson(comparison, tests, i));
    }
  }
  return pairs;
}

Json TiersJson(const Comparison& comparison) {
  Json tiers = Json::object();
  for (const HoldoutComparison& tests : comparison.judgement.comparisons) {
    Json& of_holdout = tiers[tests.holdout] = Json::array();
    for (const std::vector<Eigen::Index>& tier : tests.tests.tiers) {
      Json names = Json::array();
      for (const Eigen::Index place : tier) {
        names.push_back(
            NameOf(comparison, tests.models[static_cast<std::size_t>(place)]));
      }
      of_holdout.push_back(std::move(names));
    }
  }
  return tiers;
}

Json StabilityJson(const Comparison& comparison) {
  Json stability = Json::array();
  for (std::size_t h = 0; h < comparison.holdouts.size(); ++h) {
    const HoldoutComparison& tests = comparison.judgement.comparisons[h];
    if (tests.wins.empty()) continue;
    Json wins = Json::array();
    for (const models::WinShare& win : tests.wins) {
      wins.push_back(
          {{"model", NameOf(comparison, win.model)}, {"share", win.share}});
    }
    stability.push_back({{"holdout", tests.holdout},
                         {"repeats", comparison.holdouts[h].repeats},
                         {"wins", std::move(wins)}});
  }
  return stability;
}

Json VerdictsJson(const Comparison& comparison) {
  Json verdicts = Json::array();
  for (std::size_t h = 0; h < comparison.holdouts.size(); ++h) {
    const auto& verdict = comparison.judgement.verdicts[h];
    if (!verdict) continue;
    verdicts.push_back({{"holdout", verdict->holdout},
                        {"choice", models::ToString(verdict->choice)},
                        {"model", NameOf(comparison, verdict->best)},
                        {"rival", NameOrNull(comparison, verdict->rival)},
                        {"established", verdict->established()},
                        {"confidence", models::ToString(verdict->confidence)},
                        {"why", VerdictSentence(comparison, h)}});
  }
  return verdicts;
}

Json RecommendationJson(const Comparison& comparison) {
  const auto& advice = comparison.judgement.recommendation;
  if (!advice) return nullptr;
  const models::ModelResult& model = comparison.study.models[advice->model];
  const models::HoldoutResult& result = model.holdouts[advice->holdout];
  const models::GoalJudgement& goal =
      comparison.judgement.goals[advice->model][advice->holdout];
  Json tier = Json::array();
  for (const std::size_t member : advice->first_tier) {
    tier.push_back(NameOf(comparison, member));
  }
  std::string why = RecommendationSentence(comparison);
  for (const std::string& reason : Reasons(comparison)) why += " " + reason;
  return {
      {"choice", models::ToString(advice->choice)},
      {"model", model.name},
      {"holdout", comparison.holdouts[advice->holdout].name},
      {"rmse", result.test.rmse},
      {"ci95", RmseBoundsJson(comparison, advice->model, advice->holdout)},
      {"first_tier", std::move(tier)},
      {"best_baseline",
       advice->has_baseline ? Json(NameOf(comparison, advice->best_baseline))
                            : Json()},
      {"sensors", models::SensorsOf(*model.final_fit)},
      {"parameters", model.final_fit->model->num_parameters()},
      {"predict_ns", model.predict_ns},
      {"against_baseline",
       advice->has_baseline ? Json(models::ToString(advice->against_baseline))
                            : Json()},
      {"meets_goal", MeetsGoalJson(goal)},
      {"goal_standing", models::ToString(goal.standing)},
      {"extrapolated_share", advice->extrapolated_share},
      {"sentence", RecommendationSentence(comparison)},
      {"why", std::move(why)},
      {"reasons", Reasons(comparison)},
      {"caveats", Caveats(comparison)}};
}

}  // namespace errmap::cli
