// Levenberg-Marquardt on the size of the report's run 3: a 37-60-1 net, 2341
// weights, on 397 patterns. How long a step takes, and whether the objective
// that it reaches is worth the time against scaled conjugate gradients.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <limits>
#include <vector>

#include <Eigen/Core>
#include <benchmark/benchmark.h>

#include "fitting/matrix_product.h"
#include "fitting/minimisers/levenberg_marquardt.h"
#include "fitting/minimisers/scaled_conjugate_gradient.h"
#include "models/net/feedforward_net.h"
#include "tests/benchmarks/run_3.h"
#include "tests/benchmarks/timing.h"

namespace errmap {
namespace {

using fitting::Minimum;
using testing::LowerQuartile;
using testing::Median;

// Of this process, which has one thread: what a busy machine leaves as it is.
double CpuSeconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

Minimum RunLm(std::uint64_t seed, const fitting::StoppingRules& stopping) {
  return fitting::LevenbergMarquardt({.stopping = stopping})
      .Minimize(testing::TheRun3().Objective<double>(),
                models::InitialWeights(testing::TheRun3().shape, seed));
}

Minimum RunScg(std::uint64_t seed) {
  return fitting::ScaledConjugateGradient({.stopping = {.iterations = 1500}})
      .Minimize(testing::TheRun3().Objective<double>(),
                models::InitialWeights(testing::TheRun3().shape, seed));
}

// An iteration: residuals, their factors, J J', and every trial it took.
void Step(benchmark::State& state) {
  constexpr std::int64_t kSteps = 40;
  std::vector<double> steps;
  std::vector<double> cpu;
  for (auto _ : state) {
    const double start = CpuSeconds();
    const fitting::FitSummary summary =
        RunLm(1, {.iterations = kSteps}).summary;
    cpu.push_back((CpuSeconds() - start) / kSteps);
    steps.push_back(summary.mean_iteration_seconds);
    state.SetIterationTime(summary.mean_iteration_seconds);
  }
  state.counters["step_ms"] = 1e3 * LowerQuartile(steps);
  state.counters["cpu_ms"] = 1e3 * LowerQuartile(cpu);
}
BENCHMARK(Step)->UseManualTime()->Iterations(20)->Unit(benchmark::kMillisecond);

// What a step cannot do without: a Cholesky factorisation of J J'.
void Cholesky(benchmark::State& state) {
  constexpr Eigen::Index kPatterns = 397;
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(kPatterns, kPatterns);
  Eigen::MatrixXd spd = Eigen::MatrixXd::Identity(kPatterns, kPatterns);
  fitting::MultiplyByOwnTranspose(a, spd, true);
  Eigen::MatrixXd factor;
  for (auto _ : state) {
    factor = spd;
    benchmark::DoNotOptimize(fitting::FactorizeCholesky(factor));
  }
}
BENCHMARK(Cholesky)->Unit(benchmark::kMillisecond);

// For each of some starts: sqrt(2 E) that SCG reaches in 1500 iterations, that
// of LM within twice its time, and the processor time that LM takes to get
// below SCG's as a multiple of SCG's.
void DeeperThanScgInTwiceItsTime(benchmark::State& state) {
  constexpr std::uint64_t kSeeds = 20;
  std::vector<double> scg_rms;
  std::vector<double> lm_rms;
  std::vector<double> scg_cpu;
  std::vector<double> cpu_ratio;
  for (auto _ : state) {
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      double start = CpuSeconds();
      const Minimum scg = RunScg(seed);
      scg_cpu.push_back(CpuSeconds() - start);
      scg_rms.push_back(std::sqrt(2.0 * scg.summary.final_cost));
      const Minimum lm = RunLm(seed, {.seconds = 2.0 * scg.summary.seconds});
      lm_rms.push_back(std::sqrt(2.0 * lm.summary.final_cost));
      start = CpuSeconds();
      const Minimum below =
          RunLm(seed, {.iterations = 1000, .cost_goal = scg_rms.back()});
      const bool is_below =
          below.summary.termination == fitting::Termination::kCostGoal;
      cpu_ratio.push_back(is_below ? (CpuSeconds() - start) / scg_cpu.back()
                                   : std::numeric_limits<double>::infinity());
    }
  }
  state.counters["scg_rms"] = Median(scg_rms);
  state.counters["lm_rms"] = Median(lm_rms);
  state.counters["scg_cpu_s"] = LowerQuartile(scg_cpu);
  state.counters["cpu_ratio"] = Median(cpu_ratio);
  state.counters["within_twice_of_20"] = static_cast<double>(
      std::ranges::count_if(cpu_ratio, [](double r) { return r <= 2.0; }));
}
BENCHMARK(DeeperThanScgInTwiceItsTime)->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace errmap
