#pragma once

#include "cli/desk/machine/machine_study.h"
#include "cli/desk/plan/study_run.h"
#include "models/study/record/machine_record.h"

namespace errmap::desk {

/// Puts the maps of a finished run together and judges them at the points of
/// the later sessions, filters run through the folder's temperatures.csv where
/// it has one. Throws data::InputError as EvaluateAt does.
models::MachineRecord JudgeMachine(const MachineStudy& study,
                                   const StudyRun& run);

}  // namespace errmap::desk
