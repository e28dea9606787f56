#pragma once

#include "models/study/record/component_study.h"
#include "models/study/record/study_record.h"

namespace errmap::models {

/// Makes the record of a component's study, with its held-out residuals
/// assessed and its judgement copied. Only the sentences are left to the
/// caller. Assesses `jobs` models at a time; the record is the same for any
/// `jobs`.
ComponentRecord MakeComponentRecord(const ComponentStudy& study, int jobs = 1);

std::vector<FaultRecord> MakeFaultRecords(const data::PreparedDataset& data);

}  // namespace errmap::models
