#pragma once

#include "models/study/record/component_study.h"
#include "models/study/record/study_record.h"

namespace errmap::models {

/// Makes the record of a component's study: assesses its held-out residuals and
/// copies its judgement. The caller adds the sentences. Assesses `jobs` models
/// at a time; the record is the same for any `jobs`.
ComponentRecord MakeComponentRecord(const ComponentStudy& study, int jobs = 1);

std::vector<FaultRecord> MakeFaultRecords(const data::PreparedDataset& data);

}  // namespace errmap::models
