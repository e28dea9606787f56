#pragma once

#include "models/study/record/component_study.h"
#include "models/study/record/study_record.h"

namespace errmap::models {

/// Makes the rows behind the figures. Each table has the target, the inputs of
/// a fitted map (at most 45, the position first) and every model's held-out
/// predictions. Tables of more than 5000 rows are thinned evenly. A row held
/// out more than once has its first prediction. Models that failed under a
/// hold-out are missing. Numbers have 9 significant digits.
FiguresRecord MakeFiguresRecord(const ComponentStudy& study);

/// Returns weighted Pearson correlations of the inputs and the target.
CorrelationRecord Correlate(const data::Dataset& dataset);

}  // namespace errmap::models
