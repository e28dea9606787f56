#include "cli/report/text/answers/mark_words.h"

#include <algorithm>

#include <fmt/format.h>

#include "cli/report/text/answers/component_numbers.h"

namespace errmap::report {

using models::RecommendationRecord;

std::string WhyRecommended(const ComponentNumbers& component) {
  const RecommendationRecord& advice = component.Advice();
  if (advice.proven_better_than) {
    return fmt::format("proven better than the average of maps, {} ({})",
                       *advice.proven_better_than,
                       component.RmseWithUnit(*advice.proven_better_than));
  }
  if (advice.fails_in) {
    return fmt::format(
        "a simple map: under {} the average of maps has more than twice the "
        "error",
        *advice.fails_in);
  }
  if (advice.single && advice.decided_by != advice.holdout) {
    return fmt::format("an average of maps: {} do not choose between them",
                       CountOfUnits(component.record.data.sessions,
                                    component.HoldoutOfAdvice()));
  }
  if (advice.single) {
    return fmt::format(
        "an average of maps: no single one is proven better. Best single map: "
        "{} ({})",
        *advice.single,
        component.RmseWithUnit(*advice.single));
  }
  if (advice.choice == models::Choice::kBaseline) {
    return "a baseline: no map with sensors is proven worth them";
  }
  if (advice.decided_by == advice.holdout &&
      std::ranges::find(advice.first_tier, advice.model) ==
          advice.first_tier.end()) {
    return "the fewest operations among maps about as good (--prefer small)";
  }
  if (advice.first_tier.size() < 2) return "";
  const std::string& lowest = advice.first_tier.front();
  return lowest == advice.model
             ? "the simplest of the equally good maps"
             : fmt::format("the simplest of the maps as good as {} ({})",
                           lowest,
                           component.RmseWithUnit(lowest));
}

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
  const bool marks_others =
      std::ranges::any_of(view.models, [&](const ModelRecord* model) {
        const ResultRecord* const result = ResultOf(*model, view.decisive);
        return model->name != advice.model && result != nullptr &&
               result->tier == 1;
      });
  if (!marks_others) return text + ".";
  return text +
         ". = marks the lowest error, or as good in practice (--indifference).";
}

}  // namespace errmap::report
