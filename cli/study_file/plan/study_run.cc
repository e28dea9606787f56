#include "cli/study_file/plan/study_run.h"

#include <utility>

#include "cli/study_file/data_arguments.h"
#include "models/promise/promise.h"

namespace errmap::cli {
namespace {

// Runs a component's study, its fits kept in the journal if there is one.
models::StudyResult RunJournalled(const ComponentPlan& component,
                                  models::StudyOptions study_options,
                                  const RunOptions& options) {
  const Comparison& comparison = component.comparison;
  const auto run = [&] {
    return models::RunStudy(comparison.data.dataset,
                            comparison.holdouts,
                            component.recipes,
                            study_options);
  };
  if (options.journal == nullptr) return run();
  const models::FitLabels labels(comparison.name,
                                 comparison.data.dataset,
                                 comparison.holdouts,
                                 component.recipes,
                                 study_options);
  if (options.describe_resume) {
    for (const auto& line : models::DescribeResume(*options.journal, labels)) {
      Say(line);
    }
  }
  models::ComponentJournal journal(
      options.journal, &labels, &comparison.data.dataset, &comparison.holdouts);
  study_options.journal = &journal;
  return run();
}

}  // namespace

StudyRun RunPlan(StudyPlan plan,
                 const std::string& command_line,
                 const RunOptions& options) {
  const int all = plan.num_fits();
  StudyRun run{.seed = plan.config.seed,
               .command_line = command_line,
               .config = std::move(plan.config),
               .inputs = std::move(plan.inputs),
               .components = {},
               .interrupted = false};
  int before = 0;  // fits of the components that are finished
  for (ComponentPlan& component : plan.components) {
    Comparison& comparison = component.comparison;
    models::StudyOptions study_options{
        .seed = run.seed,
        .jobs = options.jobs,
        .stop = options.stop,
        .indifference = comparison.indifference,
        .progress = [&](const models::FitProgress& fit) {
          if (!options.progress) return;
          models::FitProgress of_plan = fit;
          of_plan.done += before;
          of_plan.all = all;
          options.progress(run.components.size(), of_plan);
        }};
    comparison.study = RunJournalled(component, study_options, options);
    const data::Dataset& dataset = comparison.data.dataset;
    for (const models::GivenPredictions& given : component.given) {
      comparison.study.models.push_back(
          models::JudgeGivenPredictions(given, dataset, comparison.holdouts));
    }
    comparison.judgement = models::JudgeStudy(
        dataset,
        comparison.holdouts,
        comparison.study,
        {comparison.indifference, comparison.goal, run.seed});
    run.interrupted = comparison.study.interrupted;
    if (comparison.judgement.recommendation && !run.interrupted) {
      const std::size_t h = comparison.judgement.recommendation->holdout;
      for (models::ModelResult& model : comparison.study.models) {
        if (!model.final_fit) continue;
        models::AddApplicability(dataset, &*model.final_fit);
        models::AddPromise(dataset,
                           comparison.holdouts[h],
                           model.holdouts[h],
                           &*model.final_fit);
      }
      const std::size_t model = comparison.judgement.recommendation->model;
      if (model < component.recipes.size()) {
        const models::ModelResult& recommended = comparison.study.models[model];
        comparison.importance =
            models::ImportanceOfSensors(dataset,
                                        comparison.holdouts[h],
                                        recommended.holdouts[h],
                                        *recommended.final_fit,
                                        options.stop);
        comparison.session_worth =
            models::WorthOfASession(dataset,
                                    comparison.holdouts[h],
                                    *component.recipes[model],
                                    recommended.holdouts[h],
                                    study_options);
      }
    }
    if (!options.keep_fold_maps) models::ForgetFoldMaps(&comparison.study);
    before += component.num_fits();
    run.components.push_back(std::move(comparison));
    if (run.interrupted) break;
  }
  return run;
}

}  // namespace errmap::cli
