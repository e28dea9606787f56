#include "models/certification/solvers.h"

#include "fitting/minimisers/ceres_optimizer.h"
#include "fitting/minimisers/conjugate_gradient.h"
#include "fitting/minimisers/gradient_descent.h"
#include "fitting/minimisers/levenberg_marquardt.h"
#include "fitting/minimisers/nlopt_optimizer.h"
#include "fitting/minimisers/scaled_conjugate_gradient.h"

namespace errmap::models {
namespace {

using fitting::StoppingRules;
using Maker =
    std::function<std::unique_ptr<fitting::Optimizer>(const StoppingRules&)>;

// Makes an optimizer of these options, but for the stopping rules.
template <typename Optimizer, typename Options>
Maker MakerOf(Options options) {
  return [options](const StoppingRules& stopping) {
    Options own = options;
    own.stopping = stopping;
    return std::make_unique<Optimizer>(own);
  };
}

Maker Lm(fitting::LmScaling scaling) {
  return MakerOf<fitting::LevenbergMarquardt>(
      fitting::LevenbergMarquardtOptions{.scaling = scaling});
}

Maker Scg(fitting::ScgVariant variant) {
  return MakerOf<fitting::ScaledConjugateGradient>(
      fitting::ScaledConjugateGradientOptions{.variant = variant});
}

Maker Ceres(fitting::CeresMethod method) {
  return MakerOf<fitting::CeresOptimizer>(
      fitting::CeresOptions{.method = method});
}

Maker Nlopt(fitting::NloptMethod method) {
  return MakerOf<fitting::NloptOptimizer>(
      fitting::NloptOptions{.method = method});
}

}  // namespace

const std::vector<CertifiedSolver>& CertifiedSolvers() {
  using fitting::CeresMethod;
  using fitting::NloptMethod;
  static const std::vector<CertifiedSolver> kSolvers{
      {.name = "lm:marquardt",
       .make = Lm(fitting::LmScaling::kMarquardt),
       .floors = {.solved = 50, .mean_lre_parameters = 9.2},
       .needs_residuals = true},
      {.name = "lm:unscaled",
       .make = Lm(fitting::LmScaling::kNone),
       .floors = {.solved = 42, .mean_lre_parameters = 7.9},
       .needs_residuals = true},
      {.name = "scg:moller",
       .make = Scg(fitting::ScgVariant::kMoller),
       .floors = {.solved = 18, .mean_lre_parameters = 3.2}},
      {.name = "scg:netcg",
       .make = Scg(fitting::ScgVariant::kNetcg),
       .floors = {.solved = 11, .mean_lre_parameters = 1.8}},
      {.name = "cg",
       .make = MakerOf<fitting::ConjugateGradient>(
           fitting::ConjugateGradientOptions()),
       .floors = {.solved = 18, .mean_lre_parameters = 3.0}},
      {.name = "ceres:levenberg_marquardt",
       .make = Ceres(CeresMethod::kLevenbergMarquardt),
       .floors = {.solved = 50, .mean_lre_parameters = 8.6},
       .needs_residuals = true},
      {.name = "ceres:dogleg",
       .make = Ceres(CeresMethod::kDogleg),
       .floors = {.solved = 45, .mean_lre_parameters = 7.2},
       .needs_residuals = true},
      {.name = "ceres:lbfgs",
       .make = Ceres(CeresMethod::kLbfgs),
       .floors = {.solved = 37, .mean_lre_parameters = 5.8}},
      {.name = "ceres:bfgs",
       .make = Ceres(CeresMethod::kBfgs),
       .floors = {.solved = 48, .mean_lre_parameters = 8.0}},
      {.name = "ceres:nonlinear_cg",
       .make = Ceres(CeresMethod::kNonlinearCg),
       .floors = {.solved = 16, .mean_lre_parameters = 2.3}},
      {.name = "nlopt:lbfgs",
       .make = Nlopt(NloptMethod::kLbfgs),
       .floors = {.solved = 4, .mean_lre_parameters = 0.8}},
      {.name = "nlopt:tnewton_precond_restart",
       .make = Nlopt(NloptMethod::kTnewtonPrecondRestart),
       .floors = {.solved = 9, .mean_lre_parameters = 1.8}},
      {.name = "nlopt:var2",
       .make = Nlopt(NloptMethod::kVar2),
       .floors = {.solved = 5, .mean_lre_parameters = 0.9}},
      {.name = "nlopt:slsqp",
       .make = Nlopt(NloptMethod::kSlsqp),
       .floors = {.solved = 18, .mean_lre_parameters = 3.3}},
      {.name = "nlopt:mma",
       .make = Nlopt(NloptMethod::kMma),
       .floors = {.solved = 26,
                  .mean_lre_parameters = 3.3,
                  .agreement_difference = 1e-3,
                  .agreement_prediction = 2e-2}},
      {.name = "nlopt:sbplx",
       .make = Nlopt(NloptMethod::kSbplx),
       .floors = {.solved = 21, .mean_lre_parameters = 3.1},
       .fits_nets = false},
      {.name = "nlopt:crs2_lm",
       .make = Nlopt(NloptMethod::kCrs2Lm),
       .floors = {.solved = 13, .mean_lre_parameters = 2.1},
       .fits_nets = false},
      {.name = "backprop",
       .make =
           MakerOf<fitting::GradientDescent>(fitting::GradientDescentOptions()),
       .floors = {.agreement_difference = 1e-4, .agreement_prediction = 5e-3},
       .fits_formulas = false},
  };
  return kSolvers;
}

}  // namespace errmap::models
