#pragma once

#include <vector>

#include "cli/report/figures/figures.h"
#include "models/promise/learning_record.h"

namespace errmap::report {

/// Error on unseen units against the number learnt from, or against the number
/// of sensors, whichever errmap learn was asked for; none of neither.
std::vector<Figure> LearningFigures(const models::LearningRecord& learnt,
                                    const std::string& prefix);

/// Adds them to the component that was learnt from: of the same data file and
/// target, the only one.
void AddLearning(const models::StudyRecord& record,
                 const std::vector<models::LearningRecord>& learnt,
                 FigureSet* figures);

}  // namespace errmap::report
