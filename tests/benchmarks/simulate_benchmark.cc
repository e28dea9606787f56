// How long a simulation takes, and how well its day 1 meets the report:
//
//   build/tests/benchmarks/errmap_benchmarks --benchmark_filter='Simulate'
//
// The counter rmse_um is that of the noise-free X displacement against the 397
// measured records of NISTIR 5367, Appendix B.

#include <cmath>
#include <string>

#include <benchmark/benchmark.h>

#include "cli/turning_centre/simulation.h"
#include "cli/turning_centre/simulation_files.h"
#include "data/csv.h"
#include "tests/places.h"

namespace errmap::turning_centre {
namespace {

using data::ColumnValues;
using data::CsvTable;
using data::ReadCsv;

double RmseOfReportDay(const Simulation& simulation) {
  const CsvTable table =
      ReadCsv(tests::SourceDir() + "/data/sets/nistir5367_xdisp_down.csv");
  const auto column = [&](const char* name) -> const ColumnValues& {
    return table.columns[static_cast<std::size_t>(table.Find(name))].values;
  };
  double sum_of_squares = 0.0;
  for (std::size_t row = 0; row < table.num_rows; ++row) {
    const double position = column("position_mm")[row];
    const auto place = std::lround(-position / kXStep) - 1;
    const auto cycle = std::lround(column("cycle")[row]) - 1;
    const Stop& stop = simulation.stops[static_cast<std::size_t>(
        cycle * kNumSweeps * kStopsPerSweep + place)];
    const double error = TrueError(Component::kXDisplacement,
                                   position,
                                   Direction::kForward,
                                   stop.rise) -
                         column("error_mm")[row];
    sum_of_squares += error * error;
  }
  return 1e3 * std::sqrt(sum_of_squares / static_cast<double>(table.num_rows));
}

// Days of 35 cycles of 17 positions: the machine alone.
void BM_Simulate(benchmark::State& state) {
  const SimulationOptions options{.days = static_cast<int>(state.range(0))};
  for (auto _ : state) {
    benchmark::DoNotOptimize(Simulate(options));
  }
  state.counters["rmse_um"] = RmseOfReportDay(Simulate(options));
}
BENCHMARK(BM_Simulate)->Arg(1)->Arg(18)->Unit(benchmark::kMillisecond);

// The same with the text of every file, without writing it.
void BM_SimulateAllFiles(benchmark::State& state) {
  const SimulationOptions options{.days = static_cast<int>(state.range(0))};
  double bytes = 0.0;
  for (auto _ : state) {
    const Simulation simulation = Simulate(options);
    bytes = 0.0;
    for (const std::string& name : SimulationFileNames()) {
      bytes += static_cast<double>(
          SimulationFile(simulation, {.truth = true}, name).size());
    }
  }
  state.counters["bytes"] = bytes;
}
BENCHMARK(BM_SimulateAllFiles)->Arg(18)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace errmap::turning_centre
