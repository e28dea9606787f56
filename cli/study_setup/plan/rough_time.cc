#include <algorithm>
#include <cmath>
#include <variant>

#include <fmt/format.h>

#include "cli/study_setup/plan/study_forecast.h"
#include "models/net/net_options.h"

namespace errmap::study_setup {
namespace {

// Value of a number among a recipe's options, or `fallback`.
double Option(const models::ModelRecipe& recipe,
              const std::string& key,
              double fallback) {
  for (const models::EffectiveOption& option : recipe.options()) {
    if (option.key != key) continue;
    if (const auto* const whole = std::get_if<std::int64_t>(&option.value)) {
      return static_cast<double>(*whole);
    }
    if (const auto* const number = std::get_if<double>(&option.value)) {
      return *number;
    }
  }
  return fallback;
}

bool HasText(const models::ModelRecipe& recipe,
             const std::string& key,
             const std::string& text) {
  const std::vector<models::EffectiveOption> options = recipe.options();
  return std::ranges::any_of(options, [&](const auto& option) {
    const auto* const found = std::get_if<std::string>(&option.value);
    return option.key == key && found != nullptr && *found == text;
  });
}

// An iteration passes all rows through all weights (two products) and the
// hidden nodes through their logistic functions, which weigh more in small
// nets. Measured on 400 x 4 to 20,000 x 5 and 600 x 200.
double NetSeconds(const models::ModelRecipe& recipe,
                  double rows,
                  double weights) {
  constexpr double kPerWeightAndRow = 1.2e-10;
  constexpr double kPerNodeAndRow = 3e-9;
  constexpr double kIterations = 1500.0;
  constexpr double kStartsOfCrossValidation = 3.5;
  if (!HasText(recipe, "rows", "all")) {
    const auto kept = static_cast<double>(models::NetOptions().rows);
    rows = std::min(rows, Option(recipe, "rows", kept));
  }
  const double hidden = Option(recipe, "hidden", 1.0);
  double per_iteration =
      rows * (kPerWeightAndRow * weights + kPerNodeAndRow * hidden);
  if (recipe.name().starts_with("net:lm")) {
    // Normal equations of the smaller side, and their factors.
    const double small = std::min(rows, weights);
    per_iteration += kPerWeightAndRow * small * small * (rows + weights);
  }
  const double starts =
      Option(recipe, "starts", 1.0) +
      (HasText(recipe, "wfactor", "cv") ? kStartsOfCrossValidation : 0.0);
  return std::min(
      starts * Option(recipe, "iterations", kIterations) * per_iteration,
      Option(recipe, "seconds", HUGE_VAL));
}

// Least squares in k columns takes m k^2, and every fit looks at each cell. A
// search among views fits each of them at many strengths, by cross-validation;
// beyond some fifty inputs it leaves their products out.
double PolynomialSeconds(const models::ModelRecipe& recipe,
                         const data::Dataset& dataset,
                         double rows) {
  constexpr double kPerProduct = 2.5e-10;
  constexpr double kPerCell = 4e-7;
  constexpr double kPerPairOfInputs = 4e-4;
  constexpr double kInputsOfProducts = 50.0;
  constexpr double kPerCellOfViews = 6e-7;
  const auto inputs = static_cast<double>(dataset.num_inputs());
  const auto known = recipe.NumCoefficients(dataset);
  const double columns =
      known ? static_cast<double>(*known) : 2.0 * inputs + 1.0;
  double seconds = rows * (kPerProduct * columns * columns + kPerCell * inputs);
  if (HasText(recipe, "view", "auto")) {
    const double multiplied = std::min(inputs, kInputsOfProducts);
    seconds += kPerPairOfInputs * multiplied * multiplied +
               kPerCellOfViews * rows * (inputs + 10.0);
  }
  return seconds;
}

}  // namespace

double RoughFitSeconds(const models::ModelRecipe& recipe,
                       const data::Dataset& dataset,
                       double rows) {
  constexpr double kLeast = 1e-6;
  switch (recipe.kind()) {
    case models::ModelKind::kNet:
      return NetSeconds(
          recipe,
          rows,
          static_cast<double>(recipe.NumCoefficients(dataset).value_or(1)));
    case models::ModelKind::kPolynomial:
      return kLeast + PolynomialSeconds(recipe, dataset, rows);
    default:
      return kLeast;
  }
}

std::vector<std::pair<std::string, double>> RoughSecondsOfModels(
    const models::ComponentPlan& component) {
  const data::Dataset& dataset = component.comparison.data.dataset;
  std::vector<double> rows_of_fits = {static_cast<double>(dataset.num_rows())};
  for (const models::Holdout& holdout : component.comparison.holdouts) {
    for (const stats::Fold& fold : holdout.folds) {
      rows_of_fits.push_back(static_cast<double>(fold.train.size()));
    }
  }
  std::vector<std::pair<std::string, double>> models;
  for (const auto& recipe : component.recipes) {
    if (recipe->WhatIsMissing(dataset)) continue;
    double seconds = 0.0;
    for (const double rows : rows_of_fits) {
      seconds += RoughFitSeconds(*recipe, dataset, rows);
    }
    models.emplace_back(recipe->name(), seconds);
  }
  return models;
}

double RoughSeconds(const models::ComponentPlan& component, int jobs) {
  const data::Dataset& dataset = component.comparison.data.dataset;
  double all = 0.0;
  double longest = 0.0;
  for (const auto& recipe : component.recipes) {
    if (recipe->WhatIsMissing(dataset)) continue;
    longest = std::max(
        longest,
        RoughFitSeconds(
            *recipe, dataset, static_cast<double>(dataset.num_rows())));
  }
  for (const auto& [model, seconds] : RoughSecondsOfModels(component)) {
    all += seconds;
  }
  return std::max(longest, all / jobs);
}

FasterModels FasterModelsOf(const StudyPlan& plan) {
  constexpr double kShare = 0.25;
  std::vector<std::pair<std::string, double>> all;
  double seconds = 0.0;
  for (const models::ComponentPlan& component : plan.components) {
    for (auto& [name, cost] : RoughSecondsOfModels(component)) {
      seconds += cost;
      const auto known =
          std::ranges::find(all, name, &std::pair<std::string, double>::first);
      if (known == all.end()) {
        all.emplace_back(std::move(name), cost);
      } else {
        known->second += cost;
      }
    }
  }
  std::vector<double> costs;
  for (const auto& [name, cost] : all) costs.push_back(cost);
  std::ranges::sort(costs);
  double together = 0.0;
  double dearest = -1.0;
  for (const double cost : costs) {
    together += cost;
    if (together > kShare * seconds) break;
    dearest = cost;
  }
  FasterModels faster;
  for (const auto& [name, cost] : all) {
    if (cost > dearest) continue;
    faster.names.push_back(name);
    faster.seconds += cost;
  }
  return faster;
}

std::string RoughTimeText(double seconds) {
  constexpr double kMinute = 60.0;
  constexpr double kHour = 3600.0;
  const auto rounded = [](double value) {
    const double unit = std::pow(10.0, std::floor(std::log10(value)));
    return std::round(value / unit) * unit;
  };
  if (seconds < 1.0) return "a second";
  if (seconds < kMinute) return fmt::format("{:g} s", rounded(seconds));
  if (seconds < kHour) {
    return fmt::format("{:g} min", rounded(seconds / kMinute));
  }
  return fmt::format("{:g} h", rounded(seconds / kHour));
}

}  // namespace errmap::study_setup
