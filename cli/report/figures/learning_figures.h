#pragma once

#include <vector>

#include "cli/report/figures/figures.h"
#include "models/learning/learning_record.h"

namespace errmap::report {

/// Error on unseen units against training units, or against the number of
/// sensors, as errmap learn was asked; none if there is neither.
std::vector<Figure> LearningFigures(const models::LearningRecord& learnt,
                                    const std::string& prefix);

/// Adds them to the component that they belong to: the only one with the same
/// data file and target.
void AddLearning(const models::StudyRecord& record,
                 const std::vector<models::LearningRecord>& learnt,
                 FigureSet* figures);

}  // namespace errmap::report
