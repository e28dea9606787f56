#pragma once

#include <cstddef>

#include "cli/report/residual_report.h"
#include "cli/study_file/comparison.h"

namespace errmap::cli {

/// The held-out residuals of a model in the file's order, with groups and
/// positions. Of a row that is held out more than once (groups:K:repeats=R)
/// the first is taken. The model must not have failed under that hold-out.
ResidualInputs HeldOutResiduals(const Comparison& comparison,
                                std::size_t model,
                                std::size_t holdout);

}  // namespace errmap::cli
