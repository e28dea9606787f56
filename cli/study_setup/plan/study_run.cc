#include "cli/study_setup/plan/study_run.h"

#include <optional>
#include <utility>

#include "cli/report/report.h"
#include "cli/study_setup/provenance.h"
#include "data/files/shown_path.h"
#include "models/study/journal/kept_fits.h"

namespace errmap::study_setup {

StudyRun RunPlan(StudyPlan plan,
                 const std::string& command_line,
                 const RunOptions& options) {
  const int all = plan.num_fits();
  StudyRun run{.seed = plan.config.seed,
               .command_line = command_line,
               .config = std::move(plan.config),
               .inputs = std::move(plan.inputs),
               .interrupted = false};
  const auto kept = models::KeptFits::OpenCache(options.cache);
  int before = 0;  // fits of the components that are finished
  for (models::ComponentPlan& component : plan.components) {
    models::StudyOptions study_options{
        .seed = run.seed,
        .jobs = options.jobs,
        .stop = options.stop,
        .indifference = component.comparison.indifference,
        .progress = [&](const models::FitProgress& fit) {
          if (!options.progress) return;
          models::FitProgress of_plan = fit;
          of_plan.done += before;
          of_plan.all = all;
          options.progress(run.components.size(), of_plan);
        }};
    const models::ComponentStudy& comparison = component.comparison;
    std::optional<models::FitLabels> labels;
    std::optional<models::ComponentJournal> journal;
    if (options.journal != nullptr || !options.cache.empty()) {
      labels.emplace(comparison.name,
                     comparison.data.dataset,
                     comparison.holdouts,
                     component.recipes,
                     study_options);
      if (options.journal != nullptr && options.journal_has) {
        options.journal_has(models::DescribeResume(options.journal, *labels));
      }
      journal.emplace(std::vector{options.journal, kept.get()},
                      &*labels,
                      &comparison.data.dataset,
                      &comparison.holdouts);
      study_options.journal = &*journal;
    }
    models::RunComponent(&component, study_options, options.keep_fold_maps);
    before += component.num_fits();
    run.components.push_back(std::move(component.comparison));
    run.interrupted = run.components.back().study.interrupted;
    if (run.interrupted) break;
  }
  return run;
}

models::StudyRecord RecordOf(const StudyRun& run, int jobs) {
  models::StudyRecord record =
      report::MakeRecord(run.components, run.seed, jobs);
  record.provenance = study_setup::MakeProvenance(run.command_line, run.inputs);
  record.provenance.configuration = EffectiveConfiguration(run.config);
  for (models::ComponentRecord& component : record.components) {
    for (auto& table : component.figures.tables) {
      table.file = data::ShownPath(table.file);
    }
  }
  return record;
}

}  // namespace errmap::study_setup
