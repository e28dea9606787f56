#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cli/desk/plan/study_plan.h"

namespace errmap::desk {

/// Rough duration of a component's fits, in seconds, by counting operations of
/// each kind of model: good to a factor of some three, for a dry run only.
double RoughSeconds(const models::ComponentPlan& component, int jobs);

/// Each model that suits the component, with the rough seconds of its fits one
/// after the other.
std::vector<std::pair<std::string, double>> RoughSecondsOfModels(
    const models::ComponentPlan& component);

/// Rough seconds of one fit to so many rows.
double RoughFitSeconds(const models::ModelRecipe& recipe,
                       const data::Dataset& dataset,
                       double rows);

/// "2 s", "5 min", "3 h": one digit says how rough it is.
std::string RoughTimeText(double seconds);

}  // namespace errmap::desk
