#pragma once

#include <cstddef>

#include "models/study/component_study.h"
#include "models/study/residual_assessment.h"

namespace errmap::models {

/// The held-out residuals of a model in the file's order, with groups and
/// positions. Of a row that is held out more than once (groups:K:repeats=R)
/// the first is taken. The model must not have failed under that hold-out.
ResidualInputs HeldOutResiduals(const ComponentStudy& comparison,
                                std::size_t model,
                                std::size_t holdout);

}  // namespace errmap::models
