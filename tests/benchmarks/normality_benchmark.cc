// Time of the residual statistics. Goals: everything for 5000 values, exact
// K-S and Monte Carlo apart, in under 50 ms; n log n for a million.
//
//   build/tests/benchmarks/errmap_benchmarks
//   --benchmark_filter='Normality|Randomness|KsExact|MonteCarlo'

#include <cmath>
#include <vector>

#include <benchmark/benchmark.h>

#include "stats/bias.h"
#include "stats/normality/kolmogorov_exact.h"
#include "stats/normality/normality.h"
#include "stats/random.h"
#include "stats/randomness.h"

namespace errmap::stats {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd Sample(Index n) {
  Random random(1);
  return NormalSample(n, &random);
}

// All tests of shape; at these n the exact K-S p of this sample is part of it.
void BM_Normality(benchmark::State& state) {
  const VectorXd x = Sample(state.range(0));
  for (auto _ : state) {
    benchmark::DoNotOptimize(AssessNormality(OrderedSample(x)));
  }
  state.SetComplexityN(state.range(0));
}

// Tests of order over all and within groups of 12, halves, biases, spread.
void BM_Randomness(benchmark::State& state) {
  const VectorXd x = Sample(state.range(0));
  const VectorXd fitted = x.reverse();
  std::vector<Index> groups;
  for (Index i = 0; i < x.size(); ++i) groups.push_back(i / 12);
  for (auto _ : state) {
    benchmark::DoNotOptimize(TestSerially({x}));
    benchmark::DoNotOptimize(TestSerially(SegmentsByGroup(x, groups)));
    benchmark::DoNotOptimize(CompareHalves(x));
    benchmark::DoNotOptimize(ComputeBias(x, groups));
    benchmark::DoNotOptimize(BreuschPagan(x, fitted));
  }
  state.SetComplexityN(state.range(0));
}

void BM_KsExact(benchmark::State& state) {
  const Index n = state.range(0);
  const double d = 0.9 / std::sqrt(static_cast<double>(n));
  for (auto _ : state) benchmark::DoNotOptimize(KsProbabilityExact(d, n));
}

void BM_MonteCarlo1000(benchmark::State& state) {
  constexpr Index kDraws = 1000;
  const Index n = state.range(0);
  const NormalityTests tests(n);
  const OrderedSample sample(Sample(n));
  const Normality observed = tests(sample);
  for (auto _ : state) {
    benchmark::DoNotOptimize(tests.Simulate(sample, observed, kDraws, 1));
  }
}

BENCHMARK(BM_Normality)
    ->Arg(397)
    ->Arg(5000)
    ->Arg(100000)
    ->Arg(1000000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Randomness)
    ->Arg(397)
    ->Arg(5000)
    ->Arg(100000)
    ->Arg(1000000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(BM_KsExact)
    ->Arg(397)
    ->Arg(5000)
    ->Arg(20000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(BM_MonteCarlo1000)->Arg(30)->Arg(397)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace errmap::stats
