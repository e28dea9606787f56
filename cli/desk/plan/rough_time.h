#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cli/desk/plan/study_plan.h"

namespace errmap::desk {

/// Estimates the duration of a component's fits, in seconds, by counting the
/// operations of each kind of model. Good to a factor of about two.
double RoughSeconds(const models::ComponentPlan& component, int jobs);

/// Returns each model that suits the component, and the rough seconds of all
/// its fits, one after the other.
std::vector<std::pair<std::string, double>> RoughSecondsOfModels(
    const models::ComponentPlan& component);

/// Estimates the seconds of one fit to so many rows.
double RoughFitSeconds(const models::ModelRecipe& recipe,
                       const data::Dataset& dataset,
                       double rows);

/// The fastest models of a study, which together take at most a quarter of its
/// time; in the study's order. `seconds`: of all their fits, one after the
/// other.
struct FasterModels {
  std::vector<std::string> names;
  double seconds = 0.0;
};
FasterModels FasterModelsOf(const StudyPlan& plan);

/// Returns "2 s", "5 min", "3 h": a single digit, since the time is rough.
std::string RoughTimeText(double seconds);

}  // namespace errmap::desk
