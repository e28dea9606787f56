#include "models/certification/solvers.h"

#include "fitting/minimisers/ceres_optimizer.h"
#include "fitting/minimisers/conjugate_gradient.h"
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
       .needs_residuals = true},
      {.name = "lm:unscaled",
       .make =
           [](const Rules& r) { return MakeLm(r, fitting::LmScaling::kNone); },
       .needs_residuals = true},
      {.name = "scg:moller",
       .make =
           [](const Rules& r) {
             return MakeScg(r, fitting::ScgVariant::kMoller);
           }},
      {.name = "scg:netcg",
       .make =
           [](const Rules& r) {
             return MakeScg(r, fitting::ScgVariant::kNetcg);
           },
       .judged_on_nets = false},
      {.name = "cg",
       .make =
           [](const Rules& r) {
             return std::make_unique<fitting::ConjugateGradient>(
                 fitting::ConjugateGradientOptions{.stopping = r});
           },
       .judged_on_nets = false},
      {.name = "ceres:levenberg_marquardt",
       .make = Ceres(CeresMethod::kLevenbergMarquardt),
       .needs_residuals = true},
      {.name = "ceres:dogleg",
       .make = Ceres(CeresMethod::kDogleg),
       .needs_residuals = true},
      {.name = "ceres:lbfgs", .make = Ceres(CeresMethod::kLbfgs)},
      {.name = "ceres:bfgs", .make = Ceres(CeresMethod::kBfgs)},
      {.name = "ceres:nonlinear_cg", .make = Ceres(CeresMethod::kNonlinearCg)},
      {.name = "nlopt:lbfgs", .make = Nlopt(NloptMethod::kLbfgs)},
      {.name = "nlopt:tnewton_precond_restart",
       .make = Nlopt(NloptMethod::kTnewtonPrecondRestart)},
      {.name = "nlopt:var2", .make = Nlopt(NloptMethod::kVar2)},
      {.name = "nlopt:slsqp", .make = Nlopt(NloptMethod::kSlsqp)},
      {.name = "nlopt:mma",
       .make = Nlopt(NloptMethod::kMma),
       .judged_on_nets = false},
      {.name = "nlopt:sbplx",
       .make = Nlopt(NloptMethod::kSbplx),
       .fits_nets = false},
      {.name = "nlopt:crs2_lm",
       .make = Nlopt(NloptMethod::kCrs2Lm),
       .fits_nets = false},
  };
  return kSolvers;
}

}  // namespace errmap::models
