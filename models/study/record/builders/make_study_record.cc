#include "models/study/record/make_study_record.h"

#include <algorithm>
#include <cstddef>

#include "data/sha256.h"
#include "fitting/parallel_for.h"
#include "models/export/program/map_program.h"
#include "models/export/program_cost.h"
#include "models/history/with_history.h"
#include "models/inner_folds.h"
#include "models/study/record/builders/parts.h"

namespace errmap::models {
namespace {

std::optional<std::string> TextOrNothing(const std::string& text) {
  return text.empty() ? std::optional<std::string>() : std::optional(text);
}

// For several files: their names, and the hash of their hashes.
InputFileRecord SourceOf(const std::vector<InputFileRecord>& files) {
  if (files.size() == 1) return files[0];
  InputFileRecord all;
  for (const InputFileRecord& file : files) {
    all.file += (all.file.empty() ? "" : ", ") + file.file;
    all.sha256 += file.sha256;
  }
  all.sha256 = data::Sha256(all.sha256);
  return all;
}

DataRecord MakeData(const ComponentStudy& study) {
  const data::Dataset& dataset = study.data.dataset;
  const InputFileRecord source = SourceOf(study.files);
  DataRecord record{
      .file = source.file,
      .sha256 = source.sha256,
      .rows = dataset.num_rows(),
      .target = dataset.target().name,
      .unit = dataset.target().unit.symbol,
      .inputs = dataset.InputNames(),
      .sensors = std::ranges::count_if(dataset.inputs(), data::IsReadBySensor),
      .time = TextOrNothing(study.data.time_column),
      .time_unit = "rows",
      .sessions = dataset.num_sessions(),
      .align = dataset.align(),
      .dropped = study.data.dropped,
      .faults = MakeFaultRecords(study.data),
      .remarks = study.data.remarks,
      .doubts = study.data.doubts,
      .reading = study.data.reading};
  // Data made in memory may know of no sessions.
  if (dataset.log() != nullptr) {
    record.session = TextOrNothing(dataset.log()->sessions.column);
    record.time_unit = dataset.log()->time_unit;
  }
  if (dataset.has_groups()) {
    record.group = dataset.groups().column;
    record.groups = std::ssize(dataset.groups().labels);
  }
  return record;
}

// Indices as 0-based data rows of the file.
std::vector<std::int64_t> RowsOf(const std::vector<Index>& indices,
                                 const data::Dataset& dataset) {
  std::vector<std::int64_t> rows;
  rows.reserve(indices.size());
  for (const Index index : indices) {
    rows.push_back(dataset.rows()[static_cast<std::size_t>(index)]);
  }
  return rows;
}

HoldoutRecord MakeHoldout(const ComponentStudy& study, std::size_t h) {
  const Holdout& holdout = study.holdouts[h];
  const HoldoutComparison& tests = study.judgement.comparisons[h];
  HoldoutRecord record{.name = holdout.name,
                       .folds = std::ssize(holdout.folds),
                       .whole_groups = holdout.whole_groups,
                       .whole_sessions = holdout.whole_sessions,
                       .among_neighbours = holdout.among_neighbours,
                       .another_file = holdout.test_data != nullptr,
                       .repeats = holdout.repeats,
                       .unit_of_analysis = tests.units.name,
                       .units = tests.tests.num_units,
                       .unit_labels = tests.units.labels};
  if (holdout.rows_of_training > 0) {
    record.rows_of_training = holdout.rows_of_training;
  }
  const data::Dataset& dataset = study.data.dataset;
  for (const stats::Fold& fold : holdout.folds) {
    record.inner.push_back(MakeInnerFolds(dataset.SelectRows(fold.train),
                                          {.inner_holdout = holdout.inner})
                               .text);
    record.train_rows.push_back(RowsOf(fold.train, dataset));
    record.test_rows.push_back(RowsOf(fold.test, holdout.Source(dataset)));
  }
  return record;
}

ResultRecord MakeResult(const ComponentStudy& study,
                        std::size_t model,
                        std::size_t h) {
  const HoldoutResult& result = study.study.models[model].holdouts[h];
  ResultRecord record;
  record.train = result.train;
  record.test = result.test;
  for (const FoldResult& fold : result.folds) {
    record.folds.push_back({.train_rmse = fold.train_rmse,
                            .test_rmse = fold.test_rmse,
                            .fit = {MakeFitRecord(fold.fit_seconds,
                                                  fold.summary,
                                                  fold.remarks,
                                                  fold.choices,
                                                  fold.starts)}});
  }
  const ResidualReport residuals =
      AssessResiduals(HeldOutResiduals(study, model, h));
  record.normality = MakeRecord(residuals.normality, residuals.monte_carlo);
  record.randomness = MakeRecord(residuals);
  const HoldoutComparison& tests = study.judgement.comparisons[h];
  record.ci95 = RmseInterval(tests, model);
  record.tier = tests.TierOf(model);
  record.goal_standing = study.judgement.goals[model][h].standing;
  record.meets_goal = MeetsGoal(record.goal_standing);
  const auto unit_rmse = tests.unit_rmse.col(*tests.PlaceOf(model));
  record.unit_rmse.assign(unit_rmse.begin(), unit_rmse.end());
  return record;
}

ShuffledTargetRecord MakeShuffledTargetRecord(const ShuffledTargetFit& found) {
  return {.train_r2 = found.train_r2,
          .shuffled_r2 = found.shuffled_r2,
          .weights_per_row = found.weights_per_row,
          .effective_parameters = found.effective_parameters,
          .learning = found.learning(),
          .why_not = TextOrNothing(found.why_not)};
}

// Nothing for a map that no controller could run.
LeftOut<StepCostRecord> StepCostOf(const FittedModel& map) {
  try {
    // How often rows come changes no operation.
    const ProgramCost cost = CostOf(MakeMapProgram(WithRowsEvery(map, 1.0)));
    return StepCostRecord{.additions = cost.additions,
                          .multiplications = cost.multiplications,
                          .divisions = cost.divisions,
                          .exponentials = cost.exponentials,
                          .state_bytes = cost.state_bytes};
  } catch (const std::invalid_argument&) {
    return {};
  }
}

// The cost of one prediction: as a controller runs it (`step`), with filters,
// or by its formula if no controller could.
PredictionCost CostOfOne(const FittedModel& map,
                         const LeftOut<StepCostRecord>& step) {
  if (step) return {step->multiplications, step->exponentials};
  return CostOf(map.model->Describe());
}

ModelRecord MakeModel(const ComponentStudy& study, std::size_t index) {
  const ModelResult& model = study.study.models[index];
  ModelRecord record;
  record.name = model.name;
  record.kind = model.kind;
  record.choice = ChoiceOf(model);
  record.baseline = model.baseline;
  record.options = MakeRecord(model.options);
  if (model.final_fit) {
    const FittedModel& map = *model.final_fit;
    record.parameters = map.model->num_parameters();
    record.equation = TextOrNothing(map.equation);
    record.sensors = SensorsOf(map);
    auto& inputs = record.inputs_used.emplace();
    for (const TrainedInput& input : map.inputs) {
      inputs.push_back(input.column.name);
    }
    record.step_cost = StepCostOf(map);
    if (CountsRows(map)) record.counts_rows = true;
    record.final = MakeFitRecord(model.final_fit_seconds,
                                 map.summary,
                                 map.remarks,
                                 map.choices,
                                 map.starts);
    if (map.regression != nullptr) {
      record.regression = *map.regression;
    }
  }
  if (model.memorisation) {
    record.memorisation = MakeShuffledTargetRecord(*model.memorisation);
  }
  record.status = model.ok() ? ModelStatus::kOk : ModelStatus::kFailed;
  if (!model.ok()) record.why = model.why();
  for (std::size_t h = 0; h < model.holdouts.size(); ++h) {
    if (!model.holdouts[h].ok()) continue;
    record.results.emplace_back(model.holdouts[h].holdout,
                                MakeResult(study, index, h));
  }
  record.predict_ns = model.predict_ns;
  return record;
}

}  // namespace

std::vector<FaultRecord> MakeFaultRecords(const data::PreparedDataset& data) {
  std::vector<FaultRecord> records;
  for (const data::ColumnFault& fault : data.faults) {
    records.push_back({.kind = fault.kind,
                       .column = data.dataset.ColumnOf(fault).name,
                       .rows = {fault.rows.begin(), fault.rows.end()},
                       .of_cells = fault.of_cells,
                       .value = fault.value,
                       .low = fault.low,
                       .high = fault.high});
  }
  return records;
}

ComponentRecord MakeComponentRecord(const ComponentStudy& study, int jobs) {
  ComponentRecord record;
  record.name = study.name;
  record.interrupted = study.study.interrupted;
  record.data = MakeData(study);
  record.goal = study.goal;
  record.indifference = study.indifference;
  const data::Unit& unit = study.data.dataset.target().unit;
  record.display = {.unit = unit.display_symbol, .scale = unit.display_scale};
  for (std::size_t h = 0; h < study.holdouts.size(); ++h) {
    record.holdouts.push_back(MakeHoldout(study, h));
  }
  record.models.resize(study.study.models.size());
  // The tests of a million residuals take seconds.
  fitting::ParallelFor(jobs, record.models.size(), [&](std::size_t i) {
    record.models[i] = MakeModel(study, i);
  });
  AddJudgement(study, &record);
  if (record.recommendation) {
    const std::size_t model = study.judgement.recommendation->model;
    record.recommendation->cost = CostOfOne(
        *study.study.models[model].final_fit, record.models[model].step_cost);
  }
  if (study.rezero_worth) record.rezero = MakeRezeroRecord(study);
  record.figures = MakeFiguresRecord(study);
  return record;
}

}  // namespace errmap::models
