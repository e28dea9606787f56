#pragma once

#include <cstddef>

#include "models/study/judgement/residual_assessment.h"
#include "models/study/record/component_study.h"

namespace errmap::models {

/// Returns a model's held-out residuals in the file's order, with groups and
/// positions. Uses the first residual of a row that is held out more than once
/// (groups:K:repeats=R). The model must not have failed under that hold-out.
ResidualInputs HeldOutResiduals(const ComponentStudy& comparison,
                                std::size_t model,
                                std::size_t holdout);

}  // namespace errmap::models
