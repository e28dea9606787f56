#include "cli/desk/plan/run_record.h"

#include "cli/desk/configuration_record.h"
#include "cli/desk/provenance.h"
#include "cli/report/report.h"
#include "data/files/shown_path.h"

namespace errmap::desk {

models::StudyRecord RecordOf(const StudyRun& run, int jobs) {
  models::StudyRecord record =
      report::MakeRecord(run.components, run.seed, jobs);
  record.interrupted = run.interrupted;
  record.provenance = desk::MakeProvenance(run.command_line, run.inputs);
  record.provenance.configuration = EffectiveConfiguration(run.config);
  for (models::ComponentRecord& component : record.components) {
    for (auto& table : component.figures.tables) {
      table.file = data::ShownPath(table.file);
    }
  }
  return record;
}

}  // namespace errmap::desk
