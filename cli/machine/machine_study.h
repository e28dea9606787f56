#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/machine/machine_file.h"
#include "cli/machine/record/machine_record.h"
#include "cli/study_setup/plan/study_plan.h"
#include "cli/study_setup/plan/study_run.h"
#include "cli/study_setup/study_config.h"
#include "data/csv.h"

namespace errmap::machine {

/// A machine whose maps are still to be fitted. STEM.json of machine.toml is
/// fitted to STEM.csv of a folder. The folder's tool_tip.csv has the true
/// errors at the tool, and diagonals.csv, if any, those along diagonals.
struct MachineStudy {
  std::string path;  // of machine.toml
  std::string folder;
  MachineFile file;                     // names its maps; none is read
  std::vector<std::string> stems = {};  // distinct, in the machine's order
  data::CsvTable points = {};           // tool_tip.csv
  std::optional<data::CsvTable> diagonals = {};
  std::string session = {};             // column of its sessions
  std::vector<std::string> later = {};  // its last ones: no fit sees them

  /// Returns the path of a file in the folder.
  std::string FileNamed(const std::string& name) const;
};

/// "x_yaw" of "x_yaw.json".
std::string StemOf(const std::string& file);

/// Reads machine and points; `later` is the number of sessions for the
/// judgement, `session` their column ("": one of kSessionColumns). Throws
/// data::InputError if a file is missing, the points have no column of
/// sessions, or all its sessions are later ones.
MachineStudy ReadMachineStudy(const std::string& machine,
                              const std::string& folder,
                              int later = 1,
                              const std::string& session = "");

/// Returns the plan of `config` with a component for each stem, without the
/// later sessions. Throws as PlanStudy. Throws data::InputError if a
/// component's target is not an error of its link, or is a length for an angle.
/// Also if its rows have both directions of motion, or if it shares no session
/// with the points.
study_setup::StudyPlan PlanOfMachine(const MachineStudy& study,
                                     study_setup::StudyConfig config = {},
                                     const study_setup::Remark& remark = {});

/// Judges the maps of a finished run together at the points of the later
/// sessions. Filters run through the folder's temperatures.csv, if there is
/// one. Throws data::InputError as EvaluateAt does.
MachineRecord JudgeMachine(const MachineStudy& study,
                           const study_setup::StudyRun& run);

}  // namespace errmap::machine
