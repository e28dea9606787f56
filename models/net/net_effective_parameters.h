#pragma once

#include "models/net/net_trainer.h"

namespace errmap::models {

/// Effective number of parameters of a net with fitted weights w (N):
///
///   trace of J (J'J + c I)^-1 J',  c = wfactor / N,
///
/// J (P x N) and c are those of E = 1/2 |r|^2 + 1/2 c |w|^2 (net_residuals.h;
/// Moody 1992; MacKay 1992, Eq. 4.9, with J'J for the Hessian of the misfit).
/// If biases have no decay, I omits them. It is the number of directions in
/// target space that the fit can follow: the rank of J if wfactor is 0, and
/// less for larger wfactors.
///
/// `training` holds the fitted rows and their wfactor. Computed in the smaller
/// of the spaces of patterns and weights, or in that of the weights if biases
/// have no decay. NaN if that has more than 3000 dimensions or the products
/// would take more than about a minute.
double EffectiveParameters(const NetTraining& training, const VectorXd& w);

}  // namespace errmap::models
