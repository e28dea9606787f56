// Writes stats/normality/simulated_quantiles_data.cc to standard output:
//
//   ninja -C build simulate_null_tables &&
//     build/tests/simulate_null_tables >
//     stats/normality/simulated_quantiles_data.cc
//
// The null distributions of Lilliefors' D, of the probability plots'
// correlations and of Hartigan's dip have no closed form. For each size this
// draws samples (seeded: the same bytes every time), computes the statistics
// with the library's own code, and writes the quantiles of the sorted values.
// Takes about ten minutes on one core.

#include <algorithm>
#include <cstdio>
#include <vector>

#include "stats/kolmogorov_smirnov.h"
#include "stats/normality/bimodality.h"
#include "stats/normality/ordered_sample.h"
#include "stats/normality/probability_plot.h"
#include "stats/normality/simulated_quantiles_data.h"
#include "stats/random.h"

namespace errmap::stats {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kCheapValues = 1e8;  // per size, of all samples together
constexpr double kFewestCheap = 6e4;
constexpr double kMostCheap = 5e5;
constexpr double kFamilyValues = 2e7;
constexpr double kFewestFamily = 1e4;
constexpr double kMostFamily = 2e5;

simulated::Quantiles QuantilesOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  simulated::Quantiles quantiles{};
  for (std::size_t i = 0; i < quantiles.size(); ++i) {
    const double share = 1.0 - simulated::kLevels[i];
    quantiles[i] = values[static_cast<std::size_t>(
        share * static_cast<double>(values.size()))];
  }
  return quantiles;
}

struct Tables {
  std::array<std::array<simulated::Quantiles, simulated::kNumSizes>,
             simulated::kNumStatistics>
      of;
};

void Simulate(Index n, std::size_t row, Tables* tables) {
  const double size = static_cast<double>(n);
  const double draws =
      std::clamp(kCheapValues / size, kFewestCheap, kMostCheap);
  const double family_draws =
      std::clamp(kFamilyValues / size, kFewestFamily, kMostFamily);
  Random random(static_cast<std::uint64_t>(n));
  const VectorXd medians = NormalMedians(n);
  const TukeyPlot plot(n);
  std::array<std::vector<double>, simulated::kNumStatistics> values;
  for (double i = 0; i < draws; ++i) {
    const OrderedSample sample(NormalSample(n, &random));
    values[0].push_back(KsDistanceFromStandardNormal(sample.z()));
    values[1].push_back(1.0 - PlotCorrelation(sample.z(), medians));
    if (i < family_draws) {
      values[2].push_back(1.0 - plot.Curve(sample.z()).best_r);
    }
    VectorXd uniform(n);
    for (double& value : uniform) value = random.Uniform();
    std::sort(uniform.begin(), uniform.end());
    values[3].push_back(DipStatistic(uniform));
  }
  for (std::size_t s = 0; s < values.size(); ++s) {
    tables->of[s][row] = QuantilesOf(std::move(values[s]));
  }
}

void Print(const Tables& tables) {
  std::printf(
      "// Written by tests/stats/normality/simulate_null_tables.cc; do not "
      "edit.\n"
      "#include \"stats/normality/simulated_quantiles_data.h\"\n\n"
      "namespace errmap::stats::simulated {\n\n"
      "// clang-format off\n"
      "const std::array<std::array<Quantiles, kNumSizes>, kNumStatistics>\n"
      "    kTables = {{\n");
  const char* const names[] = {"Lilliefors' D",
                               "1 - r of the normal probability plot",
                               "1 - largest r over Tukey's family",
                               "Hartigan's dip"};
  for (std::size_t s = 0; s < simulated::kNumStatistics; ++s) {
    std::printf("  {{  // %s\n", names[s]);
    for (std::size_t row = 0; row < simulated::kNumSizes; ++row) {
      std::printf("    {{");
      for (std::size_t i = 0; i < simulated::kNumLevels; ++i) {
        const bool wrap = i % 7 == 0 && i > 0;
        std::printf("%s%.6g%s",
                    wrap ? "\n      " : (i > 0 ? " " : ""),
                    tables.of[s][row][i],
                    i + 1 < simulated::kNumLevels ? "," : "}},");
      }
      std::printf("  // n = %d\n", simulated::kSizes[row]);
    }
    std::printf("  }},\n");
  }
  std::printf(
      "}};\n// clang-format on\n\n}  // namespace errmap::stats::simulated\n");
}

}  // namespace
}  // namespace errmap::stats

int main() {
  errmap::stats::Tables tables;
  for (std::size_t row = 0; row < errmap::stats::simulated::kNumSizes; ++row) {
    errmap::stats::Simulate(
        errmap::stats::simulated::kSizes[row], row, &tables);
  }
  errmap::stats::Print(tables);
}
