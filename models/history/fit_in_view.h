#pragma once

#include <functional>
#include <optional>

#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/history/view.h"

namespace errmap::models {

/// Adds the view to the choices recorded in a map.
void NoteView(const ViewedRows& viewed, FittedModel* fitted);

/// Fits rows that are already in some view.
using FitRows =
    std::function<FittedModel(const data::Dataset&, const FitContext&)>;

/// Without `options`, applies `fit` to `training` unchanged; else in the view
/// that they name. If they name none, takes the view with the least
/// TypicalError of `fit` on inner hold-outs, or the simplest of equals. The map
/// reads the columns of `training`, and has guards if `fit` sets them. Throws
/// as MakeViews and `fit` do.
FittedModel FitInView(const data::Dataset& training,
                      const std::optional<ViewOptions>& options,
                      const FitContext& context,
                      const FitRows& fit);

}  // namespace errmap::models
