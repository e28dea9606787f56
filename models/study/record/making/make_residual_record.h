#pragma once

#include "models/study/judgement/residual_assessment.h"
#include "models/study/record/study_record.h"

namespace errmap::models {

/// A test that does not apply has NaN and the reason.
NormalityRecord MakeRecord(const stats::Normality& normality,
                           const stats::MonteCarloP& monte_carlo);

/// Makes the record of serial tests over the whole order and within groups,
/// halves, biases by group and position, and variance against fitted.
RandomnessRecord MakeRecord(const ResidualReport& report);

}  // namespace errmap::models
