#pragma once

#include "models/study/record/machine_record.h"
#include "models/study_file/machine/machine_study.h"
#include "models/study_file/plan/study_run.h"

namespace errmap::study_file {

/// Puts the maps of a finished run together and judges them at the points of
/// the later sessions, filters run through the folder's temperatures.csv where
/// it has one. Throws data::InputError as EvaluateAt does.
models::MachineRecord JudgeMachine(const MachineStudy& study,
                                   const StudyRun& run);

}  // namespace errmap::study_file
