#include "cli/commands/studies/probes.h"

#include <stdexcept>

#include <fmt/format.h>

#include "cli/commands/data_arguments.h"
#include "models/promise/probe_study.h"

namespace errmap::cli {

void AddProbes(const desk::StudyRun& run,
               const ProbeArguments& arguments,
               models::StudyRecord* record) {
  if (arguments.numbers.empty()) return;
  for (std::size_t i = 0; i < run.components.size(); ++i) {
    const models::ComponentStudy& component = run.components[i];
    if (!component.judgement.recommendation) continue;
    const std::size_t h = component.judgement.recommendation->holdout;
    const data::SessionLog* log = component.data.dataset.log().get();
    const bool in_rows = log != nullptr && log->time_unit == "rows";
    try {
      record->components[i].probes = models::MakeRecord(
          models::StudyProbes(component.data.dataset,
                              component.holdouts[h],
                              h,
                              component.study,
                              arguments.numbers,
                              in_rows ? 1.0 : arguments.spacing));
    } catch (const std::invalid_argument& error) {
      Say(fmt::format("--probes-per-session: {}", error.what()));
    }
  }
}

}  // namespace errmap::cli
