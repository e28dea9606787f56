#pragma once

#include <vector>

#include "cli/report/figures/figures.h"
#include "models/learning/learning_record.h"

namespace errmap::report {

/// Error on unseen units against the number of training units or of sensors, as
/// requested from `errmap learn`; none if the record has neither.
std::vector<Figure> LearningFigures(const models::LearningRecord& learnt,
                                    const std::string& prefix);

/// Adds the figures to the only component with the same data file and target.
void AddLearning(const models::StudyRecord& record,
                 const std::vector<models::LearningRecord>& learnt,
                 FigureSet* figures);

}  // namespace errmap::report
