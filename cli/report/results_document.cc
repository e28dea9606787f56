#include "cli/report/results_document.h"

#include "cli/json_blocks.h"
#include "cli/report/configuration_json.h"
#include "cli/report/results_json.h"
#include "cli/study_file/provenance.h"
#include "models/version.h"

namespace errmap::cli {

std::string ResultsJson(const StudyRun& run) {
  Json components = Json::array();
  for (const Comparison& component : run.components) {
    components.push_back(ComponentJson(component));
  }
  return DumpJson(
      {{"schema", "errmap-results-1"},
       {"version", models::Version()},
       {"seed", run.seed},
       {"interrupted", run.interrupted},
       {"provenance",
        ProvenanceJson(
            run.command_line, EffectiveConfiguration(run.config), run.inputs)},
       {"components", std::move(components)}});
}

}  // namespace errmap::cli
