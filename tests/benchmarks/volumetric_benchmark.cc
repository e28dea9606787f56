// Speed of what a volumetric prediction is made of, on one core:
//
//   build/tests/benchmarks/errmap_benchmarks
//   --benchmark_filter='CubicPredictions|CombineErrors'
//
// items_per_second of BM_CubicPredictions counts predictions of one component
// by a full cubic of three inputs (20 coefficients), the whole table in one
// call; that of BM_CombineErrors counts points of a chain of 13 errors, the
// exact form, the first-order form and uncertainties without draws.

#include <vector>

#include <Eigen/Core>
#include <benchmark/benchmark.h>

#include "models/kinematics/volumetric.h"
#include "models/polynomial/polynomial_model.h"
#include "stats/random.h"
#include "tests/models/kinematics/lathe_chain.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

PolynomialModel FullCubic() {
  PolynomialForm form;
  form.input_offset = VectorXd::Constant(3, 0.1);
  form.input_scale = VectorXd::Constant(3, 0.9);
  form.intercept = 0.001;
  for (int a = 0; a <= 3; ++a) {
    for (int b = 0; a + b <= 3; ++b) {
      for (int c = 0; a + b + c <= 3; ++c) {
        if (a + b + c == 0) continue;
        form.terms.push_back({{a, b, c}, 0.001 * (1 + a - b + 2 * c)});
      }
    }
  }
  return {form, 20};
}

MatrixXd RandomInputs(Index points, Index inputs) {
  stats::Random random(1);
  MatrixXd values(points, inputs);
  for (double& value : values.reshaped()) value = random.Uniform();
  return values;
}

void BM_CubicPredictions(benchmark::State& state) {
  const PolynomialModel model = FullCubic();
  const MatrixXd inputs = RandomInputs(state.range(0), 3);
  for (auto _ : state) {
    const VectorXd errors = model.Predict(inputs);
    benchmark::DoNotOptimize(errors.data());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(BM_CubicPredictions)->Arg(1000)->Arg(100000)->Arg(1000000);

void BM_CombineErrors(benchmark::State& state) {
  const KinematicChain chain = tests::LatheChain();
  const MatrixXd coordinates = -200.0 * RandomInputs(state.range(0), 2);
  const ComponentAtPoints component{VectorXd::Constant(state.range(0), 1e-5),
                                    VectorXd::Constant(state.range(0), 1e-6)};
  const std::vector<ComponentAtPoints> components(
      static_cast<std::size_t>(chain.num_errors()), component);
  for (auto _ : state) {
    const VolumetricErrors errors =
        CombineErrors(chain, coordinates, components, {.draws = 0});
    benchmark::DoNotOptimize(errors.exact.data());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(BM_CombineErrors)->Arg(1000)->Arg(100000);

}  // namespace
}  // namespace errmap::models
