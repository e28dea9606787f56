#include "models/comparison/compare.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "data/csv.h"
#include "data/input_error.h"
#include "data/text.h"
#include "models/recipe_catalog.h"
#include "models/record.h"
#include "models/study/rezero/rezeroed_study.h"
#include "models/study/study_defaults.h"
#include "models/uncertainty/add_uncertainty.h"

namespace errmap::models {
namespace {

Index FewestTrainingRows(const ComponentStudy& component) {
  constexpr std::size_t kFewestUsable = 2;
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  for (const Holdout& holdout : component.holdouts) {
    for (const stats::Fold& fold : holdout.folds) {
      fewest = std::min(fewest, fold.train.size());
    }
  }
  if (fewest < kFewestUsable) {
    throw data::InputError(
        fmt::format("{}: too few rows for every model: a fold trains on {}; "
                    "more data or another hold-out is needed",
                    data::PrintablePath(component.data.dataset.source()),
                    fewest));
  }
  return static_cast<Index>(fewest);
}

std::vector<std::unique_ptr<ModelRecipe>> MakeRecipes(
    const std::vector<std::string>& specs,
    const data::Dataset& dataset,
    Index fewest_training_rows,
    std::vector<std::string>* left_out,
    OwnRecipes own) {
  std::vector<std::unique_ptr<ModelRecipe>> recipes;
  if (specs.empty() && (own.recipes.empty() || own.beside_defaults)) {
    DefaultRecipes defaults = MakeDefaultRecipes(dataset, fewest_training_rows);
    if (left_out != nullptr) *left_out = std::move(defaults.left_out);
    recipes = std::move(defaults.recipes);
  }
  for (const std::string& spec : specs) recipes.push_back(MakeRecipe(spec));
  std::ranges::move(own.recipes, std::back_inserter(recipes));
  return recipes;
}

// What the recommended map needs, and what would make it better.
void AddAdvice(const StudyOptions& options, ComponentPlan* plan) {
  ComponentStudy* const component = &plan->comparison;
  const std::size_t h = component->judgement.recommendation->holdout;
  const std::size_t model = component->judgement.recommendation->model;
  if (model >= plan->recipes.size()) return;  // predictions made elsewhere
  const data::Dataset& dataset = component->data.dataset;
  const ModelResult& recommended = component->study.models[model];
  component->importance = ImportanceOfSensors(dataset,
                                              component->holdouts[h],
                                              recommended.holdouts[h],
                                              *recommended.final_fit,
                                              options.stop);
  component->session_worth = WorthOfASession(dataset,
                                             component->holdouts[h],
                                             *plan->recipes[model],
                                             recommended.holdouts[h],
                                             options);
}

}  // namespace

data::DatasetSelection SelectionLike(const data::Dataset& like,
                                     data::DatasetSelection selection) {
  selection.target = like.target().name;
  selection.inputs = like.InputNames();
  selection.exclude.clear();
  selection.group = like.groups().column;
  selection.keep_dead = true;
  selection.only_to_judge = true;
  return selection;
}

namespace {

ComponentStudy Compare(ComponentStudy component,
                       const data::DatasetSelection& selection,
                       const ComparisonOptions& options,
                       OwnRecipes own) {
  const data::Dataset& dataset = component.data.dataset;
  const data::Unit& unit = dataset.target().unit;
  component.goal = options.goal.value_or(kNotKnown);
  component.indifference =
      options.indifference.value_or(DefaultIndifference(unit));
  for (const std::string& words :
       options.holdouts.empty() ? DefaultHoldouts(dataset) : options.holdouts) {
    const stats::HoldoutSpec spec = stats::ParseHoldout(words);
    std::shared_ptr<const data::Dataset> test_data;
    if (spec.kind == stats::HoldoutKind::kFile) {
      test_data = std::make_shared<const data::Dataset>(
          data::MakeDataset(data::ReadCsv(spec.file),
                            SelectionLike(dataset, selection))
              .dataset);
    }
    component.holdouts.push_back(
        MakeHoldout(spec, dataset, options.seed, std::move(test_data)));
  }
  for (const std::string& words : HoldoutsBeside(component.holdouts, dataset)) {
    component.holdouts.push_back(
        MakeHoldout(stats::ParseHoldout(words), dataset, options.seed));
  }
  ComponentPlan plan =
      PlanModels(std::move(component), options.models, nullptr, std::move(own));
  RunComponent(&plan,
               {.seed = options.seed,
                .jobs = options.jobs,
                .stop = options.stop,
                .progress = options.progress});
  return std::move(plan.comparison);
}

}  // namespace

ComponentStudy CompareMaps(const std::string& file,
                           const data::DatasetSelection& selection,
                           const ComparisonOptions& options) {
  std::string sha256;
  const data::CsvTable table = data::ReadCsv(file, &sha256);
  return Compare({.name = std::filesystem::path(file).stem().string(),
                  .files = {{.file = file, .sha256 = sha256}},
                  .data = data::MakeDataset(table, selection)},
                 selection,
                 options,
                 {});
}

ComponentStudy CompareMaps(const data::Dataset& dataset,
                           const ComparisonOptions& options,
                           OwnRecipes own) {
  return Compare({.name = dataset.source(),
                  .files = {{.file = dataset.source(), .sha256 = {}}},
                  .data = {.dataset = dataset,
                           .dropped = {},
                           .remarks = {},
                           .faults = {}}},
                 {},
                 options,
                 std::move(own));
}

std::vector<std::string> ComponentPlan::HoldoutNames() const {
  std::vector<std::string> names;
  for (const Holdout& holdout : comparison.holdouts) {
    names.push_back(holdout.name);
  }
  return names;
}

std::vector<std::string> ComponentPlan::ModelNames() const {
  std::vector<std::string> names;
  for (const auto& recipe : recipes) names.push_back(recipe->name());
  return names;
}

int ComponentPlan::num_fits() const {
  std::size_t fits_per_model = 1;  // to all rows
  for (const Holdout& holdout : comparison.holdouts) {
    fits_per_model += holdout.folds.size();
  }
  return static_cast<int>(fits_per_model * recipes.size());
}

ComponentPlan PlanModels(ComponentStudy component,
                         const std::vector<std::string>& specs,
                         std::vector<std::string>* left_out,
                         OwnRecipes own) {
  const data::Dataset& dataset = component.data.dataset;
  std::vector<std::unique_ptr<ModelRecipe>> recipes = MakeRecipes(
      specs, dataset, FewestTrainingRows(component), left_out, std::move(own));
  component.first_added = recipes.size();
  auto baselines = MissingBaselines(dataset, recipes);
  component.num_added = baselines.size();
  std::ranges::move(baselines, std::back_inserter(recipes));
  return {.comparison = std::move(component),
          .recipes = std::move(recipes),
          .given = {}};
}

void RunComponent(ComponentPlan* plan,
                  StudyOptions options,
                  bool keep_fold_maps) {
  // In its place, which options.journal may know.
  ComponentStudy& component = plan->comparison;
  const data::Dataset& dataset = component.data.dataset;
  options.indifference = component.indifference;
  component.study =
      RunStudy(dataset, component.holdouts, plan->recipes, options);
  options.journal = nullptr;  // keeps fits of the study alone
  for (const GivenPredictions& given : plan->given) {
    component.study.models.push_back(
        JudgeGivenPredictions(given, dataset, component.holdouts));
  }
  std::optional<BeforeRezero> before;
  if (component.rezero) {
    before = RezeroStudy(dataset,
                         *component.rezero,
                         options.seed,
                         &component.holdouts,
                         &component.study);
  }
  component.judgement = JudgeStudy(dataset,
                                   component.holdouts,
                                   component.study,
                                   {component.indifference,
                                    component.goal,
                                    options.seed,
                                    component.choose,
                                    component.prefer,
                                    component.rezero.has_value()});
  if (component.judgement.recommendation && !component.study.interrupted) {
    const std::size_t h = component.judgement.recommendation->holdout;
    for (ModelResult& model : component.study.models) {
      if (!model.final_fit) continue;
      AddExperience(dataset, &*model.final_fit);
      // What a map promises holds where nobody re-zeroes it.
      const auto m =
          static_cast<std::size_t>(&model - component.study.models.data());
      AddUncertainty(dataset,
                     before ? before->holdouts[h] : component.holdouts[h],
                     before ? before->results[m][h] : model.holdouts[h],
                     &*model.final_fit);
    }
    // Sensors and sessions are weighed by maps as they are.
    if (!before) AddAdvice(options, plan);
  }
  if (before && component.judgement.recommendation) {
    component.rezero_worth =
        WorthOfRezero(dataset,
                      *component.rezero,
                      options.seed,
                      *before,
                      component.judgement.recommendation->holdout);
  }
  if (!keep_fold_maps) ForgetFoldMaps(&component.study);
}

}  // namespace errmap::models
