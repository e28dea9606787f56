#include "fitting/minimisers/ceres_optimizer.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <ceres/cost_function.h>
#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>
#include <ceres/iteration_callback.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <ceres/version.h>
#include <glog/logging.h>

#include "fitting/minimisers/guarded_run.h"
#include "stats/require.h"

namespace errmap::fitting {
namespace {

using Eigen::Map;
using RowMajorMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// A line search that fails asks for at most some dozens of points.
constexpr std::int64_t kPatience = 1000;

// Ceres warns of every infeasible trial point; that is none of a user's
// business. Set once: the flag is the whole program's.
void SilenceLogging() {
  static const bool silenced = [] {
    FLAGS_minloglevel = google::GLOG_FATAL;
    return true;
  }();
  static_cast<void>(silenced);
}

// Tells the run of every iteration, and Ceres when the run is over.
class IterationEnd final : public ceres::IterationCallback {
 public:
  explicit IterationEnd(GuardedRun* run) : run_(run) {}

  ceres::CallbackReturnType operator()(
      const ceres::IterationSummary& /*summary*/) override {
    run_->EndIteration();
    return run_->stopped() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  GuardedRun* run_;
};

class GuardedFunction final : public ceres::FirstOrderFunction {
 public:
  GuardedFunction(GuardedRun* run, int size) : run_(run), size_(size) {}

  bool Evaluate(const double* x,
                double* cost,
                double* gradient) const override {
    if (!run_->Evaluate(x)) return false;
    *cost = run_->cost();
    if (gradient != nullptr) {
      Map<VectorXd>(gradient, size_) = run_->gradient();
    }
    return true;
  }
  int NumParameters() const override { return size_; }

 private:
  GuardedRun* run_;
  int size_;
};

// The residuals, followed by those of the ridge if there is one.
class GuardedResiduals final : public ceres::CostFunction {
 public:
  GuardedResiduals(GuardedRun* run, const ResidualFunction& f, Index size)
      : run_(run), f_(f), root_ridge_(std::sqrt(f.ridge())) {
    mutable_parameter_block_sizes()->push_back(static_cast<int>(size));
    const Index ridge_rows = f.ridge() > 0.0 ? size : 0;
    set_num_residuals(static_cast<int>(f.num_residuals() + ridge_rows));
  }

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    if (!run_->Evaluate(parameters[0]) || !run_->Spend()) return false;
    const bool wants_jacobian = jacobians != nullptr && jacobians[0] != nullptr;
    try {
      f_.Evaluate(run_->x(), &r_, wants_jacobian ? &jacobian_ : nullptr);
    } catch (...) {
      run_->Fail();
      return false;
    }
    const Index rows = r_.size();
    const Index size = run_->x().size();
    const bool has_ridge = num_residuals() > rows;
    Map<VectorXd> all(residuals, num_residuals());
    all.head(rows) = r_;
    if (has_ridge) all.tail(size) = root_ridge_ * run_->x();
    if (!wants_jacobian) return all.allFinite();
    Map<RowMajorMatrix> slopes(jacobians[0], num_residuals(), size);
    slopes.topRows(rows) = jacobian_;
    if (has_ridge) {
      slopes.bottomRows(size).setZero();
      slopes.bottomRows(size).diagonal().setConstant(root_ridge_);
    }
    return all.allFinite() && jacobian_.allFinite();
  }

