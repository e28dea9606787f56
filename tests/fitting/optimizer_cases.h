#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "fitting/minimisers/ceres_optimizer.h"
#include "fitting/minimisers/conjugate_gradient.h"
#include "fitting/minimisers/gradient_descent.h"
#include "fitting/minimisers/nlopt_optimizer.h"
#include "fitting/minimisers/optimizer.h"
#include "fitting/minimisers/scaled_conjugate_gradient.h"

namespace errmap::fitting {

// The word in failure messages.
inline void PrintTo(Termination termination, std::ostream* out) {
  *out << ToString(termination);
}

}  // namespace errmap::fitting

namespace errmap::testing {

/// An optimizer that is run on every problem, and what may be asked of it.
struct OptimizerCase {
  std::string name;  // letters only: part of a test's name
  std::function<std::unique_ptr<fitting::Optimizer>(
      const fitting::StoppingRules&)>
      make;
  /// A pass takes at most so many evaluations.
  std::int64_t evaluations_per_pass = 0;
  /// No accepted step raises the cost.
  bool never_rises = false;
  /// Problems of test_problems.h whose minimum it finds.
  std::vector<std::string> solves;

  bool Solves(const std::string& problem) const {
    return std::ranges::find(solves, problem) != solves.end();
  }
};

inline void PrintTo(const OptimizerCase& optimizer, std::ostream* out) {
  *out << optimizer.name;
}

inline OptimizerCase ScgCase(std::string name,
                             fitting::ScgVariant variant,
                             std::int64_t evaluations_per_pass) {
  return {
      .name = std::move(name),
      .make =
          [variant](const fitting::StoppingRules& stopping) {
            fitting::ScaledConjugateGradientOptions options;
            options.stopping = stopping;
            options.variant = variant;
            return std::make_unique<fitting::ScaledConjugateGradient>(options);
          },
      .evaluations_per_pass = evaluations_per_pass,
      .never_rises = true,
      .solves = {"Rosenbrock",
                 "IllConditionedQuadratic",
                 "Beale",
                 "Wood",
                 "PowellSingular",
                 "NotANumberOutside",
                 "FlatFloor"}};
}

inline OptimizerCase CeresCase(std::string name,
                               fitting::CeresMethod method,
                               std::vector<std::string> solves) {
  return {.name = std::move(name),
          .make =
              [method](const fitting::StoppingRules& stopping) {
                fitting::CeresOptions options;
                options.stopping = stopping;
                options.method = method;
                // More than any problem's parameters: L-BFGS is then BFGS.
                options.memory = 10;
                return std::make_unique<fitting::CeresOptimizer>(options);
              },
          .evaluations_per_pass = 1,
          .never_rises = true,
          .solves = std::move(solves)};
}

inline OptimizerCase NloptCase(std::string name,
                               fitting::NloptMethod method,
                               std::vector<std::string> solves) {
  return {.name = std::move(name),
          .make =
              [method](const fitting::StoppingRules& stopping) {
                fitting::NloptOptions options;
                options.stopping = stopping;
                options.method = method;
                return std::make_unique<fitting::NloptOptimizer>(options);
              },
          .evaluations_per_pass = 1,
          .never_rises = true,
          .solves = std::move(solves)};
}

inline std::vector<OptimizerCase> AllOptimizers() {
  const std::vector<std::string> all = {"Rosenbrock",
                                        "IllConditionedQuadratic",
                                        "Beale",
                                        "Wood",
                                        "PowellSingular",
                                        "NotANumberOutside",
                                        "FlatFloor"};
  using fitting::CeresMethod;
  using fitting::NloptMethod;
  using fitting::StoppingRules;
  return {
      ScgCase("ScgMoller", fitting::ScgVariant::kMoller, 6),
      ScgCase("ScgNetcg", fitting::ScgVariant::kNetcg, 2),
      {.name = "Cg",
       .make =
           [](const StoppingRules& stopping) {
             fitting::ConjugateGradientOptions options;
             options.stopping = stopping;
             return std::make_unique<fitting::ConjugateGradient>(options);
           },
       .evaluations_per_pass = 2,
       .never_rises = true,
       .solves = all},
      // A rate for curvatures up to about a thousand: those of Wood and of the
      // ill-conditioned quadratic are larger, Powell's at the end too small.
      {.name = "Backprop",
       .make =
           [](const StoppingRules& stopping) {
             fitting::GradientDescentOptions options;
             options.stopping = stopping;
             options.learning_rate = 1e-3;
             return std::make_unique<fitting::GradientDescent>(options);
           },
       .evaluations_per_pass = 1,
       .never_rises = false,
       .solves = {"Rosenbrock", "Beale", "NotANumberOutside", "FlatFloor"}},
      CeresCase("CeresLbfgs", CeresMethod::kLbfgs, all),
      CeresCase("CeresBfgs", CeresMethod::kBfgs, all),
      // Slow in the ill-conditioned quadratic's valley.
      CeresCase("CeresNonlinearCg",
                CeresMethod::kNonlinearCg,
                {"Rosenbrock",
                 "Beale",
                 "Wood",
                 "PowellSingular",
                 "NotANumberOutside",
                 "FlatFloor"}),
      NloptCase("NloptLbfgs", NloptMethod::kLbfgs, all),
      NloptCase("NloptTnewton", NloptMethod::kTnewtonPrecondRestart, all),
      NloptCase("NloptVar2", NloptMethod::kVar2, all),
      NloptCase("NloptSlsqp", NloptMethod::kSlsqp, all),
      // Separable approximations: made for many constraints, not for valleys.
      NloptCase("NloptMma",
                NloptMethod::kMma,
                {"Rosenbrock", "Beale", "NotANumberOutside", "FlatFloor"}),
      NloptCase("NloptSbplx",
                NloptMethod::kSbplx,
                {"Rosenbrock", "Beale", "NotANumberOutside", "FlatFloor"}),
      NloptCase("NloptCrs2", NloptMethod::kCrs2Lm, all),
  };
}

}  // namespace errmap::testing
