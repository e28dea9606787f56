#pragma once

#include <vector>

#include "models/study/record/component_study.h"
#include "models/study/record/study_record.h"

namespace errmap::models {

/// What speaks for the recommendation in `record`, which has all else of
/// `study`.
std::vector<RemarkRecord> FindGrounds(const ComponentStudy& study,
                                      const ComponentRecord& record);

/// What bounds the worth of the recommendation.
std::vector<RemarkRecord> FindDoubts(const ComponentStudy& study,
                                     const ComponentRecord& record);

}  // namespace errmap::models
