#include "cli/verdict_text.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/number_text.h"
#include "cli/wrap_text.h"

namespace errmap::cli {
namespace {

using models::HoldoutResult;
using models::ModelResult;
using models::Verdict;

const ModelResult& Model(const Comparison& comparison, std::ptrdiff_t index) {
  return comparison.study.models[static_cast<std::size_t>(index)];
}

std::size_t IndexOf(const Comparison& comparison, const Verdict& verdict) {
  return static_cast<std::size_t>(&verdict - comparison.verdicts.data());
}

const HoldoutResult& Result(const Comparison& comparison,
                            std::ptrdiff_t model,
                            const Verdict& verdict) {
  return Model(comparison, model).holdouts[IndexOf(comparison, verdict)];
}

// The first hold-out that did not keep groups whole, if it has a winner.
const Verdict* NeighbourVerdict(const Comparison& comparison) {
  for (const Verdict& verdict : comparison.verdicts) {
    if (!verdict.whole_groups && verdict.best >= 0) return &verdict;
  }
  return nullptr;
}

std::string GroupNoun(const Comparison& comparison) {
  return comparison.data.dataset.groups().column;
}

// How the winner between neighbours fares on unseen groups, where they differ.
std::string DisagreementSentence(const Comparison& comparison) {
  const Verdict* unseen = models::DecisiveVerdict(comparison.verdicts);
  const Verdict* neighbours = NeighbourVerdict(comparison);
  if (unseen == nullptr || !unseen->whole_groups || neighbours == nullptr) {
    return "";
  }
  const ErrorText error = ErrorTextFor(comparison);
  if (neighbours->best == unseen->best) {
    return fmt::format(
        "Both agree on {}: between neighbours and on unseen {}s alike.",
        Model(comparison, unseen->best).name,
        GroupNoun(comparison));
  }
  const HoldoutResult& elsewhere =
      Result(comparison, neighbours->best, *unseen);
  return fmt::format(
      "The hold-outs disagree: {} wins where the held-out rows have "
      "neighbours of the same {} in the training rows ({}), but on whole "
      "{}s never seen ({}) it has {}.",
      Model(comparison, neighbours->best).name,
      GroupNoun(comparison),
      neighbours->holdout,
      GroupNoun(comparison),
      unseen->holdout,
      elsewhere.ok() ? error.WithUnit(elsewhere.test.rmse) : "failed");
}

std::string GoalSentence(const Comparison& comparison) {
  const Verdict* decisive = models::DecisiveVerdict(comparison.verdicts);
  if (!std::isfinite(comparison.goal) || decisive == nullptr) return "";
  const ErrorText error = ErrorTextFor(comparison);
  const double sd =
      Result(comparison, decisive->best, *decisive).test.residuals.sd;
  const data::Unit& unit = comparison.data.dataset.target().unit;
  if (!std::isfinite(sd)) return "";
  const bool met = sd < comparison.goal;
  return fmt::format(
      "The goal (sd below {}) is {} there: sd {}.",
      fmt::format("{:g}", comparison.goal * unit.display_scale) +
          (unit.display_symbol.empty() ? "" : " " + unit.display_symbol),
      met ? "met" : "not met",
      error.WithUnit(sd));
}

}  // namespace

ErrorText ErrorTextFor(const Comparison& comparison) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Verdict& verdict : comparison.verdicts) {
    if (verdict.best < 0) continue;
    smallest =
        std::min(smallest, Result(comparison, verdict.best, verdict).test.rmse);
  }
  return {comparison.data.dataset.target().unit, smallest};
}

std::string VerdictSentence(const Comparison& comparison,
                            const Verdict& verdict) {
  if (verdict.best < 0) {
    return fmt::format("Under {} no model could be fitted.", verdict.holdout);
  }
  const ErrorText error = ErrorTextFor(comparison);
  std::string sentence = fmt::format(
      "Under {} {} has the lowest error, {} RMSE",
      verdict.holdout,
      Model(comparison, verdict.best).name,
      error.WithUnit(Result(comparison, verdict.best, verdict).test.rmse));
  if (verdict.next >= 0) {
    sentence +=
        fmt::format("; next is {} with {}",
                    Model(comparison, verdict.next).name,
                    error(Result(comparison, verdict.next, verdict).test.rmse));
  }
  return sentence + ".";
}

std::string RecommendationSentence(const Comparison& comparison) {
  const Verdict* decisive = models::DecisiveVerdict(comparison.verdicts);
  if (decisive == nullptr) return "";
  const std::string& name = Model(comparison, decisive->best).name;
  if (decisive->whole_groups) {
    return fmt::format("For compensation on another day go by {}: use {}.",
                       decisive->holdout,
                       name);
  }
  const bool held_out_whole =
      std::any_of(comparison.verdicts.begin(),
                  comparison.verdicts.end(),
                  [](const Verdict& verdict) { return verdict.whole_groups; });
  return fmt::format(
      "By {}, use {}; how it does on another day is not known, since {}.",
      decisive->holdout,
      name,
      held_out_whole ? "no fit for whole groups held out succeeded"
      : comparison.data.dataset.has_groups()
          ? "no whole groups were held out (--holdout groups:K)"
          : "no whole cycles were held out (name their column with --group)");
}

std::vector<std::string> Caveats(const Comparison& comparison) {
  std::vector<std::string> caveats{
      "The order is by held-out RMSE alone; whether the differences are more "
      "than chance is not tested."};
  const Verdict* decisive = models::DecisiveVerdict(comparison.verdicts);
  if (decisive != nullptr &&
      Model(comparison, decisive->best).kind == models::ModelKind::kBaseline) {
    caveats.emplace_back(
        "No map does better than a constant: compensation by position or "
        "temperature is not worthwhile on these data.");
  }
  if (comparison.study.interrupted) {
    caveats.emplace_back("The run was interrupted; fits are incomplete.");
  }
  return caveats;
}

std::string VerdictParagraph(const Comparison& comparison) {
  std::vector<std::string> sentences;
  for (const Verdict& verdict : comparison.verdicts) {
    sentences.push_back(VerdictSentence(comparison, verdict));
  }
  if (models::DecisiveVerdict(comparison.verdicts) != nullptr) {
    sentences.push_back(DisagreementSentence(comparison));
    sentences.push_back(RecommendationSentence(comparison));
    sentences.push_back(GoalSentence(comparison));
    for (std::string& caveat : Caveats(comparison)) {
      sentences.push_back(std::move(caveat));
    }
    sentences.emplace_back(
        "Error = actual - nominal; compensate by minus the predicted error.");
  }
  std::erase(sentences, "");
  constexpr std::size_t kWidth = 80;
  return WrapText(fmt::format("{}", fmt::join(sentences, " ")), kWidth) + "\n";
}

}  // namespace errmap::cli
