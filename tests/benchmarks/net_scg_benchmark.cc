// How near scaled conjugate gradients come to the limit of the machine, on the
// size of the report's run 3: a 37-60-1 net on 397 patterns.
//
// The bound of an iteration is what it cannot do without: one product forward
// (397 x 38 x 60), one of the same size backward, and one logistic pass over
// the hidden nodes, each by the fastest code at hand, measured beside the runs.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <benchmark/benchmark.h>

#include "fitting/matrix_product.h"
#include "fitting/minimisers/scaled_conjugate_gradient.h"
#include "models/net/feedforward_net.h"
#include "models/net/net_kernels.h"
#include "models/net/net_objective.h"
#include "tests/benchmarks/run_3.h"
#include "tests/benchmarks/timing.h"

namespace errmap {
namespace {

using Eigen::Index;
using fitting::FitSummary;
using models::AlignedMatrix;
using models::NetShape;
using testing::LowerQuartile;
using testing::Median;
using testing::SecondsSince;
using testing::TheRun3;

constexpr std::int64_t kIterations = 1500;

template <typename Scalar>
using MatrixOf = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

// The same objective without its path: every value, gradient and curvature by
// a plain evaluation.
template <typename Scalar>
class WithoutPath final : public fitting::BasicObjective<Scalar> {
 public:
  using Vector = fitting::VectorOf<Scalar>;
  explicit WithoutPath(const fitting::BasicObjective<Scalar>& objective)
      : objective_(objective) {}
  Index num_parameters() const override { return objective_.num_parameters(); }
  Scalar Evaluate(const Vector& x, Vector* gradient) const override {
    return objective_.Evaluate(x, gradient);
  }

 private:
  const fitting::BasicObjective<Scalar>& objective_;
};

template <typename Work>
double SecondsOf(Work work) {
  constexpr int kRuns = 400;
  std::vector<double> times;
  for (int run = 0; run < kRuns; ++run) {
    const auto start = std::chrono::steady_clock::now();
    work();
    times.push_back(SecondsSince(start));
  }
  return LowerQuartile(std::move(times));
}

struct Bound {
  double forward = 0.0;
  double backward = 0.0;
  double logistic = 0.0;

