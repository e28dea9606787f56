// Selection over the 902 quadratic terms of 41 inputs, 595 rows.
#include <benchmark/benchmark.h>

#include "fitting/least_squares/triangular_reduction.h"
#include "fitting/selection/stepwise_selection.h"
#include "stats/random.h"
#include "tests/fitting/stepwise_data.h"

namespace errmap::fitting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Case {
  Case()
      : data(testing::ReadTurningCentre()),
        candidates(testing::QuadraticTerms(testing::Centred(data.inputs))) {}
  testing::TurningCentre data;
  MatrixXd candidates;
};

const Case& TheCase() {
  static const Case value;
  return value;
}

void ReportSize(benchmark::State& state, const SelectionResult& result) {
  state.counters["steps"] = static_cast<double>(result.steps.size() - 1);
  state.counters["terms"] = static_cast<double>(result.chosen.size());
}

// AIC, AICc, BIC, adjusted R2, PRESS, F and p of each step are logged.
void BM_ThirtyForwardSteps(benchmark::State& state) {
  const VectorXd none;
  const RegressionProblem problem{
      TheCase().candidates, TheCase().data.error, none};
  StepwiseOptions options;
  options.stop = Criterion::kNone;
  options.max_terms = 30;
  SelectionResult result;
  for (auto _ : state) {
    result = SelectStepwise(problem, {}, options);
    benchmark::DoNotOptimize(result);
  }
  ReportSize(state, result);
}
BENCHMARK(BM_ThirtyForwardSteps)->Unit(benchmark::kMillisecond);

// PRESS of every candidate, not only of the chosen, decides each step.
void BM_ForwardBackwardByPress(benchmark::State& state) {
  const VectorXd none;
  const RegressionProblem problem{
      TheCase().candidates, TheCase().data.error, none};
  StepwiseOptions options;
  options.direction = Direction::kBoth;
  options.select = options.stop = options.choose = Criterion::kPress;
  options.max_terms = state.range(0);
  SelectionResult result;
  for (auto _ : state) {
    result = SelectStepwise(problem, {}, options);
    benchmark::DoNotOptimize(result);
  }
  ReportSize(state, result);
}
BENCHMARK(BM_ForwardBackwardByPress)
    ->Arg(15)
    ->Arg(30)
    ->Unit(benchmark::kMillisecond);

void BM_ForwardBackwardByAicPressLogged(benchmark::State& state) {
  const VectorXd none;
  const RegressionProblem problem{
      TheCase().candidates, TheCase().data.error, none};
  StepwiseOptions options;
  options.direction = Direction::kBoth;
  options.select = options.stop = Criterion::kAic;
  options.choose = Criterion::kPress;
  SelectionResult result;
  for (auto _ : state) {
    result = SelectStepwise(problem, {}, options);
    benchmark::DoNotOptimize(result);
  }
  ReportSize(state, result);
}
BENCHMARK(BM_ForwardBackwardByAicPressLogged)->Unit(benchmark::kMillisecond);

// Rows drawn with replacement, as multiplicities; forward by BIC.
void BM_TwoHundredBootstraps(benchmark::State& state) {
  const Index rows = TheCase().data.error.size();
  std::size_t terms = 0;
  for (auto _ : state) {
    stats::Random random(1);
    terms = 0;
    for (int repetition = 0; repetition < 200; ++repetition) {
      VectorXd times = VectorXd::Zero(rows);
      for (Index i = 0; i < rows; ++i) {
        times[static_cast<Index>(
            random.Below(static_cast<std::uint64_t>(rows)))] += 1.0;
      }
      const RegressionProblem problem{
          TheCase().candidates, TheCase().data.error, times};
      terms += SelectStepwise(problem, {}, {}).chosen.size();
    }
  }
  state.counters["terms"] = static_cast<double>(terms) / 200.0;
}
BENCHMARK(BM_TwoHundredBootstraps)->Unit(benchmark::kMillisecond);

// Rows per second of the one pass over 947 columns (degree 2 of 42 inputs).
void BM_ReduceToTriangle(benchmark::State& state) {
  constexpr Index kRows = 16384;
  constexpr Index kColumns = 947;
  const MatrixXd block = MatrixXd::Random(2048, kColumns);
  for (auto _ : state) {
    const MatrixXd triangle =
        ReduceToTriangle(kRows,
                         kColumns,
                         [&](Index, Eigen::Ref<MatrixXd> rows) {
                           rows = block.topRows(rows.rows());
                         },
                         {.threads = static_cast<int>(state.range(0))});
    benchmark::DoNotOptimize(triangle.data());
  }
  state.counters["rows/s"] =
      benchmark::Counter(static_cast<double>(kRows),
                         benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(BM_ReduceToTriangle)
    ->Arg(1)
    ->Arg(2)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace errmap::fitting
