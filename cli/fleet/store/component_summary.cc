#include "cli/fleet/store/component_summary.h"

#include <algorithm>
#include <cmath>

#include "models/record_json.h"

namespace errmap::fleet {
namespace {

using models::FindNamed;
using models::FoldRecord;
using models::HoldoutRecord;
using models::ModelRecord;
using models::RecommendationRecord;
using models::ResultRecord;
using models::VerdictRecord;

// Seconds of the fit to all rows and of every fold.
double AddSeconds(const ModelRecord& model, double sum) {
  const auto add = [&](double seconds) {
    if (std::isfinite(seconds)) sum += seconds;
  };
  if (model.final) add(model.final->fit_seconds);
  for (const auto& [holdout, result] : model.results) {
    for (const FoldRecord& fold : result.folds) add(fold.fit.value.fit_seconds);
  }
  return sum;
}

SummaryMetricsRecord MetricsOf(const std::string& holdout,
                               const ResultRecord& result) {
  return {.holdout = holdout,
          .n = result.test.n,
          .rmse = result.test.rmse,
          .sd = result.test.sd,
          .mean = result.test.mean,
          .mae = result.test.mae,
          .range = result.test.range,
          .train_rmse = result.train.rmse,
          .ci95 = result.ci95,
          .tier = result.tier,
          .goal = result.goal_standing};
}

SummaryModelRecord ModelOf(const ModelRecord& model) {
  SummaryModelRecord summary;
  summary.name = model.name;
  summary.kind = model.kind;
  summary.choice = model.choice;
  summary.status = model.status;
  if (model.why) summary.why = *model.why;
  if (model.parameters) summary.parameters = *model.parameters;
  if (model.final) summary.fit_seconds = model.final->fit_seconds;
  for (const auto& [holdout, result] : model.results) {
    summary.results.push_back(MetricsOf(holdout, result));
  }
  return summary;
}

double RmseOf(const ComponentRecord& component,
              std::string_view model,
              std::string_view holdout) {
  const ModelRecord* const found = FindNamed(component.models, model);
  const ResultRecord* const result =
      found == nullptr ? nullptr : FindNamed(found->results, holdout);
  return result == nullptr ? kNotKnown : result->test.rmse;
}

SummaryRecommendationRecord RecommendationOf(const ComponentRecord& component) {
  const RecommendationRecord& found = *component.recommendation;
  SummaryRecommendationRecord summary;
  summary.choice = found.choice;
  summary.model = found.model;
  summary.holdout = found.holdout;
  summary.rmse = found.rmse;
  summary.ci95 = found.ci95;
  summary.uncompensated = RmseOf(component, "zero", found.holdout);
  summary.constant = RmseOf(component, "mean", found.holdout);
  summary.goal = found.goal_standing;
  summary.established = found.against_baseline == Confidence::kEstablished;
  summary.sensors = found.sensors;
  if (found.memory) {
    summary.longest_memory = found.memory->longest;
    summary.zeroed = found.memory->zeroed;
  }
  if (found.promise) summary.promise = found.promise->levels;
  summary.extrapolated_share = found.extrapolated_share;
  summary.sentence = found.sentence;
  return summary;
}

// Models from the most to the least worth keeping.
void SortByWorth(ComponentSummary* summary) {
  const std::string recommended =
      summary->recommendation ? summary->recommendation->model : "";
  const auto rank = [&](const SummaryModelRecord& model) {
    std::int64_t tier = 0;
    double rmse = 0.0;
    for (const SummaryMetricsRecord& result : model.results) {
      if (!summary->recommendation ||
          result.holdout != summary->recommendation->holdout) {
        continue;
      }
      tier = result.tier;
      rmse = std::isfinite(result.rmse) ? result.rmse : HUGE_VAL;
    }
    const bool is_baseline = model.kind == ModelKind::kBaseline;
    return std::tuple(model.name != recommended,
                      !is_baseline,
                      model.status != ModelStatus::kOk,
                      tier,
                      rmse);
  };
  std::ranges::stable_sort(summary->models, {}, rank);
}

std::string Dump(const ComponentSummary& summary) {
  return models::JsonText(summary, -1) + "\n";
}

void Shorten(std::string* text) {
  constexpr std::size_t kMost = 500;
  if (text->size() > kMost) text->resize(kMost);
}

}  // namespace

ComponentSummary Summarise(const ComponentRecord& component) {
  ComponentSummary summary;
  summary.name = component.name;
  summary.file = component.data.file;
  summary.sha256 = component.data.sha256;
  summary.rows = component.data.rows;
  summary.sessions = component.data.sessions;
  summary.target = component.data.target;
  summary.unit = component.data.unit;
  summary.display = component.display;
  summary.goal = component.goal;
  for (const HoldoutRecord& holdout : component.holdouts) {
    summary.holdouts.push_back({.name = holdout.name,
                                .folds = holdout.folds,
                                .unit_of_analysis = holdout.unit_of_analysis,
                                .units = holdout.units});
  }
  double seconds = 0.0;
  for (const ModelRecord& model : component.models) {
    summary.models.push_back(ModelOf(model));
    seconds = AddSeconds(model, seconds);
  }
  summary.fits_seconds = seconds;
  for (const VerdictRecord& verdict : component.verdict) {
    summary.verdicts.push_back({.holdout = verdict.holdout,
                                .choice = verdict.choice,
                                .model = verdict.model,
                                .established = verdict.established,
                                .confidence = verdict.confidence});
  }
  if (component.recommendation) {
    summary.status = ModelStatus::kOk;
    summary.recommendation = RecommendationOf(component);
  } else {
    summary.why = "every fit failed";
  }
  return summary;
}

std::string ToJsonText(ComponentSummary summary) {
  if (summary.why) Shorten(&*summary.why);
  for (SummaryModelRecord& model : summary.models) {
    if (model.why) Shorten(&*model.why);
  }
  std::string text = Dump(summary);
  if (text.size() <= kLongestSummary) return text;
  SortByWorth(&summary);
  while (text.size() > kLongestSummary && !summary.models.empty()) {
    summary.models.pop_back();
    ++summary.models_left_out;
    text = Dump(summary);
  }
  // Hundreds of sensors in one map.
  if (text.size() > kLongestSummary && summary.recommendation) {
    summary.recommendation->sensors.clear();
    text = Dump(summary);
  }
  return text;
}

ComponentSummary SummaryFromJsonText(std::string_view text) {
  return models::RecordFromText<ComponentSummary>(
      text,
      ComponentSummary().schema,
      "errmap compare with the same study and store rewrites it");
}

}  // namespace errmap::fleet
