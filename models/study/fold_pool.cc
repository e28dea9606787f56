#include "models/study/fold_pool.h"

#include <limits>
#include <utility>

#include <fmt/format.h>

namespace errmap::models {
namespace {

using data::Dataset;
using Eigen::Index;
using Eigen::VectorXd;

stats::SampleSummary MeanOf(const std::vector<stats::ErrorMetrics>& folds) {
  const double count = static_cast<double>(folds.size());
  stats::SampleSummary mean;
  Index n = 0;
  for (const auto& fold : folds) {
    n += fold.residuals.n;
    mean.mean += fold.residuals.mean / count;
    mean.sd += fold.residuals.sd / count;
    mean.min += fold.residuals.min / count;
    mean.max += fold.residuals.max / count;
    mean.range += fold.residuals.range / count;
  }
  mean.n = n / static_cast<Index>(folds.size());
  return mean;
}

stats::ErrorMetrics AverageMetrics(
    const std::vector<stats::ErrorMetrics>& folds) {
  const double count = static_cast<double>(folds.size());
  stats::ErrorMetrics average;
  average.residuals = MeanOf(folds);
  for (const auto& fold : folds) {
    average.rmse += fold.rmse / count;
    average.mae += fold.mae / count;
    average.r2 += fold.r2 / count;
  }
  return average;
}

// Predictions from elsewhere may not cover the training rows.
stats::ErrorMetrics JudgeTraining(const Dataset& training,
                                  const VectorXd& predicted) {
  if (predicted.size() > 0) return Judge(training, predicted);
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  stats::ErrorMetrics unknown;
  unknown.residuals.n = training.num_rows();
  for (double* figure : {&unknown.rmse,
                         &unknown.mae,
                         &unknown.r2,
                         &unknown.residuals.mean,
                         &unknown.residuals.sd,
                         &unknown.residuals.min,
                         &unknown.residuals.max,
                         &unknown.residuals.range}) {
    *figure = kNaN;
  }
  return unknown;
}

}  // namespace

std::vector<std::vector<PreparedFold>> PrepareFolds(
    const Dataset& dataset, const std::vector<Holdout>& holdouts) {
  std::vector<std::vector<PreparedFold>> prepared;
  for (const Holdout& holdout : holdouts) {
    auto& folds = prepared.emplace_back();
    for (const stats::Fold& fold : holdout.folds) {
      auto test =
          holdout.test_data != nullptr
              ? holdout.test_data
              : std::make_shared<const Dataset>(dataset.SelectRows(fold.test));
      folds.push_back({dataset.SelectRows(fold.train), std::move(test)});
    }
  }
  return prepared;
}

HoldoutResult PoolFolds(const Holdout& holdout,
                        const std::vector<PreparedFold>& prepared,
                        std::vector<FitOutcome> outcomes) {
  HoldoutResult result;
  result.holdout = holdout.name;
  for (std::size_t fold = 0; fold < outcomes.size(); ++fold) {
    if (outcomes[fold].fitted) continue;
    result.why_failed =
        outcomes.size() == 1
            ? outcomes[fold].why_failed
            : fmt::format("fold {}: {}", fold, outcomes[fold].why_failed);
    return result;
  }
  Index num_test = 0;
  for (const PreparedFold& fold : prepared) num_test += fold.test->num_rows();
  VectorXd targets(num_test);
  VectorXd residuals(num_test);
  VectorXd baseline(num_test);
  std::vector<stats::ErrorMetrics> train;
  Index begin = 0;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const PreparedFold& fold = prepared[i];
    FitOutcome& outcome = outcomes[i];
    train.push_back(JudgeTraining(fold.training, outcome.train_predictions));
    const VectorXd& test_targets = fold.test->target_values();
    const Index size = test_targets.size();
    targets.segment(begin, size) = test_targets;
    residuals.segment(begin, size) = test_targets - outcome.test_predictions;
    baseline.segment(begin, size)
        .setConstant(stats::Summarize(fold.training.target_values()).mean);
    FoldResult folded;
    folded.train_rmse = train.back().rmse;
    folded.test_rmse = stats::RootMeanSquare(residuals.segment(begin, size));
    folded.summary = std::move(outcome.fitted->summary);
    folded.fit_seconds = outcome.seconds;
    folded.remarks = std::move(outcome.fitted->remarks);
    folded.choices = std::move(outcome.fitted->choices);
    folded.starts = std::move(outcome.fitted->starts);
    folded.test_predictions = std::move(outcome.test_predictions);
    result.folds.push_back(std::move(folded));
    begin += size;
  }
  result.train = AverageMetrics(train);
  result.test = stats::ComputeErrorMetrics(targets, residuals, baseline);
  return result;
}

stats::ErrorMetrics Judge(const Dataset& dataset, const VectorXd& predicted) {
  const VectorXd& targets = dataset.target_values();
  return stats::ComputeErrorMetrics(
      targets,
      targets - predicted,
      VectorXd::Constant(targets.size(), stats::Summarize(targets).mean));
}

}  // namespace errmap::models
