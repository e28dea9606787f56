#pragma once

#include <functional>

#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/history/view.h"

namespace errmap::models {

/// Fits rows that are in some view already.
using FitRows =
    std::function<FittedModel(const data::Dataset&, const FitContext&)>;

/// `fit` of `training` in the view of `options`: the one named, else that with
/// the least TypicalError when `fit` is repeated on inner hold-outs, the
/// simplest of equals. The map reads the columns of `training`; it is guarded
/// where `fit` guards. Throws as MakeViews and `fit` do.
FittedModel FitInView(const data::Dataset& training,
                      const ViewOptions& options,
                      const FitContext& context,
                      const FitRows& fit);

}  // namespace errmap::models
