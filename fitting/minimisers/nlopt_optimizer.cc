#include "fitting/minimisers/nlopt_optimizer.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <nlopt.h>
#include <stdexcept>

#include "fitting/minimisers/guarded_run.h"
#include "stats/not_a_number.h"
#include "stats/require.h"

namespace errmap::fitting {
namespace {

using Eigen::Map;
struct DestroyNlopt {
  void operator()(nlopt_opt_s* problem) const { nlopt_destroy(problem); }
};
using NloptProblem = std::unique_ptr<nlopt_opt_s, DestroyNlopt>;

struct NamedAlgorithm {
  const char* name;
  nlopt_algorithm algorithm;
};

// In the order of NloptMethod.
constexpr NamedAlgorithm kAlgorithms[] = {
    {"lbfgs", NLOPT_LD_LBFGS},
    {"tnewton_precond_restart", NLOPT_LD_TNEWTON_PRECOND_RESTART},
    {"var2", NLOPT_LD_VAR2},
    {"slsqp", NLOPT_LD_SLSQP},
    {"mma", NLOPT_LD_MMA},
    {"sbplx", NLOPT_LN_SBPLX},
    {"crs2_lm", NLOPT_GN_CRS2_LM}};

nlopt_algorithm AlgorithmOf(NloptMethod method) {
  return kAlgorithms[static_cast<std::size_t>(method)].algorithm;
}

bool HasDerivatives(NloptMethod method) {
  return method != NloptMethod::kSbplx && method != NloptMethod::kCrs2Lm;
}

// Points in a row that may bring nothing: a simplex or a population has to be
// turned over, a line search ends within dozens.
std::int64_t PatienceOf(NloptMethod method, Index size) {
  constexpr std::int64_t kOfALineSearch = 1000;
  constexpr std::int64_t kPerParameter = 100;
  constexpr std::int64_t kOfASearch = 1000;
  return HasDerivatives(method) ? kOfALineSearch
                                : kOfASearch + kPerParameter * size;
}

struct Callback {
  GuardedRun* run;
  nlopt_opt_s* problem;
};

// Returns +infinity to NLopt if there is no value; it has no other way.
double EvaluateForNlopt(unsigned size,
                        const double* x,
                        double* gradient,
                        void* data) {
  const Callback& callback = *static_cast<Callback*>(data);
  GuardedRun& run = *callback.run;
  const bool is_finite = run.Evaluate(x);
  if (is_finite) run.EndIteration();
  if (run.stopped()) nlopt_force_stop(callback.problem);
  if (gradient != nullptr) {
    Map<VectorXd> to(gradient, static_cast<Index>(size));
    if (is_finite) {
      to = run.gradient();
    } else {
      to.setZero();
    }
  }
  return is_finite ? run.cost() : HUGE_VAL;
}

void RequireSuccess(nlopt_result result, const char* what) {
  if (result == NLOPT_OUT_OF_MEMORY) throw std::bad_alloc();
  if (result < 0) {
    throw std::invalid_argument(std::string("NloptOptimizer: NLopt refuses ") +
                                what);
  }
}

NloptProblem MakeProblem(const NloptOptions& options,
                         const VectorXd& x0,
                         Callback* callback) {
  const auto size = static_cast<unsigned>(x0.size());
  NloptProblem problem(nlopt_create(AlgorithmOf(options.method), size));
  if (problem == nullptr) throw std::bad_alloc();
  callback->problem = problem.get();
  RequireSuccess(
      nlopt_set_min_objective(problem.get(), EvaluateForNlopt, callback),
      "the objective");
  const auto memory =
      static_cast<unsigned>(std::min<Index>(options.memory, x0.size()));
  RequireSuccess(nlopt_set_vector_storage(problem.get(), memory), "the memory");
  if (options.method == NloptMethod::kCrs2Lm) {
    const VectorXd half_width = options.box * x0.cwiseAbs().cwiseMax(1.0);
    const VectorXd lower = x0 - half_width;
    const VectorXd upper = x0 + half_width;
    RequireSuccess(nlopt_set_lower_bounds(problem.get(), lower.data()),
                   "the box");
    RequireSuccess(nlopt_set_upper_bounds(problem.get(), upper.data()),
                   "the box");
    // The generator is each thread's own, so that runs in parallel repeat.
    nlopt_srand(static_cast<unsigned long>(options.seed));
  }
  return problem;
}

}  // namespace

std::string NloptVersion() {
  int major = 0;
  int minor = 0;
  int patch = 0;
  nlopt_version(&major, &minor, &patch);
  return std::to_string(major) + "." + std::to_string(minor) + "." +
         std::to_string(patch);
}

const std::vector<std::string>& NloptMethodNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const NamedAlgorithm& known : kAlgorithms) all.push_back(known.name);
    return all;
  }();
  return names;
}

std::string_view ToString(NloptMethod method) {
  return NloptMethodNames()[static_cast<std::size_t>(method)];
}

void NloptOptions::Validate() const {
  stopping.Validate();
  stats::Require(
      memory >= 1, "NloptOptions: memory must be at least 1", memory);
  stats::Require(box > 0.0 && std::isfinite(box),
                 "NloptOptions: box must be above 0 and finite",
                 box);
}

std::string NloptOptimizer::name() const {
  return "nlopt:" + std::string(ToString(options_.method));
}

Minimum NloptOptimizer::DoMinimize(const Objective& f,
                                   const VectorXd& x0,
                                   const RunControl& run) const {
  if (options_.method == NloptMethod::kCrs2Lm &&
      x0.size() > kMostCrs2Parameters) {
    throw std::invalid_argument("NloptOptimizer: crs2_lm searches at most " +
                                std::to_string(kMostCrs2Parameters) +
                                " parameters, found " +
                                std::to_string(x0.size()) + "; use lbfgs");
  }
  GuardedRun guarded(
      f, options_.stopping, run, PatienceOf(options_.method, x0.size()));
  if (!guarded.Start(x0)) return guarded.Finish("");
  Callback callback{&guarded, nullptr};
  const NloptProblem problem = MakeProblem(options_, x0, &callback);
  VectorXd x = x0;
  double cost = stats::kNaN;
  const nlopt_result result = nlopt_optimize(problem.get(), x.data(), &cost);
  if (result == NLOPT_OUT_OF_MEMORY && !guarded.stopped()) {
    throw std::bad_alloc();
  }
  std::string text = nlopt_result_to_string(result);
  if (const char* details = nlopt_get_errmsg(problem.get())) {
    text += std::string(", ") + details;
  }
  return guarded.Finish("NLopt: " + text);
}

}  // namespace errmap::fitting
