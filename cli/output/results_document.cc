#include "cli/output/results_document.h"

#include "cli/output/configuration_record.h"
#include "cli/shell/shown_path.h"
#include "cli/study_file/provenance.h"
#include "models/report/report.h"

namespace errmap::cli {

models::StudyRecord RecordOf(const StudyRun& run, int jobs) {
  models::StudyRecord record =
      report::MakeRecord(run.components, run.seed, jobs);
  record.interrupted = run.interrupted;
  record.provenance = MakeProvenance(run.command_line, run.inputs);
  record.provenance.configuration = EffectiveConfiguration(run.config);
  for (models::ComponentRecord& component : record.components) {
    for (auto& table : component.figures.tables) {
      table.file = ShownPath(table.file);
    }
  }
  return record;
}

}  // namespace errmap::cli
