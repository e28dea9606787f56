#include "models/certification/solvers.h"

#include "fitting/minimisers/ceres_optimizer.h"
#include "fitting/minimisers/conjugate_gradient.h"
#include "fitting/minimisers/gradient_descent.h"
#include "fitting/minimisers/levenberg_marquardt.h"
#include "fitting/minimisers/nlopt_optimizer.h"
#include "fitting/minimisers/scaled_conjugate_gradient.h"

namespace errmap::models {
namespace {

using fitting::Optimizer;
using fitting::StoppingRules;
using OptimizerPointer = std::unique_ptr<Optimizer>;

OptimizerPointer MakeLm(const StoppingRules& stopping,
                        fitting::LmScaling scaling) {
  return std::make_unique<fitting::LevenbergMarquardt>(
      fitting::LevenbergMarquardtOptions{.stopping = stopping,
                                         .scaling = scaling});
}

OptimizerPointer MakeScg(const StoppingRules& stopping,
                         fitting::ScgVariant variant) {
  return std::make_unique<fitting::ScaledConjugateGradient>(
      fitting::ScaledConjugateGradientOptions{.stopping = stopping,
                                              .variant = variant});
}

using Maker = std::function<OptimizerPointer(const StoppingRules&)>;

Maker Ceres(fitting::CeresMethod method) {
  return [method](const StoppingRules& stopping) {
    return std::make_unique<fitting::CeresOptimizer>(
        fitting::CeresOptions{.stopping = stopping, .method = method});
  };
}

Maker Nlopt(fitting::NloptMethod method) {
  return [method](const StoppingRules& stopping) {
    return std::make_unique<fitting::NloptOptimizer>(
        fitting::NloptOptions{.stopping = stopping, .method = method});
  };
}

}  // namespace

const std::vector<CertifiedSolver>& CertifiedSolvers() {
  using Rules = StoppingRules;
  using fitting::CeresMethod;
  using fitting::NloptMethod;
  static const std::vector<CertifiedSolver> kSolvers{
      {.name = "lm:marquardt",
       .make =
           [](const Rules& r) {
             return MakeLm(r, fitting::LmScaling::kMarquardt);
           },
       .floors = {.solved = 50, .mean_lre_parameters = 9.2},
       .needs_residuals = true},
      {.name = "lm:unscaled",
       .make =
           [](const Rules& r) { return MakeLm(r, fitting::LmScaling::kNone); },
       .floors = {.solved = 42, .mean_lre_parameters = 7.9},
       .needs_residuals = true},
      {.name = "scg:moller",
       .make =
           [](const Rules& r) {
             return MakeScg(r, fitting::ScgVariant::kMoller);
           },
       .floors = {.solved = 18, .mean_lre_parameters = 3.2}},
      {.name = "scg:netcg",
       .make =
           [](const Rules& r) {
             return MakeScg(r, fitting::ScgVariant::kNetcg);
           },
       .floors = {.solved = 11, .mean_lre_parameters = 1.8}},
      {.name = "cg",
       .make =
           [](const Rules& r) {
             return std::make_unique<fitting::ConjugateGradient>(
                 fitting::ConjugateGradientOptions{.stopping = r});
           },
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
           [](const Rules& r) {
             return std::make_unique<fitting::GradientDescent>(
                 fitting::GradientDescentOptions{.stopping = r});
           },
       .floors = {.agreement_difference = 1e-4, .agreement_prediction = 5e-3},
       .fits_formulas = false},
  };
  return kSolvers;
}

}  // namespace errmap::models
