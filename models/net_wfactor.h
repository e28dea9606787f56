#pragma once

#include <string>
#include <vector>

#include "fitting/discrepancy_principle.h"
#include "models/net_fit.h"

namespace errmap::models {

/// The wfactor that errs least on inner hold-outs: those of MakeInnerFolds.
struct CrossValidatedWfactor {
  double wfactor = 0.0;
  double rmse = 0.0;   // held out, in the target's unit
  std::string folds;   // "groups:5 of cycle"
  std::string scores;  // "1e-07: 0.00031, ...": every wfactor that was tried
};

/// Tries the decades from 1e-7 to 1, then the half decades beside the best; of
/// equal errors the larger wfactor. Every fit starts from the weights of
/// context.seed. Throws std::invalid_argument where none could be judged.
CrossValidatedWfactor ChooseWfactorByCv(const NetDesign& design,
                                        const NetTrainer& trainer,
                                        const data::Dataset& training,
                                        const FitContext& context);

/// The largest wfactor whose fit has an RMS residual of at most `delta`, in the
/// target's unit, on the training rows.
fitting::DiscrepancyChoice ChooseWfactorByDiscrepancy(
    const NetRows& rows,
    const NetTrainer& trainer,
    double delta,
    const FitContext& context);

}  // namespace errmap::models
