#include "cli/report/report_view.h"

#include <algorithm>
#include <cmath>

#include "data/units.h"

namespace errmap::cli {
namespace {

template <typename T>
const T* Named(const std::vector<T>& list, const std::string& name) {
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const T& entry) {
        return entry.name == name;
      });
  return found == list.end() ? nullptr : &*found;
}

void ReadHoldouts(ReportView* view) {
  const ComponentRecord& component = *view->component;
  for (const models::HoldoutRecord& holdout : component.holdouts) {
    if (!holdout.name.empty()) view->holdouts.push_back(holdout.name);
  }
  if (component.recommendation) {
    view->decisive = component.recommendation->holdout;
  }
  if (view->decisive.empty() && !view->holdouts.empty()) {
    view->decisive = view->holdouts.back();
  }
  const models::HoldoutRecord* decisive = HoldoutOf(*view, view->decisive);
  view->decisive_is_unseen = decisive != nullptr && (decisive->whole_groups ||
                                                     decisive->whole_sessions);
  if (component.gap) view->neighbours = component.gap->neighbours;
  // The recommendation may follow the neighbours, where there are no groups.
  if (view->neighbours == view->decisive) view->neighbours.clear();
  for (const std::string& name : view->holdouts) {
    if (!view->neighbours.empty()) break;
    if (name != view->decisive) view->neighbours = name;
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

std::string RivalOf(const ReportView& view) {
  const ModelRecord* recommended = ModelOf(view, view.recommended);
  std::string second;
  for (const ModelRecord* model : view.models) {
    if (model == recommended || model->kind == models::ModelKind::kBaseline ||
        !std::isfinite(TestRmse(*model, view.decisive))) {
      continue;
    }
    if (recommended == nullptr || model->kind != recommended->kind) {
      return model->name;
    }
    if (second.empty()) second = model->name;
  }
  return second;
}

}  // namespace

const models::HoldoutRecord* HoldoutOf(const ReportView& view,
                                       const std::string& holdout) {
  return Named(view.component->holdouts, holdout);
}

const ModelRecord* ModelOf(const ReportView& view, const std::string& model) {
  return Named(view.component->models, model);
}

const ResultRecord* ResultOf(const ModelRecord& model,
                             const std::string& holdout) {
  for (const auto& [name, result] : model.results) {
    if (name == holdout) return &result;
  }
  return nullptr;
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
  view.rival = RivalOf(view);
  return view;
}

models::GoalJudgement GoalOf(const ReportView& view, const std::string& model) {
  const ResultRecord* result = ResultOf(view, model, view.decisive);
  if (result == nullptr) return {};
  return {.standing = result->goal_standing,
          .goal = view.component->goal,
          .rmse = result->test.rmse,
          .sd = result->test.sd,
          .offset = result->test.mean};
}

ErrorText ErrorTextOf(const ReportView& view) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const ModelRecord* model : view.models) {
    for (const std::string& holdout : view.holdouts) {
      const double rmse = TestRmse(*model, holdout);
      if (rmse > 0.0) smallest = std::min(smallest, rmse);
    }
  }
  if (!std::isfinite(smallest)) smallest = view.component->goal;
  return {data::Unit{.symbol = view.component->data.unit,
                     .quantity = data::Quantity::kOther,
                     .display_scale = view.scale,
                     .display_symbol = view.shown_unit},
          smallest};
}

std::string PrettyUnit(const std::string& symbol) {
  if (symbol == "um") return "µm";
  if (symbol == "degC") return "°C";
  if (symbol == "urad") return "µrad";
  return symbol;
}

}  // namespace errmap::cli
