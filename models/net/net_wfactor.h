#pragma once

#include "fitting/minimisers/discrepancy_principle.h"
#include "models/net/net_fit.h"

namespace errmap::models {

/// Returns the largest wfactor whose fit has an RMS residual of at most
/// `delta`, in the target's unit, on the training rows.
fitting::DiscrepancyChoice ChooseWfactorByDiscrepancy(
    const NetRows& rows,
    const NetTrainer& trainer,
    double delta,
    const FitContext& context);

}  // namespace errmap::models
