// What the foreign solvers cost beside the objective, on the size of the
// report's run 3: a 37-60-1 net (2341 weights) on 397 patterns. `ratio` is the
// time from one evaluation's end to the next one's, all that the solver does in
// between included, against that of one of our gradients, measured in turns
// with it.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>
#include <benchmark/benchmark.h>

#include "fitting/minimisers/ceres_optimizer.h"
#include "fitting/minimisers/nlopt_optimizer.h"
#include "models/net/feedforward_net.h"
#include "models/net/net_objective.h"
#include "models/scaling.h"
#include "tests/models/golden_netcg.h"

namespace errmap {
namespace {

constexpr Eigen::Index kHidden = 60;
constexpr double kWfactor = 1.3e-3;  // of that run, too

// Simulated temperatures of tests/golden/netcg, every input standardised.
struct Workload {
  models::NetShape shape;
  std::unique_ptr<models::NetObjective> objective;
  Eigen::VectorXd start;
};

const Workload& TheWorkload() {
  static const Workload workload = [] {
    const testing::GoldenCase golden = testing::ReadGoldenCase("case_a");
    const auto scaling = models::StandardScaling(golden.inputs);
    Workload made;
    made.shape = {golden.shape.inputs, kHidden, 1};
    made.objective =
        std::make_unique<models::NetObjective>(made.shape,
                                               scaling.Apply(golden.inputs),
                                               golden.scaled_targets,
                                               kWfactor);
    made.start = models::InitialWeights(made.shape, 1);
    return made;
  }();
  return workload;
}

double SecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
      .count();
}

// The machine is not ours alone: of many times the lower quartile is that of
// the work itself.
double LowerQuartile(std::vector<double> times) {
  const auto quarter =
      times.begin() + static_cast<std::ptrdiff_t>(times.size() / 4);
  std::ranges::nth_element(times, quarter);
  return *quarter;
}

double GradientSeconds() {
  constexpr int kRuns = 200;
  const Workload& workload = TheWorkload();
  Eigen::VectorXd gradient;
  std::vector<double> times;
  for (int run = 0; run < kRuns; ++run) {
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(
        workload.objective->Evaluate(workload.start, &gradient));
    times.push_back(SecondsSince(start));
  }
  return LowerQuartile(std::move(times));
}

// Notes when each evaluation ended.
class TimedObjective final : public fitting::Objective {
 public:
  explicit TimedObjective(const fitting::Objective& objective)
      : objective_(objective) {}
  Eigen::Index num_parameters() const override {
    return objective_.num_parameters();
  }
  double Evaluate(const Vector& x, Vector* gradient) const override {
    const double value = objective_.Evaluate(x, gradient);
    const auto now = std::chrono::steady_clock::now();
    if (has_begun_) {
      times_.push_back(std::chrono::duration<double>(now - last_).count());
    }
    has_begun_ = true;
    last_ = now;
    return value;
  }
  const fitting::ResidualFunction* residuals() const override {
    return objective_.residuals();
  }
  const std::vector<double>& times() const { return times_; }

 private:
  const fitting::Objective& objective_;
  mutable bool has_begun_ = false;
  mutable std::chrono::steady_clock::time_point last_;
  mutable std::vector<double> times_;
};

void Compare(benchmark::State& state, const fitting::Optimizer& optimizer) {
  const Workload& workload = TheWorkload();
  std::vector<double> gradients;
  std::vector<double> evaluations;
  double cost = 0.0;
  for (auto _ : state) {
    gradients.push_back(GradientSeconds());
    const TimedObjective timed(*workload.objective);
    const fitting::FitSummary summary =
        optimizer.Minimize(timed, workload.start).summary;
    evaluations.push_back(LowerQuartile(timed.times()));
    cost = summary.final_cost;
    state.SetIterationTime(summary.seconds);
  }
  const double gradient = LowerQuartile(std::move(gradients));
  const double evaluation = LowerQuartile(std::move(evaluations));
  state.counters["gradient_us"] = 1e6 * gradient;
  state.counters["evaluation_us"] = 1e6 * evaluation;
  state.counters["ratio"] = evaluation / gradient;
  state.counters["rms"] = std::sqrt(2.0 * cost);
}

constexpr std::int64_t kEvaluations = 1000;

void CeresLbfgs(benchmark::State& state) {
  Compare(
      state,
      fitting::CeresOptimizer({.stopping = {.evaluations = kEvaluations},
                               .method = fitting::CeresMethod::kLbfgs,
                               .memory = static_cast<int>(state.range(0))}));
}
BENCHMARK(CeresLbfgs)
    ->UseManualTime()
    ->ArgName("memory")
    ->Arg(3)
    ->Arg(5)
    ->Arg(10)
    ->Arg(20)
    ->Iterations(9)
    ->Unit(benchmark::kMillisecond);

void NloptLbfgs(benchmark::State& state) {
  Compare(
      state,
      fitting::NloptOptimizer({.stopping = {.evaluations = kEvaluations},
                               .method = fitting::NloptMethod::kLbfgs,
                               .memory = static_cast<int>(state.range(0))}));
}
BENCHMARK(NloptLbfgs)
    ->UseManualTime()
    ->ArgName("memory")
    ->Arg(3)
    ->Arg(5)
    ->Arg(10)
    ->Arg(20)
    ->Iterations(9)
    ->Unit(benchmark::kMillisecond);

// A step of Levenberg and Marquardt's method by Ceres: evaluation_us of it.
void CeresLevenbergMarquardt(benchmark::State& state) {
  Compare(state,
          fitting::CeresOptimizer(
              {.stopping = {.evaluations = 5},
               .method = fitting::CeresMethod::kLevenbergMarquardt}));
}
BENCHMARK(CeresLevenbergMarquardt)
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace errmap
