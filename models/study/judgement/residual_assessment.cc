#include "models/study/judgement/residual_assessment.h"

#include "data/csv.h"

namespace errmap::models {

ResidualReport AssessResiduals(const ResidualInputs& inputs,
                               Index monte_carlo,
                               std::uint64_t seed) {
  ResidualReport report;
  report.order = inputs.order;
  const stats::OrderedSample sample(inputs.values);
  const stats::NormalityTests tests(sample.size());
  report.normality = tests(sample);
  if (monte_carlo > 0) {
    report.monte_carlo =
        tests.Simulate(sample, report.normality, monte_carlo, seed);
  }
  report.whole = stats::TestSerially({inputs.values});
  report.halves = stats::CompareHalves(inputs.values);
  if (monte_carlo > 0) {
    report.whole_shuffles =
        stats::ShuffleSerially({inputs.values}, monte_carlo, seed);
  }
  if (!inputs.group_column.empty()) {
    report.group_column = inputs.group_column;
    const stats::Segments groups =
        stats::SegmentsByGroup(inputs.values, inputs.group_codes);
    report.within = stats::TestSerially(groups);
    if (monte_carlo > 0) {
      report.within_shuffles =
          stats::ShuffleSerially(groups, monte_carlo, seed);
    }
    report.by_group = NamedBias{
        .column = inputs.group_column,
        .labels = inputs.group_labels,
        .bias = stats::ComputeBias(inputs.values, inputs.group_codes)};
  }
  if (!inputs.position_column.empty()) {
    NamedBias by_position{
        .column = inputs.position_column, .labels = {}, .bias = {}};
    std::vector<double> positions;
    const auto codes = stats::CodesOfValues(inputs.positions, &positions);
    for (const double position : positions) {
      by_position.labels.push_back(data::CsvNumber(position));
    }
    by_position.bias = stats::ComputeBias(inputs.values, codes);
    report.by_position = std::move(by_position);
  }
  if (!inputs.fitted_column.empty()) {
    report.fitted_column = inputs.fitted_column;
    report.breusch_pagan = stats::BreuschPagan(inputs.values, inputs.fitted);
  }
  return report;
}

}  // namespace errmap::models
