#pragma once

#include "models/study/record/component_study.h"
#include "models/study/record/study_record.h"

namespace errmap::models {

/// The rows behind the figures: of each table the target, the inputs that a
/// fitted map reads (at most 45, the position first) and every model's
/// held-out predictions. Tables of more than 5000 rows are thinned evenly. Of
/// a row held out more than once the first prediction counts. Models that
/// failed under a hold-out are not there. Numbers have 9 significant digits.
FiguresRecord MakeFiguresRecord(const ComponentStudy& study);

/// Pearson, weighted, of the inputs and the target.
CorrelationRecord Correlate(const data::Dataset& dataset);

}  // namespace errmap::models
