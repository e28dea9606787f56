#pragma once

#include <vector>

#include "models/study/record/study_record.h"

namespace errmap::models {

// Makes records of fits.

SummaryRecord MakeRecord(const fitting::FitSummary& summary);
/// One or more starts.
StartsRecord MakeRecord(const std::vector<StartResult>& starts);
ByName<OptionValue> MakeRecord(const std::vector<EffectiveOption>& options);

/// Makes the record of a fit: its time and outcome; empty lists are left out.
FitRecord MakeFitRecord(double fit_seconds,
                        const fitting::FitSummary& summary,
                        const std::vector<std::string>& remarks,
                        const std::vector<EffectiveOption>& choices,
                        const std::vector<StartResult>& starts);

}  // namespace errmap::models
