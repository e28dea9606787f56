#include "cli/output/results_document.h"

#include "cli/output/configuration_record.h"
#include "cli/shell/shown_path.h"
#include "cli/study_file/provenance.h"
#include "models/report/words/verdict_text.h"
#include "models/study/record/make_study_record.h"
#include "models/version.h"

namespace errmap::cli {
models::StudyRecord RecordOf(const StudyRun& run, int jobs) {
  models::StudyRecord record;
  record.schema = models::kResultsSchema;
  record.version = models::Version();
  record.seed = run.seed;
  record.interrupted = run.interrupted;
  record.provenance = MakeProvenance(run.command_line, run.inputs);
  record.provenance.configuration = EffectiveConfiguration(run.config);
  for (const Comparison& component : run.components) {
    record.components.push_back(models::MakeComponentRecord(component, jobs));
    for (auto& table : record.components.back().figures.tables) {
      table.file = ShownPath(table.file);
    }
    report::AddSentences(&record.components.back());
  }
  return record;
}

}  // namespace errmap::cli
