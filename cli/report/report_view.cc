#include "cli/report/report_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "data/units.h"

namespace errmap::report {
namespace {

void ReadHoldouts(ReportView* view) {
  const ComponentRecord& component = *view->component;
  for (const models::HoldoutRecord& holdout : component.holdouts) {
    if (!holdout.name.empty()) view->holdouts.push_back(holdout.name);
  }
  if (component.recommendation) {
    view->decisive = component.recommendation->holdout;
  }
  if (view->decisive.empty() && !view->holdouts.empty()) {
    view->decisive = view->holdouts.front();
  }
  const models::HoldoutRecord* decisive = HoldoutOf(*view, view->decisive);
  view->decisive_is_unseen = decisive != nullptr && (decisive->whole_groups ||
                                                     decisive->whole_sessions);
  const models::HoldoutRecord* later =
      LaterHoldoutOf(component, view->decisive);
  if (later != nullptr) view->later = later->name;
  if (component.gap) view->neighbours = component.gap->neighbours;
  // The recommendation may follow the neighbours, if there are no groups.
  if (view->neighbours == view->decisive) view->neighbours.clear();
  for (const std::string& name : view->holdouts) {
    if (!view->neighbours.empty()) break;
    if (name != view->decisive && name != view->later) view->neighbours = name;
  }
}

// Before everything else what can be used, then by error.
void OrderModels(ReportView* view) {
  for (const ModelRecord& model : view->component->models) {
    if (!model.name.empty()) view->models.push_back(&model);
  }
  std::stable_sort(view->models.begin(),
                   view->models.end(),
                   [&](const ModelRecord* a, const ModelRecord* b) {
                     const double x = TestRmse(*a, view->decisive);
                     const double y = TestRmse(*b, view->decisive);
                     if (std::isfinite(x) != std::isfinite(y)) {
                       return std::isfinite(x);
                     }
                     return std::isfinite(x) && x < y;
                   });
}

}  // namespace

const models::HoldoutRecord* HoldoutOf(const ReportView& view,
                                       const std::string& holdout) {
  return models::FindNamed(view.component->holdouts, holdout);
}

const ModelRecord* ModelOf(const ReportView& view, const std::string& model) {
  return models::FindNamed(view.component->models, model);
}

std::size_t PlaceOf(const ReportView& view, const ModelRecord& model) {
  return static_cast<std::size_t>(std::ranges::find(view.models, &model) -
                                  view.models.begin());
}

const ResultRecord* ResultOf(const ModelRecord& model,
                             const std::string& holdout) {
  return models::FindNamed(model.results, holdout);
}

const ResultRecord* ResultOf(const ReportView& view,
                             const std::string& model,
                             const std::string& holdout) {
  const ModelRecord* record = ModelOf(view, model);
  return record == nullptr ? nullptr : ResultOf(*record, holdout);
}

double TestRmse(const ModelRecord& model, const std::string& holdout) {
  const ResultRecord* result = ResultOf(model, holdout);
  return result == nullptr ? models::kNotKnown : result->test.rmse;
}

ReportView ViewOf(const ComponentRecord& component) {
  ReportView view;
  view.component = &component;
  view.name = component.name.empty() ? "unnamed component" : component.name;
  if (component.display.scale > 0.0) view.scale = component.display.scale;
  view.shown_unit = PrettyUnit(component.display.unit);
  ReadHoldouts(&view);
  OrderModels(&view);
  if (component.recommendation) {
    view.recommended = component.recommendation->model;
  }
  return view;
}

namespace {

// The roundings that a map of exact data leaves ask for no decimals.
double SmallestThatMatters(const std::vector<double>& errors) {
  constexpr double kRounding = 1e-6;  // of the largest
  double largest = 0.0;
  for (const double error : errors) largest = std::fmax(largest, error);
  double smallest = std::numeric_limits<double>::infinity();
  for (const double error : errors) {
    if (error > kRounding * largest) smallest = std::min(smallest, error);
  }
  return smallest;
}

ErrorText ErrorTextIn(const std::string& shown_unit,
                      const ComponentRecord& component) {
  std::vector<double> errors;
  for (const ModelRecord& model : component.models) {
    for (const auto& [holdout, result] : model.results) {
      errors.push_back(result.test.rmse);
    }
  }
  const double smallest = SmallestThatMatters(errors);
  return {data::Unit{.symbol = component.data.unit,
                     .quantity = data::Quantity::kOther,
                     .display_scale = component.display.scale,
                     .display_symbol = shown_unit},
          std::isfinite(smallest) ? smallest : component.goal};
}

}  // namespace

ErrorText ErrorTextOf(const ReportView& view) {
  return ErrorTextIn(view.shown_unit, *view.component);
}

ErrorText ErrorTextOf(const ComponentRecord& component) {
  return ErrorTextIn(component.display.unit, component);
}

std::string PrettyUnit(const std::string& symbol) {
  if (symbol == "um") return "µm";
  if (symbol == "degC") return "°C";
  if (symbol == "urad") return "µrad";
  return symbol;
}

bool IsOfLaterUnits(const models::HoldoutRecord& holdout) {
  return (holdout.whole_sessions || holdout.whole_groups) &&
         holdout.name.starts_with("forward:");
}

const models::HoldoutRecord* LaterHoldoutOf(const ComponentRecord& component,
                                            const std::string& decisive) {
  const models::HoldoutRecord* later = nullptr;
  for (const models::HoldoutRecord& holdout : component.holdouts) {
    if (IsOfLaterUnits(holdout) && holdout.name != decisive) {
      later = &holdout;
    }
  }
  return later;
}

std::string UnseenWords(const ReportView& view, const std::string& name) {
  const models::HoldoutRecord* holdout = HoldoutOf(view, name);
  if (holdout == nullptr) return "held-out rows";
  if (holdout->whole_groups || holdout->whole_sessions) {
    return (IsOfLaterUnits(*holdout) ? "later " : "unseen ") +
           holdout->unit_of_analysis;
  }
  return holdout->another_file       ? "another file"
         : holdout->among_neighbours ? "neighbours"
                                     : "held-out rows";
}

}  // namespace errmap::report
