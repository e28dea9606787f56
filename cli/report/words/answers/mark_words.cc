#include "cli/report/words/answers/mark_words.h"

#include <algorithm>

#include <fmt/format.h>

#include "cli/report/words/answers/component_numbers.h"

namespace errmap::report {
namespace {

using models::RecommendationRecord;
using models::RemarkKind;

bool Has(const RecommendationRecord& advice, RemarkKind ground) {
  return std::ranges::find(advice.grounds,
                           ground,
                           &models::RemarkRecord::kind) != advice.grounds.end();
}

std::string WhyRecommended(const ComponentNumbers& component) {
  const RecommendationRecord& advice = component.Advice();
  if (Has(advice, RemarkKind::kAveragesMaps)) {
    if (advice.decided_by != advice.holdout) {
      return fmt::format(
          "an average of maps: {} do not choose between them, and the average "
          "is the safer bet",
          CountOfUnits(component.record.data.sessions,
                       component.Holdout(advice.holdout)));
    }
    return "an average of maps: no single one is proven better, and the "
           "average is the safer bet";
  }
  if (Has(advice, RemarkKind::kProvenBetter)) {
    return "proven better than the average of maps";
  }
  if (Has(advice, RemarkKind::kSimpleHolds)) {
    return "a simple map: the average of maps errs far more where less is "
           "known";
  }
  if (Has(advice, RemarkKind::kSimplestOfTier) ||
      Has(advice, RemarkKind::kSimplestNearLowest)) {
    return "the simplest of those that are as good";
  }
  return "";
}

}  // namespace

std::string MarkWords(const ReportView& view) {
  const ComponentNumbers component(*view.component);
  const RecommendationRecord& advice = component.Advice();
  const auto by_error =
      std::ranges::find(view.models, advice.model, &ModelRecord::name);
  const bool lowest = by_error == view.models.begin();
  const std::string why = WhyRecommended(component);
  std::string text = "* recommended";
  if (lowest) {
    text += ": the lowest error";
  } else if (!why.empty()) {
    text += ", " + why;
  }
  const ResultRecord* const first =
      view.models.empty() ? nullptr
                          : ResultOf(*view.models.front(), view.decisive);
  const auto marked =
      std::ranges::count_if(view.models, [&](const ModelRecord* model) {
        const ResultRecord* const result = ResultOf(*model, view.decisive);
        return model->name != advice.model && result != nullptr &&
               result->tier == 1;
      });
  if (marked == 0) return text + ".";
  if (marked == 1 && !lowest && first != nullptr && first->tier == 1) {
    return text + "; = the lowest error here.";
  }
  return text +
         ". = as good as the lowest error: with 95 % certainty at most 5 % "
         "above it, or by what never matters (--indifference).";
}

}  // namespace errmap::report
