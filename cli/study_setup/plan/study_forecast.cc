#include "cli/study_setup/plan/study_forecast.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cli/report/number_text.h"
#include "cli/report/wrap_text.h"
#include "data/text.h"

namespace errmap::study_setup {
namespace {

// The last of those that hold out what is unseen, else the last.
std::size_t ShownHoldout(const std::vector<models::Holdout>& holdouts) {
  for (std::size_t h = holdouts.size(); h-- > 0;) {
    if (!holdouts[h].among_neighbours) return h;
  }
  return holdouts.size() - 1;
}

}  // namespace

StudyForecast::StudyForecast(const StudyPlan& plan, int jobs)
    : jobs_(jobs), fits_left_(plan.num_fits()) {
  for (const models::ComponentPlan& component : plan.components) {
    const data::Dataset& dataset = component.comparison.data.dataset;
    const auto& holdouts = component.comparison.holdouts;
    OfComponent& of = components_.emplace_back();
    of.holdout = ShownHoldout(holdouts);
    of.holdout_name = holdouts[of.holdout].name;
    of.unit = dataset.target().unit;
    for (const auto& recipe : component.recipes) {
      const auto rough = [&](auto rows) {
        return RoughFitSeconds(*recipe, dataset, static_cast<double>(rows));
      };
      OfModel& model = of.models.emplace_back();
      model.name = recipe->name();
      model.kind = recipe->kind();
      model.rough_all_rows = rough(dataset.num_rows());
      model.rough_left = model.rough_all_rows;
      for (const models::Holdout& holdout : holdouts) {
        std::vector<double>& of_folds = model.rough.emplace_back();
        for (const stats::Fold& fold : holdout.folds) {
          of_folds.push_back(rough(fold.train.size()));
          model.rough_left += of_folds.back();
        }
      }
    }
  }
}

void StudyForecast::Note(std::size_t component,
                         const models::FitProgress& fit) {
  const std::lock_guard lock(mutex_);
  OfComponent& of = components_[component];
  OfModel& model = of.models[fit.task.model];
  const double rough =
      fit.task.holdout < 0
          ? model.rough_all_rows
          : model.rough[static_cast<std::size_t>(fit.task.holdout)]
                       [fit.task.fold];
  --fits_left_;
  model.rough_left = std::max(0.0, model.rough_left - rough);
  for (Work* done : {&model.done, &of_kinds_[model.kind]}) {
    done->rough += rough;
    done->seconds += fit.seconds;
  }
  if (component != at_work_) best_ = {};
  at_work_ = component;
  if (fit.task.holdout != static_cast<std::ptrdiff_t>(of.holdout) ||
      !std::isfinite(fit.holdout_rmse) ||
      (!best_.map.empty() && fit.holdout_rmse >= best_rmse_)) {
    return;
  }
  best_rmse_ = fit.holdout_rmse;
  constexpr std::size_t kMostName = 24;
  best_ = {
      fmt::format("{} {}",
                  report::Squeezed(data::Printable(model.name), kMostName),
                  report::ErrorText(of.unit, best_rmse_).WithUnit(best_rmse_)),
      data::Printable(of.holdout_name)};
}

double StudyForecast::Rate(const OfModel& model) const {
  if (model.done.rough > 0.0) return model.done.seconds / model.done.rough;
  const auto kind = of_kinds_.find(model.kind);
  if (kind == of_kinds_.end()) return 1.0;
  // What a mean took teaches nothing of a cubic over 40 inputs: the rough time
  // of one fit stands beside what fits of the kind took.
  const double one = model.rough_all_rows;
  return (kind->second.seconds + one) / (kind->second.rough + one);
}

double StudyForecast::SecondsLeft() const {
  const std::lock_guard lock(mutex_);
  double seconds = 0.0;
  for (const OfComponent& component : components_) {
    for (const OfModel& model : component.models) {
      seconds += model.rough_left * Rate(model);
    }
  }
  return seconds / std::clamp(fits_left_, 1, jobs_);
}

StudyForecast::Best StudyForecast::BestSoFar() const {
  const std::lock_guard lock(mutex_);
  return best_;
}

}  // namespace errmap::study_setup
