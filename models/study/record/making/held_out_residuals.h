#pragma once

#include <cstddef>

#include "models/study/judgement/residual_assessment.h"
#include "models/study/record/component_study.h"

namespace errmap::models {

/// The held-out residuals of a model in the file's order, with groups and
/// positions. Of a row that is held out more than once (groups:K:repeats=R)
/// the first is taken. The model must not have failed under that hold-out.
ResidualInputs HeldOutResiduals(const ComponentStudy& comparison,
                                std::size_t model,
                                std::size_t holdout);

}  // namespace errmap::models
