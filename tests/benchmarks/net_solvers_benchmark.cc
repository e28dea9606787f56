// What the foreign solvers cost beside the objective, on the size of the
// report's run 3: a 37-60-1 net (2341 weights) on 397 patterns. `ratio` is the
// time from one evaluation's end to the next one's, all that the solver does in
// between included, against that of one of our gradients, measured in turns
// with it.

#include <chrono>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <benchmark/benchmark.h>

#include "fitting/minimisers/ceres_optimizer.h"
#include "fitting/minimisers/nlopt_optimizer.h"
#include "models/net/feedforward_net.h"
#include "tests/benchmarks/run_3.h"
#include "tests/benchmarks/timing.h"

namespace errmap {
namespace {

using testing::LowerQuartile;
using testing::SecondsSince;

Eigen::VectorXd Start() {
  return models::InitialWeights(testing::TheRun3().shape, 1);
}

double GradientSeconds() {
  constexpr int kRuns = 200;
  const auto objective = testing::TheRun3().Objective<double>();
  const Eigen::VectorXd start_weights = Start();
  Eigen::VectorXd gradient;
  std::vector<double> times;
  for (int run = 0; run < kRuns; ++run) {
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(objective.Evaluate(start_weights, &gradient));
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
  const auto objective = testing::TheRun3().Objective<double>();
  std::vector<double> gradients;
  std::vector<double> evaluations;
  double cost = 0.0;
  for (auto _ : state) {
    gradients.push_back(GradientSeconds());
    const TimedObjective timed(objective);
    const fitting::FitSummary summary =
        optimizer.Minimize(timed, Start()).summary;
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
