#include "cli/study_run.h"

#include <utility>

namespace errmap::cli {

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
    comparison.study =
        models::RunStudy(comparison.data.dataset,
                         comparison.holdouts,
                         component.recipes,
                         {.seed = run.seed,
                          .jobs = options.jobs,
                          .stop = options.stop,
                          .progress = [&](int done, int /*of_component*/) {
                            if (options.progress)
                              options.progress(before + done, all);
                          }});
    const data::Dataset& dataset = comparison.data.dataset;
    for (const models::GivenPredictions& given : component.given) {
      comparison.study.models.push_back(
          models::JudgeGivenPredictions(given, dataset, comparison.holdouts));
    }
    comparison.judgement = models::JudgeStudy(dataset,
                                              comparison.holdouts,
                                              comparison.study,
                                              comparison.indifference,
                                              run.seed);
    run.interrupted = comparison.study.interrupted;
    before += component.num_fits();
    run.components.push_back(std::move(comparison));
    if (run.interrupted) break;
  }
  return run;
}

}  // namespace errmap::cli
