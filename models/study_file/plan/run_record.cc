#include "models/study_file/plan/run_record.h"

#include "data/shown_path.h"
#include "models/report/report.h"
#include "models/study_file/configuration_record.h"
#include "models/study_file/provenance.h"

namespace errmap::study_file {

models::StudyRecord RecordOf(const StudyRun& run, int jobs) {
  models::StudyRecord record =
      report::MakeRecord(run.components, run.seed, jobs);
  record.interrupted = run.interrupted;
  record.provenance = MakeProvenance(run.command_line, run.inputs);
  record.provenance.configuration = EffectiveConfiguration(run.config);
  for (models::ComponentRecord& component : record.components) {
    for (auto& table : component.figures.tables) {
      table.file = data::ShownPath(table.file);
    }
  }
  return record;
}

}  // namespace errmap::study_file
