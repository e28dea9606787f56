#include "models/comparison/compare.h"

#include <filesystem>
#include <memory>
#include <utility>

#include "data/csv.h"
#include "models/record.h"
#include "models/study/study_defaults.h"

namespace errmap::models {

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

}  // namespace errmap::models