  double seconds() const { return forward + backward + logistic; }
};

template <typename Scalar>
Bound MeasureBound() {
  const testing::Run3& run = TheRun3();
  const Index patterns = run.inputs.rows();
  const Index inputs = run.inputs.cols() + 1;
  const Index hidden = run.shape.hidden;
  const MatrixOf<Scalar> x = MatrixOf<Scalar>::Random(inputs, patterns);
  const MatrixOf<Scalar> w = MatrixOf<Scalar>::Random(hidden, inputs);
  MatrixOf<Scalar> s(hidden, patterns);
  MatrixOf<Scalar> y(hidden, patterns);
  MatrixOf<Scalar> g(hidden, inputs);
  Bound bound;
  bound.forward = std::min(SecondsOf([&] { fitting::Multiply(w, x, s); }),
                           SecondsOf([&] { s.noalias() = w * x; }));
  bound.backward =
      std::min(SecondsOf([&] { fitting::MultiplyTransposed(s, x, g); }),
               SecondsOf([&] { g.noalias() = s * x.transpose(); }));
  bound.logistic =
      std::min(SecondsOf([&] {
                 models::FastestNetKernels<Scalar>().logistic(
                     s.size(), s.data(), y.data());
               }),
               SecondsOf([&] { y.array() = s.array().logistic(); }));
  return bound;
}

template <typename Scalar>
fitting::Minimum RunScg(
    const fitting::BasicObjective<Scalar>& objective,
    std::uint64_t seed,
    const std::function<void(const fitting::ScgPass&)>& observer = {}) {
  const fitting::BasicScaledConjugateGradient<Scalar> scg(
      {.stopping = {.iterations = kIterations}, .observer = observer});
  const Eigen::VectorXd start = models::InitialWeights(TheRun3().shape, seed);
  return scg.Minimize(objective, start.cast<Scalar>());
}

// Passes and parts of the bound in turns; `ratio` of one to the other.
template <typename Scalar>
void ScgAgainstBound(benchmark::State& state) {
  const auto objective = TheRun3().Objective<Scalar>();
  std::vector<double> bounds;
  std::vector<double> passes;
  double shortest = std::numeric_limits<double>::infinity();
  double cost = 0.0;
  for (auto _ : state) {
    bounds.push_back(MeasureBound<Scalar>().seconds());
    auto last = std::chrono::steady_clock::now();
    const fitting::Minimum minimum =
        RunScg<Scalar>(objective, 1, [&](const fitting::ScgPass&) {
          passes.push_back(SecondsSince(last));
          last = std::chrono::steady_clock::now();
        });
    shortest = std::min(shortest, minimum.summary.seconds);
    cost = minimum.summary.final_cost;
    state.SetIterationTime(minimum.summary.seconds);
  }
  const auto iterations = static_cast<double>(kIterations);
  const double bound = LowerQuartile(bounds);
  const double pass = LowerQuartile(passes);
  state.counters["bound_s"] = iterations * bound;
  state.counters["scg_s"] = iterations * pass;
  state.counters["ratio"] = pass / bound;
  state.counters["whole_run_s"] = shortest;
  state.counters["rms"] = std::sqrt(2.0 * cost);
}
BENCHMARK_TEMPLATE(ScgAgainstBound, double)
    ->UseManualTime()
    ->Iterations(15)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(ScgAgainstBound, float)
    ->UseManualTime()
    ->Iterations(15)
    ->Unit(benchmark::kMillisecond);

template <typename Scalar>
void PartsOfTheBound(benchmark::State& state) {
  Bound bound;
  for (auto _ : state) bound = MeasureBound<Scalar>();
  state.counters["forward_us"] = 1e6 * bound.forward;
  state.counters["backward_us"] = 1e6 * bound.backward;
  state.counters["logistic_us"] = 1e6 * bound.logistic;
}
BENCHMARK_TEMPLATE(PartsOfTheBound, double)->Iterations(5);
BENCHMARK_TEMPLATE(PartsOfTheBound, float)->Iterations(5);

// Is speed paid for in quality? Final costs, both by the plain objective.
void QualityOverSeeds(benchmark::State& state) {
  constexpr std::uint64_t kSeeds = 20;
  const auto objective = TheRun3().Objective<double>();
  const auto single = TheRun3().Objective<float>();
  const WithoutPath<double> plain(objective);
  std::vector<double> by_path;
  std::vector<double> in_single;
  std::vector<double> by_evaluations;
  const auto cost = [&](const fitting::Minimum& minimum) {
    return objective.Evaluate(minimum.x, nullptr);
  };
  for (auto _ : state) {
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      by_path.push_back(cost(RunScg<double>(objective, seed)));
      in_single.push_back(cost(RunScg<float>(single, seed)));
      by_evaluations.push_back(cost(RunScg<double>(plain, seed)));
    }
  }
  const double reference = Median(by_evaluations);
  state.counters["median_cost"] = reference;
  state.counters["path_ratio"] = Median(by_path) / reference;
  state.counters["single_ratio"] = Median(in_single) / reference;
}
BENCHMARK(QualityOverSeeds)->Iterations(1)->Unit(benchmark::kSecond);

// Time per iteration against the number of patterns: 10 inputs, 20 nodes.
void IterationOverPatterns(benchmark::State& state) {
  constexpr Index kInputs = 10;
  constexpr std::int64_t kSteps = 10;
  const NetShape shape{kInputs, 20, 1};
  const Index patterns = state.range(0);
  const Eigen::MatrixXd inputs = Eigen::MatrixXd::Random(patterns, kInputs);
  const Eigen::MatrixXd targets =
      0.5 + 0.4 * (inputs.rowwise().sum().array() / 3.0).sin();
  const models::NetObjective objective(
      shape, inputs, targets, testing::kRun3Wfactor);
  const Eigen::VectorXd start = models::InitialWeights(shape, 1);
  const fitting::ScaledConjugateGradient scg(
      {.stopping = {.iterations = kSteps}});
  for (auto _ : state) {
    const FitSummary summary = scg.Minimize(objective, start).summary;
    state.SetIterationTime(summary.mean_iteration_seconds);
  }
  state.SetComplexityN(patterns);
  state.SetItemsProcessed(state.iterations() * patterns);
}
BENCHMARK(IterationOverPatterns)
    ->UseManualTime()
    ->RangeMultiplier(10)
    ->Range(100, 1'000'000)
    ->Iterations(3)
    ->Complexity(benchmark::oN)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace errmap
