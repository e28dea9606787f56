#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/desk/plan/study_plan.h"
#include "cli/desk/plan/study_run.h"
#include "cli/desk/study_config.h"
#include "cli/machine/machine_file.h"
#include "cli/machine/record/machine_record.h"
#include "data/csv.h"

namespace errmap::machine {

/// A machine whose maps are still to be fitted: STEM.json of machine.toml
/// belongs to STEM.csv of a folder, whose tool_tip.csv has the true errors at
/// the tool, and diagonals.csv, where there is one, along diagonals.
struct MachineStudy {
  std::string path;  // of machine.toml
  std::string folder;
  MachineFile file;                // sources with files, without maps
  std::vector<std::string> stems;  // distinct, in the machine's order
  data::CsvTable points;           // tool_tip.csv
  std::optional<data::CsvTable> diagonals;
  std::string session;             // column of its sessions
  std::vector<std::string> later;  // its last ones: no fit sees them

  /// The path of a file in the folder.
  std::string FileNamed(const std::string& name) const;
};

/// Reads machine and points; `later` is the number of sessions to judge by,
/// `session` their column ("": one of kSessionColumns).
/// Throws data::InputError where a file is missing, the points have no column
/// of sessions, or no session but the later ones.
MachineStudy ReadMachineStudy(const std::string& machine,
                              const std::string& folder,
                              int later = 1,
                              const std::string& session = "");

/// The plan of `config` with a component for each stem, the later sessions left
/// out. Throws as PlanStudy, and data::InputError where the target of a
/// component is no error of its link, a length for an angle, or none of its
/// sessions is one of the points'.
desk::StudyPlan PlanOfMachine(const MachineStudy& study,
                              desk::StudyConfig config = {},
                              const desk::Remark& remark = {});

/// Puts the maps of a finished run together and judges them at the points of
/// the later sessions, filters run through the folder's temperatures.csv where
/// it has one. Throws data::InputError as EvaluateAt does.
MachineRecord JudgeMachine(const MachineStudy& study,
                           const desk::StudyRun& run);

}  // namespace errmap::machine
