#pragma once

#include <string>

#include "data/dataset.h"
#include "fitting/fold_codes.h"
#include "models/error_model.h"

namespace errmap::models {

/// Folds for the choices made inside a fit, by context.inner_holdout, up to 5:
/// runs of whole sessions or groups, contiguous runs of rows, seeded shares of
/// the rows, or blocks of whole groups (rows where there are none) in order,
/// each predicted from those before it. No row outside `training` has a part in
/// it.
struct InnerFolds {
  fitting::FoldCodes folds;  // of the rows of `training`
  std::string text;  // "sessions:5 of day", "groups:5 of cycle", "kfold:5"
};

/// Throws std::invalid_argument where there are fewer than 2 rows.
InnerFolds MakeInnerFolds(const data::Dataset& training,
                          const FitContext& context);

}  // namespace errmap::models
