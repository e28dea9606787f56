#include "cli/report/verdict_text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/shell/wrap_text.h"
#include "models/history/history.h"
#include "models/study/held_out_residuals.h"

namespace errmap::cli {

const char* const kIntervalCoverage =
    "95 % is nominal: simulated, 90-94 % (normal errors), 70-86 % (heavy "
    "tails)";

namespace {

using models::Choice;
using models::Confidence;
using models::GoalStanding;
using models::HoldoutComparison;
using Kind = models::Obstacle::Kind;
using models::HoldoutResult;
using models::ModelResult;
using models::Verdict;

const ModelResult& Model(const Comparison& comparison, std::size_t index) {
  return comparison.study.models[index];
}

const HoldoutComparison& Tests(const Comparison& comparison, std::size_t h) {
  return comparison.judgement.comparisons[h];
}

double Rmse(const Comparison& comparison, std::size_t model, std::size_t h) {
  return Model(comparison, model).holdouts[h].test.rmse;
}

// "0.938 um RMSE (95 % 0.786 to 1.093)"
std::string RmseWithInterval(const Comparison& comparison,
                             std::size_t model,
                             std::size_t h) {
  const ErrorText error = ErrorTextFor(comparison);
  const HoldoutComparison& tests = Tests(comparison, h);
  std::string text = error.WithUnit(Rmse(comparison, model, h)) + " RMSE";
  const stats::Bounds95& bounds =
      tests.tests.rmse_bounds[static_cast<std::size_t>(*tests.PlaceOf(model))];
  if (bounds.exist()) {
    text += fmt::format(" (95 % {} to {})",
                        error(std::max(0.0, bounds.lower)),
                        error(bounds.upper));
  }
  return text;
}

// "4.5"; a ratio beyond a thousand has no decimals that mean anything.
std::string RatioText(double ratio) {
  constexpr double kLarge = 1000.0;
  return ratio < kLarge ? fmt::format("{:.1f}", ratio)
                        : fmt::format("{:.2g}", ratio);
}

std::string ProbabilityText(double p) {
  constexpr double kSmallest = 1e-4;
  return p < kSmallest ? "below 0.0001" : fmt::format("{:.2g}", p);
}

// "0.707 um less RMSE than net:scg (95 % 0.4 to 1.1), p 0.0002 ..."
std::string TestSentence(const Comparison& comparison,
                         std::size_t h,
                         std::size_t better,
                         std::size_t worse) {
  const ErrorText error = ErrorTextFor(comparison);
  const HoldoutComparison& tests = Tests(comparison, h);
  const stats::PairComparison& pair =
      tests.tests.Pair(*tests.PlaceOf(better), *tests.PlaceOf(worse));
  // The pair may stand the other way round.
  const double sign = pair.a == *tests.PlaceOf(better) ? -1.0 : 1.0;
  const double low = sign > 0.0 ? pair.bounds.lower : -pair.bounds.upper;
  const double high = sign > 0.0 ? pair.bounds.upper : -pair.bounds.lower;
  std::string text = fmt::format("{} has {} less than {}",
                                 Model(comparison, better).name,
                                 error.WithUnit(sign * pair.difference),
                                 Model(comparison, worse).name);
  if (pair.bounds.exist()) {
    text += fmt::format(" (95 % {} to {})", error(low), error(high));
  }
  text += fmt::format(
      "; sign-flip p {} over {}, {} after Holm for {}",
      ProbabilityText(pair.sign_flip.test.p),
      tests.tests.num_units == 1
          ? "1 " + tests.units.name
          : fmt::format(
                "{} {}", tests.tests.num_units, PluralOfUnit(tests.units)),
      ProbabilityText(pair.p_holm),
      Count(static_cast<long long>(tests.tests.pairs.size()), "pair"));
  switch (tests.ThatItIsBetter(better, worse)) {
    case Confidence::kEstablished:
      return text + ": established.";
    case Confidence::kUnitsCorrelated:
      return text + fmt::format(
                        ", as if {} were independent; neighbouring ones "
                        "resemble each other: not established.",
                        PluralOfUnit(tests.units));
    case Confidence::kMemoryNotExcluded:
      return text + fmt::format(
                        ", as if {} were independent; with the memory that "
                        "their order cannot exclude {}: not established.",
                        PluralOfUnit(tests.units),
                        ProbabilityText(pair.p_memory_holm));
    case Confidence::kBlocksDisagree:
      return text + fmt::format(
                        ", as if {} were independent; {} runs of neighbouring "
                        "ones differ too much (p {}): not established.",
                        PluralOfUnit(tests.units),
                        stats::kBlocksOfUnits,
                        ProbabilityText(pair.block_t.test.p));
    default:
      return text + ": not established.";
  }
}

// "10 cycles, at least 12 are needed where they may be of one session"; ""
// where something could be established.
std::string ObstacleText(const models::Obstacle& obstacle) {
  const std::string found = Count(obstacle.units, "unit");
  switch (obstacle.kind) {
    case Kind::kNone:
      return "";
    case Kind::kTooFewUnits:
      return fmt::format(
          "{}, at least {} are needed: with fewer, no sign-flip p can be below "
          "0.05",
          found,
          obstacle.needed);
    case Kind::kPerhapsOneSession:
      return fmt::format(
          "{}, not known to be separate sessions: at least {} are needed to "
          "see whether they resemble each other",
          found,
          obstacle.needed);
    case Kind::kTooManyPairs:
      return fmt::format(
          "{} for {} pairs: at least {} are needed for a p below 0.05 after "
          "Holm's adjustment",
          found,
          obstacle.pairs,
          obstacle.needed);
    case Kind::kTooFewSignPatterns:
      return fmt::format("the sign patterns drawn are too few for {} pairs",
                         obstacle.pairs);
  }
  return "";
}

std::string ChoiceSentence(const Comparison& comparison,
                           std::size_t h,
                           const Verdict& verdict) {
  const HoldoutComparison& tests = Tests(comparison, h);
  switch (verdict.choice) {
    case Choice::kNoPracticalDifference:
      return fmt::format(
          "A polynomial and a net share its first tier: no practical "
          "difference, {}established.",
          verdict.established() ? "" : "not ");
    case Choice::kBaseline:
      return verdict.established()
                 ? "A baseline shares its first tier: no map is worth more "
                   "there, established."
                 : "A baseline shares its first tier: no map is known to be "
                   "worth more there.";
    default:
      break;
  }
  if (tests.obstacle.exists()) {
    return fmt::format(
        "Whether that is more than chance cannot be "
        "established: {}.",
        ObstacleText(tests.obstacle));
  }
  if (!verdict.rival) return "";
  std::string text = TestSentence(comparison, h, verdict.best, *verdict.rival);
  if (!verdict.established() &&
      tests.ThatItIsBetter(verdict.best, *verdict.rival) ==
          Confidence::kEstablished) {
    text += fmt::format(" That it beats the best baseline, {}, is not.",
                        Model(comparison, *verdict.best_baseline).name);
  }
  return text;
}

const models::Recommendation* Advice(const Comparison& comparison) {
  const auto& advice = comparison.judgement.recommendation;
  return advice ? &*advice : nullptr;
}

std::string NamesOf(const Comparison& comparison,
                    const std::vector<std::size_t>& models,
                    std::size_t besides) {
  std::vector<std::string> names;
  for (const std::size_t model : models) {
    if (model != besides) names.push_back(Model(comparison, model).name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

// "on cycles never seen (groups:5)", "on the rows of test.csv", ...
std::string WhereJudged(const Comparison& comparison, std::size_t h) {
  const models::Holdout& holdout = comparison.holdouts[h];
  if (holdout.whole_groups || holdout.whole_sessions) {
    return fmt::format("on {} never seen ({})",
                       PluralOfUnit(Tests(comparison, h).units),
                       holdout.name);
  }
  if (holdout.test_data != nullptr) {
    return fmt::format("on another file ({})", holdout.name);
  }
  if (holdout.among_neighbours) {
    return fmt::format("between neighbours ({})", holdout.name);
  }
  return fmt::format("under {}", holdout.name);
}

std::string GoalText(const Comparison& comparison) {
  const data::Unit& unit = comparison.data.dataset.target().unit;
  return fmt::format("{:g}", comparison.goal * unit.display_scale) +
         (unit.display_symbol.empty() ? "" : " " + unit.display_symbol);
}

std::string SensorText(const models::FittedModel& map) {
  const std::vector<std::string> sensors = models::SensorsOf(map);
  constexpr std::size_t kMostNamed = 8;
  if (sensors.empty()) return "no sensor";
  std::string text = Count(static_cast<long long>(sensors.size()), "sensor");
  if (sensors.size() <= kMostNamed) {
    text += fmt::format(" ({})", fmt::join(sensors, ", "));
  }
  return text;
}

std::string SimplestReason(const Comparison& comparison,
                           const models::Recommendation& advice) {
  const ErrorText error = ErrorTextFor(comparison);
  if (advice.simplest_single) {
    return fmt::format(
        "It averages maps that see the inputs differently, which gambles less "
        "than the choice of one; the simplest single map is {} ({}).",
        Model(comparison, *advice.simplest_single).name,
        error(Rmse(comparison, *advice.simplest_single, advice.holdout)));
  }
  if (advice.first_tier.size() < 2) return "";
  const HoldoutComparison& tests = Tests(comparison, advice.holdout);
  if (advice.model == advice.first_tier.front()) {
    return fmt::format(
        "It has the lowest error and is the simplest of its "
        "tier (the others: {}).",
        NamesOf(comparison, advice.first_tier, advice.model));
  }
  if (tests.tests.num_units < 2) {
    return fmt::format(
        "It is the simplest of those that are near the lowest "
        "error ({} of {}); more is not known.",
        error(Rmse(comparison, advice.first_tier.front(), advice.holdout)),
        Model(comparison, advice.first_tier.front()).name);
  }
  const double excess = tests.tests.ExcessAtMost(
      *tests.PlaceOf(advice.model), *tests.PlaceOf(advice.first_tier.front()));
  return fmt::format(
      "It is the simplest of a tier without practical difference: {} has the "
      "lowest error ({}), and with 95 % certainty{} it loses at most {} to it.",
      Model(comparison, advice.first_tier.front()).name,
      error(Rmse(comparison, advice.first_tier.front(), advice.holdout)),
      advice.within_tier != Confidence::kEstablished
          ? fmt::format(", as if {} were independent,",
                        PluralOfUnit(tests.units))
          : "",
      error.WithUnit(std::max(0.0, excess)));
}

// What the headline owes where the map is not surely worth its sensors.
std::string BaselineDoubt(const Comparison& comparison,
                          const models::Recommendation& advice) {
  if (!advice.has_baseline || advice.choice == Choice::kBaseline ||
      advice.against_baseline == Confidence::kEstablished) {
    return "";
  }
  const ErrorText error = ErrorTextFor(comparison);
  return fmt::format(
      " That it beats the best baseline, {} ({}), is not established.",
      Model(comparison, advice.best_baseline).name,
      error.WithUnit(Rmse(comparison, advice.best_baseline, advice.holdout)));
}

std::string BaselineReason(const Comparison& comparison,
                           const models::Recommendation& advice) {
  // Where that is not sure, the headline says it.
  if (!advice.has_baseline || advice.choice == Choice::kBaseline ||
      advice.against_baseline != Confidence::kEstablished) {
    return "";
  }
  const ErrorText error = ErrorTextFor(comparison);
  return fmt::format(
      "The best baseline, {}, has {}.",
      Model(comparison, advice.best_baseline).name,
      error.WithUnit(Rmse(comparison, advice.best_baseline, advice.holdout)));
}

std::string GapReason(const Comparison& comparison,
                      const models::Recommendation& advice) {
  const auto& gap = comparison.judgement.gap;
  if (!gap) return "";
  const ErrorText error = ErrorTextFor(comparison);
  for (const models::InterpolationGap::Row& row : gap->rows) {
    if (row.model != advice.model) continue;
    return fmt::format(
        "Between neighbours ({}) it has {}, on unseen {} {} times that.",
        comparison.holdouts[gap->neighbours].name,
        error.WithUnit(row.neighbours_rmse),
        PluralOfUnit(Tests(comparison, gap->unseen).units),
        RatioText(row.ratio()));
  }
  return "";
}

std::string GoalReason(const Comparison& comparison,
                       const models::Recommendation& advice) {
  const models::GoalJudgement& judged =
      comparison.judgement.goals[advice.model][advice.holdout];
  if (judged.standing == GoalStanding::kNone) return "";
  return fmt::format("The goal (RMSE at most {}) is {}: {}.",
                     GoalText(comparison),
                     models::ToString(judged.standing),
                     GoalFigures(judged, ErrorTextFor(comparison)));
}

// How far back a map looks, and what it starts from.
std::string MemoryText(const models::FittedModel& map) {
  if (map.history == nullptr) return "";
  double longest = 0.0;
  bool zeroes = false;
  for (const models::DerivedInput& input : map.history->derived) {
    longest = std::max(longest, input.tau);
    zeroes = zeroes || input.filter == models::Filter::kZero;
  }
  // After three time constants 5 % of a step is left.
  constexpr double kForgotten = 3.0;
  constexpr double kSecondsPerMinute = 60.0;
  constexpr double kMinutesPerHour = 60.0;
  std::string text;
  if (longest > 0.0) {
    const double span = kForgotten * longest;
    const double minutes = span / kSecondsPerMinute;
    text +=
        map.history->time_unit != "s"
            ? fmt::format(" over the last {:.0f} rows", span)
        : minutes < 2.0 * kMinutesPerHour
            ? fmt::format(" over the last {:.0f} min", minutes)
            : fmt::format(" over the last {:.2g} h", minutes / kMinutesPerHour);
  }
  if (zeroes) text += ", zeroed at the start of a session";
  return text;
}

std::string CostText(const models::FittedModel& map) {
  const models::PredictionCost cost = models::CostOf(map.model->Describe());
  const std::string products = Count(cost.multiplications, "multiplication");
  return cost.exponentials == 0
             ? products
             : fmt::format("{} and {}",
                           products,
                           Count(cost.exponentials, "exponential"));
}

std::string CostReason(const Comparison& comparison,
                       const models::Recommendation& advice) {
  const models::FittedModel& map = *Model(comparison, advice.model).final_fit;
  return fmt::format("It needs {}{}; a prediction costs {}.",
                     SensorText(map),
                     MemoryText(map),
                     CostText(map));
}

// What is left in its held-out residuals.
std::string ResidualReason(const Comparison& comparison,
                           const models::Recommendation& advice) {
  constexpr double kWorthSaying = 0.25;
  constexpr double kSignificance = 0.05;
  const models::ResidualReport report = models::AssessResiduals(
      HeldOutResiduals(comparison, advice.model, advice.holdout));
  const auto biased = [&](const std::optional<models::NamedBias>& by) {
    return by && by->bias.explained >= kWorthSaying &&
           by->bias.anova.p < kSignificance;
  };
  std::vector<std::string> parts;
  if (biased(report.by_group)) {
    parts.push_back(fmt::format("the means by {} explain {:.0f} %",
                                report.by_group->column,
                                100.0 * report.by_group->bias.explained));
  }
  if (biased(report.by_position)) {
    parts.push_back(fmt::format("the means by {} explain {:.0f} %",
                                report.by_position->column,
                                100.0 * report.by_position->bias.explained));
  }
  if (parts.empty()) return "";
  return fmt::format(
      "What it leaves is not noise: of its squared residuals there {}.",
      fmt::join(parts, ", "));
}

std::string UnseenCaveat(const Comparison& comparison,
                         const models::Recommendation& advice) {
  const models::Holdout& holdout = comparison.holdouts[advice.holdout];
  if (holdout.test_data != nullptr) return "";
  if (comparison.data.dataset.num_sessions() == 1) {
    return "One run only: nothing is known of another day.";
  }
  if (holdout.whole_groups || holdout.whole_sessions) return "";
  const bool held_out_whole = std::ranges::any_of(
      comparison.holdouts,
      [](const models::Holdout& other) { return other.whole_groups; });
  return fmt::format(
      "How it does on another day is not known, since {}.",
      held_out_whole ? "no fit for whole groups held out succeeded"
      : comparison.data.dataset.has_groups()
          ? "no whole groups were held out (--holdout groups:K)"
          : "no whole cycles were held out (name their column with --group)");
}

std::string UnitsCaveat(const Comparison& comparison,
                        const models::Recommendation& advice) {
  const HoldoutComparison& tests = Tests(comparison, advice.holdout);
  if (!tests.units.are_groups) {
    return fmt::format(
        "There are no groups: the tests count {} of held-out rows in order, "
        "which may still resemble each other.",
        Count(tests.tests.num_units, "block"));
  }
  if (tests.obstacle.kind == Kind::kTooFewUnits ||
      tests.obstacle.kind == Kind::kPerhapsOneSession) {
    return fmt::format("With {} nothing can be established: {}.",
                       Count(tests.tests.num_units, tests.units.name),
                       ObstacleText(tests.obstacle));
  }
  return "";
}

std::string CorrelationCaveat(const Comparison& comparison,
                              const models::Recommendation& advice) {
  const HoldoutComparison& tests = Tests(comparison, advice.holdout);
  const auto& verdict = comparison.judgement.verdicts[advice.holdout];
  if (!verdict || !verdict->rival) return "";
  const stats::PairComparison& pair = tests.tests.Pair(
      *tests.PlaceOf(verdict->best), *tests.PlaceOf(*verdict->rival));
  if (!pair.correlated) return "";
  const auto established =
      std::ranges::count(tests.differ, Confidence::kEstablished);
  return fmt::format(
      "Neighbouring {} resemble each other (lag-1 correlation {:.2f} of the "
      "loss differences), so p and intervals are too sure and {} under {} is "
      "called established; more days, held out whole, would tell.",
      PluralOfUnit(tests.units),
      pair.lag1.statistic,
      established == 0
          ? "nothing"
          : fmt::format("only what is free of that, {} of {},",
                        established,
                        Count(static_cast<long long>(tests.differ.size()),
                              "difference")),
      tests.holdout);
}

std::string ExtrapolationCaveat(const models::Recommendation& advice) {
  constexpr double kWorthSaying = 0.05;
  if (advice.extrapolated_share < kWorthSaying) return "";
  return fmt::format(
      "In {:.0f} % of the held-out rows an input lies outside what the fold "
      "was trained on: that is extrapolation, and more thermal states should "
      "be measured.",
      100.0 * advice.extrapolated_share);
}

// Another hold-out of unseen rows in whose first tier the map is not.
std::string DisagreementCaveat(const Comparison& comparison,
                               const models::Recommendation& advice) {
  const ErrorText error = ErrorTextFor(comparison);
  std::vector<std::string> parts;
  for (std::size_t h = 0; h < comparison.holdouts.size(); ++h) {
    const auto& verdict = comparison.judgement.verdicts[h];
    if (h == advice.holdout || comparison.holdouts[h].among_neighbours ||
        !verdict || Tests(comparison, h).TierOf(advice.model) < 2) {
      continue;
    }
    parts.push_back(
        fmt::format("under {} it has {}, {} has {}",
                    comparison.holdouts[h].name,
                    error.WithUnit(Rmse(comparison, advice.model, h)),
                    Model(comparison, verdict->best).name,
                    error(Rmse(comparison, verdict->best, h))));
  }
  if (parts.empty()) return "";
  return fmt::format("The hold-outs of unseen rows disagree: {}.",
                     fmt::join(parts, "; "));
}

std::string StabilityCaveat(const Comparison& comparison) {
  std::vector<std::string> parts;
  for (std::size_t h = 0; h < comparison.holdouts.size(); ++h) {
    const auto& wins = Tests(comparison, h).wins;
    if (wins.empty()) continue;
    constexpr std::size_t kMostNamed = 3;
    std::vector<std::string> shares;
    for (std::size_t i = 0; i < std::min(wins.size(), kMostNamed); ++i) {
      shares.push_back(fmt::format("{} {:.0f} %",
                                   Model(comparison, wins[i].model).name,
                                   100.0 * wins[i].share));
    }
    parts.push_back(fmt::format("of {} cuts of {} the lowest error went to {}",
                                comparison.holdouts[h].repeats,
                                comparison.holdouts[h].name,
                                fmt::join(shares, ", ")));
  }
  if (parts.empty()) return "";
  std::string text = fmt::format("{}.", fmt::join(parts, "; "));
  text.front() = 'O';
  return text;
}

std::string LimitCaveat(const Comparison& comparison,
                        const models::Recommendation& advice) {
  const ModelResult& model = Model(comparison, advice.model);
  if (model.final_fit->summary.converged()) return "";
  return fmt::format(
      "Its fit ended without converging ({}): another start or run length "
      "would give another map.",
      fitting::ToString(model.final_fit->summary.termination));
}

std::string MemorisationCaveat(const Comparison& comparison,
                               const models::Recommendation& advice) {
  const ModelResult& model = Model(comparison, advice.model);
  return model.memorisation ? MemorisationSentence(model) : "";
}

std::string BetterCaveat(const Comparison& comparison,
                         const models::Recommendation& advice) {
  if (!advice.better_but_no_map) return "";
  return fmt::format(
      "The predictions {} are better ({}), but there is no map of them here to "
      "use.",
      Model(comparison, *advice.better_but_no_map).name,
      ErrorTextFor(comparison)
          .WithUnit(
              Rmse(comparison, *advice.better_but_no_map, advice.holdout)));
}

void DropEmpty(std::vector<std::string>* sentences) {
  std::erase(*sentences, "");
}

}  // namespace

std::string PluralOfUnit(const models::UnitsOfAnalysis& units) {
  return units.are_groups ? units.name + "s" : "blocks of rows";
}

std::string GoalFigures(const models::GoalJudgement& judged,
                        const ErrorText& error) {
  switch (judged.standing) {
    case GoalStanding::kNone:
      return "";
    case GoalStanding::kNotJudged:
      return "the run was interrupted or a fit failed";
    case GoalStanding::kMetAfterRezeroing:
      return fmt::format("RMSE {}, sd {} about an offset of {}",
                         error.WithUnit(judged.rmse),
                         error.WithUnit(judged.sd),
                         error.WithUnit(judged.offset));
    case GoalStanding::kMet:
    case GoalStanding::kMissed:
      break;
  }
  return "RMSE " + error.WithUnit(judged.rmse);
}

std::string MemorisationSentence(const ModelResult& model) {
  if (!model.memorisation) return "";
  const models::Memorisation& found = *model.memorisation;
  std::string effective;
  if (std::isfinite(found.effective_parameters)) {
    effective =
        fmt::format(", {:.0f} of them effective", found.effective_parameters);
  }
  const std::string figures = fmt::format(
      "{:.2g} weights per row{}; fitted to shuffled targets it still explains "
      "{:.0f} % of them",
      found.weights_per_row,
      effective,
      100.0 * std::max(0.0, found.shuffled_r2));
  switch (found.learning()) {
    case models::NoiseLearning::kUnknown:
      return fmt::format("Whether {} learns noise is not known: {}.",
                         model.name,
                         found.why_not);
    case models::NoiseLearning::kLittle:
      return fmt::format("{} learns little noise: {}.", model.name, figures);
    case models::NoiseLearning::kSome:
      return fmt::format("{} learns some noise: {}.", model.name, figures);
    case models::NoiseLearning::kMuch:
      return fmt::format(
          "{} can learn its rows by heart: {}. Its training error says "
          "nothing; a larger wfactor or fewer hidden nodes would.",
          model.name,
          figures);
  }
  return "";
}

ErrorText ErrorTextFor(const Comparison& comparison) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const HoldoutComparison& tests : comparison.judgement.comparisons) {
    if (tests.models.empty()) continue;
    smallest = std::min(smallest, tests.tests.rmse.minCoeff());
  }
  return {comparison.data.dataset.target().unit, smallest};
}

std::string VerdictSentence(const Comparison& comparison, std::size_t h) {
  const auto& verdict = comparison.judgement.verdicts[h];
  const std::string& name = comparison.holdouts[h].name;
  if (!verdict) {
    return fmt::format("Under {} no model could be fitted.", name);
  }
  const std::vector<Eigen::Index>& tier =
      Tests(comparison, h).tests.tiers.front();
  std::vector<std::size_t> first;
  for (const Eigen::Index place : tier) {
    first.push_back(
        Tests(comparison, h).models[static_cast<std::size_t>(place)]);
  }
  std::string text =
      fmt::format("Under {} {} has the lowest error, {}",
                  name,
                  Model(comparison, verdict->best).name,
                  RmseWithInterval(comparison, verdict->best, h));
  if (first.size() > 1) {
    text += fmt::format("; without practical difference to it: {}",
                        NamesOf(comparison, first, verdict->best));
  }
  const std::string choice = ChoiceSentence(comparison, h, *verdict);
  return text + "." + (choice.empty() ? "" : " " + choice);
}

std::string RecommendationSentence(const Comparison& comparison) {
  const models::Recommendation* advice = Advice(comparison);
  if (advice == nullptr) return "";
  const ModelResult& model = Model(comparison, advice->model);
  const std::string error =
      fmt::format("{} {}",
                  RmseWithInterval(comparison, advice->model, advice->holdout),
                  WhereJudged(comparison, advice->holdout));
  const std::string doubt = BaselineDoubt(comparison, *advice);
  switch (advice->choice) {
    case Choice::kBaseline:
      if (model.name == "zero") {
        return fmt::format(
            "Compensate with nothing: no map {} better than none, {}.",
            advice->against_baseline == Confidence::kEstablished
                ? "does"
                : "is known to do",
            error);
      }
      return fmt::format(
          "Compensate with nothing better than {}: {}.", model.name, error);
    case Choice::kNoPracticalDifference:
      return fmt::format(
                 "Polynomial or net makes no practical difference: "
                 "use {}, {}.",
                 model.name,
                 error) +
             doubt;
    default:
      return fmt::format("Use {} ({}): {}.",
                         model.name,
                         models::ToString(advice->choice),
                         error) +
             doubt;
  }
}

std::vector<std::string> Reasons(const Comparison& comparison) {
  const models::Recommendation* advice = Advice(comparison);
  if (advice == nullptr) return {};
  std::vector<std::string> reasons{SimplestReason(comparison, *advice),
                                   BaselineReason(comparison, *advice),
                                   GapReason(comparison, *advice),
                                   GoalReason(comparison, *advice),
                                   CostReason(comparison, *advice),
                                   ResidualReason(comparison, *advice)};
  DropEmpty(&reasons);
  return reasons;
}

std::vector<std::string> Caveats(const Comparison& comparison) {
  const models::Recommendation* advice = Advice(comparison);
  std::vector<std::string> caveats;
  if (comparison.study.interrupted) {
    caveats.emplace_back("The run was interrupted; fits are incomplete.");
  }
  if (advice == nullptr) return caveats;
  caveats.push_back(UnseenCaveat(comparison, *advice));
  caveats.push_back(UnitsCaveat(comparison, *advice));
  caveats.push_back(DisagreementCaveat(comparison, *advice));
  caveats.push_back(CorrelationCaveat(comparison, *advice));
  caveats.push_back(ExtrapolationCaveat(*advice));
  caveats.push_back(LimitCaveat(comparison, *advice));
  caveats.push_back(MemorisationCaveat(comparison, *advice));
  caveats.push_back(StabilityCaveat(comparison));
  caveats.push_back(BetterCaveat(comparison, *advice));
  DropEmpty(&caveats);
  return caveats;
}

std::string GapSentence(const Comparison& comparison) {
  const auto& gap = comparison.judgement.gap;
  if (!gap) return "";
  std::vector<models::InterpolationGap::Row> flattered;
  std::ranges::copy_if(
      gap->rows, std::back_inserter(flattered), [&](const auto& row) {
        return row.flatters() && !Model(comparison, row.model).baseline;
      });
  if (flattered.empty()) return "";
  std::ranges::stable_sort(
      flattered, std::greater(), [](const auto& row) { return row.ratio(); });
  constexpr std::size_t kMostNamed = 4;
  const ErrorText error = ErrorTextFor(comparison);
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < std::min(flattered.size(), kMostNamed); ++i) {
    const auto& row = flattered[i];
    parts.push_back(fmt::format("{} ({} against {}, {} times)",
                                Model(comparison, row.model).name,
                                error(row.neighbours_rmse),
                                error.WithUnit(row.unseen_rmse),
                                RatioText(row.ratio())));
  }
  std::string text = fmt::format("Warning: {} flatters {}",
                                 comparison.holdouts[gap->neighbours].name,
                                 fmt::join(parts, ", "));
  if (flattered.size() > kMostNamed) {
    text += fmt::format(" and {} more", flattered.size() - kMostNamed);
  }
  return text +
         ": its held-out rows have neighbours in the training rows, whole " +
         PluralOfUnit(Tests(comparison, gap->unseen).units) + " (" +
         comparison.holdouts[gap->unseen].name + ") have not.";
}

std::string VerdictParagraphs(const Comparison& comparison) {
  constexpr std::size_t kWidth = 80;
  std::vector<std::vector<std::string>> paragraphs;
  for (std::size_t h = 0; h < comparison.holdouts.size(); ++h) {
    paragraphs.push_back({VerdictSentence(comparison, h)});
  }
  paragraphs.push_back({GapSentence(comparison)});
  std::vector<std::string> advice{RecommendationSentence(comparison)};
  for (std::string& reason : Reasons(comparison)) {
    advice.push_back(std::move(reason));
  }
  paragraphs.push_back(std::move(advice));
  paragraphs.push_back(Caveats(comparison));
  if (Advice(comparison) != nullptr) {
    paragraphs.push_back(
        {"Error = actual - nominal; compensate by minus the predicted error."});
  }
  std::string text;
  for (std::vector<std::string>& sentences : paragraphs) {
    DropEmpty(&sentences);
    if (sentences.empty()) continue;
    text += (text.empty() ? "" : "\n") +
            WrapText(fmt::format("{}", fmt::join(sentences, " ")), kWidth) +
            "\n";
  }
  return text;
}

}  // namespace errmap::cli