 private:
  GuardedRun* run_;
  const ResidualFunction& f_;
  const double root_ridge_;
  mutable VectorXd r_;
  mutable MatrixXd jacobian_;
};

bool NeedsResiduals(CeresMethod method) {
  return method == CeresMethod::kLevenbergMarquardt ||
         method == CeresMethod::kDogleg;
}

ceres::LineSearchDirectionType DirectionOf(CeresMethod method) {
  switch (method) {
    case CeresMethod::kBfgs:
      return ceres::BFGS;
    case CeresMethod::kNonlinearCg:
      return ceres::NONLINEAR_CONJUGATE_GRADIENT;
    default:
      return ceres::LBFGS;
  }
}

std::string MinimizeByGradients(const CeresOptions& options,
                                CeresMethod method,
                                GuardedRun* run,
                                VectorXd* x) {
  IterationEnd iteration_end(run);
  ceres::GradientProblemSolver::Options ceres_options;
  ceres_options.line_search_direction_type = DirectionOf(method);
  ceres_options.nonlinear_conjugate_gradient_type = ceres::POLAK_RIBIERE;
  ceres_options.max_lbfgs_rank = options.memory;
  ceres_options.max_num_iterations = std::numeric_limits<int>::max();
  ceres_options.max_solver_time_in_seconds = std::numeric_limits<double>::max();
  ceres_options.function_tolerance = 0.0;
  ceres_options.gradient_tolerance = 0.0;
  ceres_options.parameter_tolerance = 0.0;
  ceres_options.logging_type = ceres::SILENT;
  ceres_options.callbacks = {&iteration_end};
  // Ceres takes ownership of the function.
  const ceres::GradientProblem problem(
      new GuardedFunction(run, static_cast<int>(x->size())));
  ceres::GradientProblemSolver::Summary summary;
  ceres::Solve(ceres_options, problem, x->data(), &summary);
  return summary.message;
}

std::string MinimizeByResiduals(const ResidualFunction& residuals,
                                CeresMethod method,
                                GuardedRun* run,
                                VectorXd* x) {
  // An orthogonal decomposition keeps twice the digits of normal equations;
  // with many parameters it would take several times as long.
  constexpr Index kMostForQr = 300;
  // Limit of steps in a row without a value; each halves the radius.
  constexpr int kInvalidSteps = 50;
  IterationEnd iteration_end(run);
  ceres::Solver::Options options;
  options.trust_region_strategy_type = method == CeresMethod::kDogleg
                                           ? ceres::DOGLEG
                                           : ceres::LEVENBERG_MARQUARDT;
  options.linear_solver_type =
      x->size() <= kMostForQr ? ceres::DENSE_QR : ceres::DENSE_NORMAL_CHOLESKY;
  options.num_threads = 1;
  options.max_num_iterations = std::numeric_limits<int>::max();
  options.max_solver_time_in_seconds = std::numeric_limits<double>::max();
  options.max_num_consecutive_invalid_steps = kInvalidSteps;
  options.function_tolerance = 0.0;
  options.gradient_tolerance = 0.0;
  options.parameter_tolerance = 0.0;
  options.logging_type = ceres::SILENT;
  options.callbacks = {&iteration_end};
  ceres::Problem problem;
  // Ceres takes ownership of the function.
  problem.AddResidualBlock(
      new GuardedResiduals(run, residuals, x->size()), nullptr, x->data());
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary.message;
}

}  // namespace

std::string CeresVersion() { return CERES_VERSION_STRING; }

const std::vector<std::string>& CeresMethodNames() {
  static const std::vector<std::string> names = {
      "auto", "levenberg_marquardt", "dogleg", "lbfgs", "bfgs", "nonlinear_cg"};
  return names;
}

std::string_view ToString(CeresMethod method) {
  return CeresMethodNames()[static_cast<std::size_t>(method)];
}

void CeresOptions::Validate() const {
  stopping.Validate();
  stats::Require(
      memory >= 1, "CeresOptions: memory must be at least 1", memory);
}

std::string CeresOptimizer::name() const {
  return "ceres:" + std::string(ToString(options_.method));
}

CeresMethod CeresOptimizer::MethodFor(const Objective& f) const {
  if (options_.method != CeresMethod::kAuto) return options_.method;
  // Multiplications of one step that are still well below a second.
  constexpr double kMostWork = 1e9;
  const ResidualFunction* residuals = f.residuals();
  if (residuals == nullptr) return CeresMethod::kLbfgs;
  const auto size = static_cast<double>(f.num_parameters());
  const auto rows = static_cast<double>(residuals->num_residuals());
  return (rows + size) * size * size <= kMostWork
             ? CeresMethod::kLevenbergMarquardt
             : CeresMethod::kLbfgs;
}

Minimum CeresOptimizer::DoMinimize(const Objective& f,
                                   const VectorXd& x0,
                                   const RunControl& run) const {
  const CeresMethod method = MethodFor(f);
  const ResidualFunction* residuals = f.residuals();
  if (NeedsResiduals(method) && residuals == nullptr) {
    throw std::invalid_argument(
        "CeresOptimizer: " + std::string(ToString(method)) +
        " needs an objective that is a sum of squared residuals; use lbfgs");
  }
  SilenceLogging();
  GuardedRun guarded(f, options_.stopping, run, kPatience);
  if (!guarded.Start(x0)) return guarded.Finish("");
  VectorXd x = x0;
  std::string text;
  try {
    text = NeedsResiduals(method)
               ? MinimizeByResiduals(*residuals, method, &guarded, &x)
               : MinimizeByGradients(options_, method, &guarded, &x);
  } catch (...) {
    guarded.Fail();
  }
  return guarded.Finish("Ceres: " + text);
}

}  // namespace errmap::fitting
