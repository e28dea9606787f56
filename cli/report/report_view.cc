#include "cli/report/report_view.h"

#include <algorithm>
#include <cmath>

#include "data/units.h"

namespace errmap::cli {
namespace {

bool HoldsOutWholeGroups(const Json& holdout) {
  if (IsTrue(holdout, "whole_sessions")) return true;
  const Json& flag = At(holdout, "whole_groups");
  if (flag.is_boolean()) return flag.get<bool>();
  // Older documents tell by the name only.
  const std::string name = TextAt(holdout, "name");
  return name.starts_with("groups:") || name == "leave-one-group-out";
}

void ReadUnits(const Json& component, ReportView* view) {
  view->unit = TextOf(At(component, {"data", "unit"}));
  const data::Unit known = data::UnitOfSymbol(view->unit);
  view->shown_unit = known.display_symbol;
  view->scale = known.display_scale;
  const Json& display = At(component, "display");
  const double scale = NumberAt(display, "scale");
  if (std::isfinite(scale) && scale > 0.0) {
    view->scale = scale;
    view->shown_unit = TextAt(display, "unit");
  }
  view->shown_unit = PrettyUnit(view->shown_unit);
}

void ReadHoldouts(const Json& component, ReportView* view) {
  std::string grouped;
  const Json& holdouts = At(component, "holdouts");
  for (std::size_t i = 0; i < holdouts.size(); ++i) {
    const std::string name = TextAt(At(holdouts, i), "name");
    if (name.empty()) continue;
    view->holdouts.push_back(name);
    if (grouped.empty() && HoldsOutWholeGroups(At(holdouts, i))) grouped = name;
  }
  view->decisive = TextOf(At(component, {"recommendation", "holdout"}));
  if (view->decisive.empty()) view->decisive = grouped;
  if (view->decisive.empty() && !view->holdouts.empty()) {
    view->decisive = view->holdouts.back();
  }
  view->decisive_is_unseen =
      HoldsOutWholeGroups(Find(holdouts, "name", view->decisive));
  view->neighbours = TextOf(At(component, {"gap", "neighbours"}));
  // The recommendation may follow the neighbours, where there are no groups.
  if (view->neighbours == view->decisive) view->neighbours.clear();
  for (const std::string& name : view->holdouts) {
    if (!view->neighbours.empty()) break;
    if (name != view->decisive) view->neighbours = name;
  }
}

// Before everything else what can be used, then by error.
void OrderModels(ReportView* view) {
  std::stable_sort(view->models.begin(),
                   view->models.end(),
                   [&](const ViewedModel& a, const ViewedModel& b) {
                     const double x = TestRmse(*view, a.name, view->decisive);
                     const double y = TestRmse(*view, b.name, view->decisive);
                     if (std::isfinite(x) != std::isfinite(y)) {
                       return std::isfinite(x);
                     }
                     return std::isfinite(x) && x < y;
                   });
}

std::string RivalOf(const ReportView& view) {
  std::string kind;
  for (const ViewedModel& model : view.models) {
    if (model.name == view.recommended) kind = model.kind;
  }
  std::string second;
  for (const ViewedModel& model : view.models) {
    if (model.name == view.recommended || model.kind == "baseline" ||
        !std::isfinite(TestRmse(view, model.name, view.decisive))) {
      continue;
    }
    if (model.kind != kind) return model.name;
    if (second.empty()) second = model.name;
  }
  return second;
}

}  // namespace

const Json& ResultOf(const ReportView& view,
                     const std::string& model,
                     const std::string& holdout) {
  return At(Find(At(*view.component, "models"), "name", model),
            {"results", holdout});
}

double TestRmse(const ReportView& view,
                const std::string& model,
                const std::string& holdout) {
  return NumberOf(At(ResultOf(view, model, holdout), {"test", "rmse"}));
}

ReportView ViewOf(const Json& component) {
  ReportView view;
  view.component = &component;
  view.name = TextAt(component, "name");
  if (view.name.empty()) view.name = "unnamed component";
  view.goal = NumberAt(component, "goal");
  ReadUnits(component, &view);
  ReadHoldouts(component, &view);
  const Json& models = At(component, "models");
  for (std::size_t i = 0; i < models.size(); ++i) {
    const Json& model = At(models, i);
    if (TextAt(model, "name").empty()) continue;
    view.models.push_back({.name = TextAt(model, "name"),
                           .kind = TextAt(model, "kind"),
                           .ok = TextAt(model, "status") == "ok",
                           .json = &model});
  }
  OrderModels(&view);
  view.recommended = TextOf(At(component, {"recommendation", "model"}));
  view.rival = RivalOf(view);
  return view;
}

models::GoalJudgement GoalOf(const ReportView& view, const std::string& model) {
  const Json& result = ResultOf(view, model, view.decisive);
  const Json& test = At(result, "test");
  stats::ErrorMetrics metrics;
  metrics.rmse = NumberAt(test, "rmse");
  metrics.residuals.sd = NumberAt(test, "sd");
  metrics.residuals.mean = NumberAt(test, "mean");
  models::GoalJudgement judged = models::JudgeGoal(view.goal, metrics, true);
  // Older documents hold the figures only.
  judged.standing =
      models::GoalStandingFromString(TextAt(result, "goal_standing"))
          .value_or(judged.standing);
  return judged;
}

ErrorText ErrorTextOf(const ReportView& view) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const ViewedModel& model : view.models) {
    for (const std::string& holdout : view.holdouts) {
      const double rmse = TestRmse(view, model.name, holdout);
      if (rmse > 0.0) smallest = std::min(smallest, rmse);
    }
  }
  if (!std::isfinite(smallest)) smallest = view.goal;
  return {data::Unit{.symbol = view.unit,
                     .quantity = data::Quantity::kOther,
                     .display_scale = view.scale,
                     .display_symbol = view.shown_unit},
          smallest};
}

std::vector<double> Shown(const ReportView& view, std::vector<double> values) {
  for (double& value : values) value *= view.scale;
  return values;
}

std::string PrettyUnit(const std::string& symbol) {
  if (symbol == "um") return "µm";
  if (symbol == "degC") return "°C";
  if (symbol == "urad") return "µrad";
  return symbol;
}

}  // namespace errmap::cli
