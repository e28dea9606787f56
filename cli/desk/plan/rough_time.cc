#include "cli/desk/plan/rough_time.h"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "models/net/net_options.h"

namespace errmap::desk {
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
// nets. Measured for 20 nodes on two inputs and 60 on 37, 397 rows.
double NetSeconds(const models::ModelRecipe& recipe,
                  double rows,
                  double weights) {
  constexpr double kPerWeightAndRow = 2.5e-10;
  constexpr double kPerNodeAndRow = 6e-9;
  constexpr double kIterations = 1500.0;
  constexpr double kFitsOfCrossValidation = 30.0;
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
  const double fits =
      Option(recipe, "starts", 1.0) +
      (HasText(recipe, "wfactor", "cv") ? kFitsOfCrossValidation : 0.0);
  return std::min(
      fits * Option(recipe, "iterations", kIterations) * per_iteration,
      Option(recipe, "seconds", HUGE_VAL));
}

// Least squares in k columns takes m k^2; a selection among them weighs all
// columns against one another once, then steps.
double PolynomialSeconds(const models::ModelRecipe& recipe,
                         const data::Dataset& dataset,
                         double rows) {
  constexpr double kPerProduct = 1e-9;
  constexpr double kColumnsAtMost = 1e4;
  const auto known = recipe.NumCoefficients(dataset);
  double columns = 1.0;
  if (known) {
    columns = static_cast<double>(*known);
  } else {
    // All products of the inputs up to the degree: C(p + d, d).
    const auto inputs = static_cast<double>(dataset.num_inputs());
    const double degree = Option(recipe, "degree", 2.0);
    for (double d = 1.0; d <= degree; ++d) columns *= (inputs + d) / d;
  }
  columns = std::min(columns, kColumnsAtMost);
  return kPerProduct * rows * columns * columns;
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

}  // namespace errmap::desk
