#include "cli/report/text/answers/verdict_sentences.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "cli/report/number_text.h"
#include "data/text.h"
#include "stats/comparison/paired_comparison.h"

namespace errmap::report {
namespace {

using models::Choice;
using models::Confidence;
using models::FindNamed;
using models::HoldoutRecord;
using models::PairRecord;
using models::VerdictRecord;
using Kind = models::Obstacle::Kind;

// "10 cycles, at least 12 are needed where they may be of one session".
std::string ObstacleText(const ComponentNumbers& component,
                         const models::Obstacle& obstacle,
                         const HoldoutRecord& holdout) {
  const std::string found = component.CountOfHeldOut(obstacle.units, holdout);
  switch (obstacle.kind) {
    case Kind::kNone:
      return "";
    case Kind::kTooFewUnits:
      return fmt::format("{}, at least {} are needed for so many maps",
                         found,
                         obstacle.needed);
    case Kind::kPerhapsOneSession:
      return fmt::format("{}, perhaps of one session; at least {} are needed",
                         found,
                         obstacle.needed);
    case Kind::kTooManyPairs:
      return fmt::format("{} for {} pairs, at least {} are needed",
                         found,
                         obstacle.pairs,
                         obstacle.needed);
    case Kind::kTooFewSignPatterns:
      return fmt::format(
          "the sign-flip test drew too few patterns for {} pairs",
          obstacle.pairs);
  }
  return "";
}

// "p is 0.0002 over 60 cycles and 0.02 after Holm's correction for 28 pairs."
std::string PSentence(const PairRecord& pair, const HoldoutRecord& held) {
  return fmt::format(
      "p is {} over {}{}{}",
      PWords(pair.p),
      CountOfUnits(pair.units, held),
      pair.memory > 0.0 ? " (corrected for autocorrelation)" : "",
      pair.holm_pairs == 1
          ? ""
          : fmt::format(" and {} after Holm's correction for {}",
                        PWords(pair.p_holm),
                        Count(pair.holm_pairs, "pair")));
}

// Why a difference is not established, where something beside p tells it.
std::string ReasonAgainst(Confidence confidence,
                          const PairRecord& pair,
                          const std::string& units) {
  switch (confidence) {
    case Confidence::kUnitsCorrelated:
      return fmt::format(": neighbouring {} err alike", units);
    case Confidence::kMemoryNotExcluded:
      return fmt::format(
          ": with the autocorrelation that the order of {} cannot exclude, p "
          "is {}",
          units,
          PWords(pair.tests.memory_t.p_holm));
    case Confidence::kBlocksDisagree:
      return fmt::format(": {} runs of neighbouring {} differ (p {})",
                         stats::kBlocksOfUnits,
                         units,
                         PWords(pair.tests.block_t.p));
    default:
      return "";
  }
}

// "net:lm has 0.707 um less than net:scg (95 % 0.4 to 1.1). p is 0.0002 ..."
std::string TestSentence(const ComponentNumbers& component,
                         const VerdictRecord& verdict) {
  const std::string& worse = Require(verdict.rival);
  const PairRecord& pair = Require(models::FindPair(
      component.record, verdict.holdout, verdict.model, worse));
  const HoldoutRecord& held = component.Holdout(verdict.holdout);
  const std::string text = fmt::format(
      "{} has {} less error than {}{}{}",
      verdict.model,
      component.error.WithUnit(std::abs(pair.difference)),
      worse,
      component.Model(worse).baseline ? "" : ", the best map of another kind",
      component.In95(IntervalOfExcess(pair, worse)));
  if (!std::isfinite(pair.p)) {
    return text + ": they are the same map apart from rounding.";
  }
  const Confidence confidence = Require(verdict.against_rival);
  return fmt::format("{}. {}. {}{}.",
                     text,
                     PSentence(pair, held),
                     confidence == Confidence::kEstablished ? "Established"
                                                            : "Not established",
                     ReasonAgainst(confidence, pair, PluralOfUnit(held)));
}

std::string ChoiceSentence(const ComponentNumbers& component,
                           const VerdictRecord& verdict) {
  switch (verdict.choice) {
    case Choice::kNoPracticalDifference:
      return fmt::format(
          "A polynomial and a net share its first tier: no practical "
          "difference, {}established.",
          verdict.established ? "" : "not ");
    case Choice::kBaseline:
      return verdict.established
                 ? "No map is worth more than a baseline, established."
                 : "No map is proven better than a baseline.";
    default:
      break;
  }
  if (verdict.obstacle && verdict.confidence == Confidence::kOutOfReach) {
    return fmt::format(
        "This may be chance: {}.",
        ObstacleText(
            component, *verdict.obstacle, component.Holdout(verdict.holdout)));
  }
  if (!verdict.rival) return "";
  std::string text = TestSentence(component, verdict);
  if (!verdict.established &&
      Require(verdict.against_rival) == Confidence::kEstablished) {
    text +=
        fmt::format(" That it beats the best baseline, {}, is not established.",
                    verdict.best_baseline.value_or(""));
  }
  return text;
}

}  // namespace

std::string VerdictSentence(const ComponentNumbers& component,
                            const VerdictRecord& verdict) {
  std::string text =
      fmt::format("Under {} {} has the lowest error, {}",
                  verdict.holdout,
                  verdict.model,
                  component.RmseWithInterval(verdict.model, verdict.holdout));
  const std::vector<std::string>& first =
      First(Require(FindNamed(component.record.tiers, verdict.holdout)));
  if (first.size() > 1) {
    text += fmt::format(". As good in practice: {}",
                        ListBesides(first, verdict.model));
  }
  const std::string choice = ChoiceSentence(component, verdict);
  return text + "." + (choice.empty() ? "" : " " + choice);
}

std::string GapSentence(const ComponentNumbers& component) {
  const models::InterpolationGap& gap = Require(component.record.gap);
  std::vector<models::InterpolationGap::Row> flattered;
  std::ranges::copy_if(
      gap.models, std::back_inserter(flattered), [&](const auto& row) {
        return row.flatters && !component.Model(row.model).baseline;
      });
  if (flattered.empty()) return "";
  std::ranges::stable_sort(
      flattered, std::greater(), &models::InterpolationGap::Row::ratio);
  constexpr std::size_t kMostNamed = 2;
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < std::min(flattered.size(), kMostNamed); ++i) {
    const models::InterpolationGap::Row& row = flattered[i];
    parts.push_back(fmt::format("{} ({} against {}, {} times)",
                                row.model,
                                component.error(row.neighbours_rmse),
                                component.error.WithUnit(row.unseen_rmse),
                                RatioText(row.ratio)));
  }
  std::string text = fmt::format(
      "{} flatters {}", gap.neighbours, data::JoinWords(parts, ", "));
  if (flattered.size() > kMostNamed) {
    text += fmt::format(" and {} more", flattered.size() - kMostNamed);
  }
  return fmt::format(
      "{}. Its held-out rows lie next to training rows; whole {} ({}) do not.",
      text,
      PluralOfUnit(component.Holdout(gap.unseen)),
      gap.unseen);
}

std::string MemorisationSentence(const ModelRecord& model) {
  const models::ShuffledTargetRecord& found = *model.memorisation;
  std::string effective;
  if (std::isfinite(found.effective_parameters)) {
    effective =
        fmt::format(", {:.0f} of them effective", found.effective_parameters);
  }
  const std::string figures = fmt::format(
      "{:.2g} weights per row{}; fitted to shuffled targets it still explains "
      "{:.0f} % of their variance",
      found.weights_per_row,
      effective,
      kPercent * std::max(0.0, found.shuffled_r2));
  switch (found.learning) {
    case models::NoiseLearning::kUnknown:
      return fmt::format("Whether {} learns noise is not known: {}.",
                         model.name,
                         found.why_not.value_or(""));
    case models::NoiseLearning::kLittle:
    case models::NoiseLearning::kSome:
      return fmt::format("{} learns {} noise: {}.",
                         model.name,
                         models::ToString(found.learning),
                         figures);
    case models::NoiseLearning::kMuch:
      return fmt::format(
          "{} can memorise its rows: {}. Its training error says nothing; try "
          "a larger wfactor or fewer hidden nodes.",
          model.name,
          figures);
  }
  return "";
}

}  // namespace errmap::report
