#pragma once

#include "models/study/record/component_study.h"
#include "models/study/record/study_record.h"

namespace errmap::models {

/// What a component's study found, its held-out residuals assessed and its
/// judgement carried over; only the sentences are left to whoever writes them.
/// So many models are assessed at a time; the record is the same for any
/// `jobs`.
ComponentRecord MakeComponentRecord(const ComponentStudy& study, int jobs = 1);

std::vector<FaultRecord> MakeFaultRecords(const data::PreparedDataset& data);

}  // namespace errmap::models
