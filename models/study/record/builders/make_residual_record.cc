#include <cmath>
#include <vector>

#include "models/study/record/builders/parts.h"

namespace errmap::models {
namespace {

template <typename Test>
Test MakeTest(const stats::TestResult& test) {
  Test record{test.statistic, test.p, {}};
  if (!test.ok()) record.why = test.why_not;
  return record;
}

PpccRecord PpccOf(const stats::Normality& normality) {
  const stats::TestResult& tukey = normality.tukey_ppcc;
  PpccRecord record;
  if (!tukey.ok()) {
    record.why = tukey.why_not;
    return record;
  }
  record.lambda = normality.curve.best_lambda;
  record.r_max = tukey.statistic;
  record.p_max = tukey.p;
  record.r_014 = normality.curve.r_at_014;
  record.r_normal = normality.normal_ppcc.statistic;
  record.p_normal = normality.normal_ppcc.p;
  return record;
}

SerialRecord SerialOf(const stats::SerialTests& tests,
                      const stats::SerialShuffles& shuffles) {
  SerialRecord record;
  record.runs.test.value = MakeTest<ZTestRecord>(tests.runs);
  if (tests.runs.ok()) {
    record.runs.runs = tests.num_runs;
    record.runs.expected = tests.expected_runs;
  }
  record.lag1.test.value = MakeTest<RTestRecord>(tests.lag1);
  if (tests.lag1.ok()) record.lag1.expected = tests.expected_lag1;
  record.durbin_watson = MakeTest<DTestRecord>(tests.durbin_watson);
  record.ljung_box.test.value = MakeTest<QTestRecord>(tests.ljung_box);
  if (tests.ljung_box.ok()) record.ljung_box.lags = tests.num_lags;
  if (shuffles.draws > 0) record.shuffled = shuffles;
  return record;
}

BiasRecord BiasOf(const NamedBias& named) {
  BiasRecord record{.test = {MakeTest<FTestRecord>(named.bias.anova)},
                    .column = named.column,
                    .explained = named.bias.explained};
  for (std::size_t i = 0; i < named.bias.levels.size(); ++i) {
    const stats::LevelBias& level = named.bias.levels[i];
    if (level.n == 0) continue;
    record.levels.push_back({.level = named.labels[i],
                             .n = level.n,
                             .mean = level.mean,
                             .standard_error = level.standard_error});
  }
  return record;
}

}  // namespace

NormalityRecord MakeRecord(const stats::Normality& normality,
                           const stats::MonteCarloP& monte_carlo) {
  NormalityRecord record;
  record.ks.d = normality.ks.statistic;
  record.ks.p_given = normality.ks.p;
  if (!normality.ks.ok()) record.ks.why = normality.ks.why_not;
  record.ks.p_given_exact = normality.ks_exact.p;
  record.lilliefors = MakeTest<DTestRecord>(normality.lilliefors);
  record.shapiro_wilk = MakeTest<WTestRecord>(normality.shapiro_wilk);
  record.anderson_darling = MakeTest<A2TestRecord>(normality.anderson_darling);
  record.jarque_bera = MakeTest<JbTestRecord>(normality.jarque_bera);
  record.dagostino_pearson =
      MakeTest<K2TestRecord>(normality.dagostino_pearson);
  record.ppcc = PpccOf(normality);
  record.dip = MakeTest<DipTestRecord>(normality.dip);
  record.skewness = normality.shape.skewness;
  record.kurtosis = normality.shape.kurtosis;
  if (normality.step > 0.0) record.step = normality.step;
  if (monte_carlo.draws > 0) record.monte_carlo = monte_carlo;
  return record;
}

RandomnessRecord MakeRecord(const ResidualReport& report) {
  RandomnessRecord record;
  record.order = report.order;
  record.in_order = SerialOf(report.whole, report.whole_shuffles);
  if (report.within) {
    record.within_groups = SerialOf(*report.within, report.within_shuffles);
  }
  record.halves = MakeTest<DTestRecord>(report.halves);
  if (report.by_group) record.by_group = BiasOf(*report.by_group);
  if (report.by_position) record.by_position = BiasOf(*report.by_position);
  if (report.breusch_pagan) {
    record.breusch_pagan =
        SpreadRecord{.test = {MakeTest<LmTestRecord>(*report.breusch_pagan)},
                     .column = report.fitted_column};
  }
  return record;
}

VectorXd HeldOutPredictions(const Holdout& holdout,
                            const HoldoutResult& result,
                            Index num_rows) {
  VectorXd predicted = VectorXd::Constant(num_rows, kNotKnown);
  for (std::size_t fold = 0; fold < result.folds.size(); ++fold) {
    const VectorXd& values = result.folds[fold].test_predictions;
    for (Index i = 0; i < values.size(); ++i) {
      const Index row = holdout.folds[fold].test[static_cast<std::size_t>(i)];
      if (std::isnan(predicted[row])) predicted[row] = values[i];
    }
  }
  return predicted;
}

ResidualInputs HeldOutResiduals(const ComponentStudy& comparison,
                                std::size_t model,
                                std::size_t holdout_index) {
  const Holdout& holdout = comparison.holdouts[holdout_index];
  const data::Dataset& source = holdout.Source(comparison.data.dataset);
  const VectorXd predicted =
      HeldOutPredictions(holdout,
                         comparison.study.models[model].holdouts[holdout_index],
                         source.num_rows());
  std::vector<Index> rows;
  for (Index row = 0; row < predicted.size(); ++row) {
    if (!std::isnan(predicted[row])) rows.push_back(row);
  }
  ResidualInputs inputs;
  inputs.fitted = predicted(rows);
  inputs.values = source.target_values()(rows) - inputs.fitted;
  inputs.fitted_column = "predicted";
  if (source.has_groups()) {
    inputs.group_column = source.groups().column;
    inputs.group_labels = source.groups().labels;
    for (const Index row : rows) {
      inputs.group_codes.push_back(
          source.groups().codes[static_cast<std::size_t>(row)]);
    }
  }
  if (const Index position = FindPosition(source, ""); position >= 0) {
    inputs.position_column =
        source.inputs()[static_cast<std::size_t>(position)].name;
    inputs.positions = source.input_values().col(position)(rows);
  }
  return inputs;
}

}  // namespace errmap::models
