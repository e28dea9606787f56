#pragma once

#include <functional>
#include <optional>

#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/history/view.h"

namespace errmap::models {

/// Adds which view it is to what a map chose.
void NoteView(const ViewedRows& viewed, FittedModel* fitted);

/// Fits rows that are already in some view.
using FitRows =
    std::function<FittedModel(const data::Dataset&, const FitContext&)>;

/// Applies `fit` to `training` as it is without `options`, else in the view
/// named in them. If none is named, it takes the view with the least
/// TypicalError of `fit` on inner hold-outs, of equals the simplest. The map
/// reads the columns of `training`; it is guarded if `fit` guards. Throws as
/// MakeViews and `fit` do.
FittedModel FitInView(const data::Dataset& training,
                      const std::optional<ViewOptions>& options,
                      const FitContext& context,
                      const FitRows& fit);

}  // namespace errmap::models
