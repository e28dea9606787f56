#include "models/study/fold_pool.h"

#include <utility>

#include <fmt/format.h>

#include "stats/summary.h"

namespace errmap::models {
namespace {

using data::Dataset;
stats::ErrorMetrics AverageMetrics(
    const std::vector<stats::ErrorMetrics>& folds) {
  using Metrics = stats::ErrorMetrics;
  const double count = static_cast<double>(folds.size());
  Metrics average;
  for (const Metrics& fold : folds) average.n += fold.n;
  average.n /= std::ssize(folds);
  for (double Metrics::*const figure : {&Metrics::mean,
                                        &Metrics::sd,
                                        &Metrics::rmse,
                                        &Metrics::mae,
                                        &Metrics::min,
                                        &Metrics::max,
                                        &Metrics::range,
                                        &Metrics::r2}) {
    average.*figure = 0.0;
    for (const Metrics& fold : folds) average.*figure += fold.*figure / count;
  }
  return average;
}

stats::ErrorMetrics JudgeTargets(const VectorXd& targets,
                                 const VectorXd& predicted) {
  return stats::ComputeErrorMetrics(
      targets,
      targets - predicted,
      VectorXd::Constant(targets.size(), stats::Summarize(targets).mean));
}

// Predictions from elsewhere may not cover the training rows.
stats::ErrorMetrics JudgeTraining(const VectorXd& targets,
                                  const VectorXd& predicted) {
  return predicted.size() > 0 ? JudgeTargets(targets, predicted)
                              : stats::ErrorMetrics{.n = targets.size()};
}

}  // namespace

PreparedFold PrepareFold(const Dataset& dataset,
                         const Holdout& holdout,
                         std::size_t fold) {
  const stats::Fold& rows = holdout.folds[fold];
  return {dataset.SelectRows(rows.train),
          std::make_shared<const Dataset>(
              holdout.Source(dataset).SelectRows(rows.test))};
}

FoldOutcome JudgeFold(const Dataset& dataset,
                      const Holdout& holdout,
                      std::size_t fold,
                      FitOutcome outcome) {
  FoldOutcome judged;
  judged.train =
      JudgeTraining(dataset.target_values()(holdout.folds[fold].train),
                    outcome.train_predictions);
  judged.fit = std::move(outcome);
  judged.fit.train_predictions.resize(0);
  return judged;
}

void PoolTest(const Dataset& dataset,
              const Holdout& holdout,
              HoldoutResult* result) {
  Index num_test = 0;
  for (const FoldResult& fold : result->folds) {
    num_test += fold.test_predictions.size();
  }
  VectorXd targets(num_test);
  VectorXd residuals(num_test);
  VectorXd baseline(num_test);
  Index begin = 0;
  for (std::size_t i = 0; i < result->folds.size(); ++i) {
    const stats::Fold& rows = holdout.folds[i];
    FoldResult& fold = result->folds[i];
    const Index size = fold.test_predictions.size();
    targets.segment(begin, size) =
        holdout.Source(dataset).target_values()(rows.test);
    residuals.segment(begin, size) =
        targets.segment(begin, size) - fold.test_predictions;
    const VectorXd trained = dataset.target_values()(rows.train);
    baseline.segment(begin, size).setConstant(stats::Summarize(trained).mean);
    fold.test_rmse = stats::RootMeanSquare(residuals.segment(begin, size));
    begin += size;
  }
  result->test = stats::ComputeErrorMetrics(targets, residuals, baseline);
}

HoldoutResult PoolFolds(const Dataset& dataset,
                        const Holdout& holdout,
                        std::vector<FoldOutcome> outcomes) {
  HoldoutResult result;
  result.holdout = holdout.name;
  for (std::size_t fold = 0; fold < outcomes.size(); ++fold) {
    const FitOutcome& fit = outcomes[fold].fit;
    if (fit.fitted) continue;
    result.why_failed = outcomes.size() == 1
                            ? fit.why_failed
                            : fmt::format("fold {}: {}", fold, fit.why_failed);
    return result;
  }
  std::vector<stats::ErrorMetrics> train;
  for (FoldOutcome& judged : outcomes) {
    FitOutcome& outcome = judged.fit;
    train.push_back(judged.train);
    FoldResult folded;
    folded.train_rmse = train.back().rmse;
    folded.summary = std::move(outcome.fitted->summary);
    folded.fit_seconds = outcome.seconds;
    folded.remarks = std::move(outcome.fitted->remarks);
    folded.choices = std::move(outcome.fitted->choices);
    folded.starts = std::move(outcome.fitted->starts);
    folded.test_predictions = std::move(outcome.test_predictions);
    // Predictions made elsewhere have none.
    if (outcome.fitted->model != nullptr) {
      folded.map =
          std::make_shared<const FittedModel>(std::move(*outcome.fitted));
    }
    result.folds.push_back(std::move(folded));
  }
  result.train = AverageMetrics(train);
  PoolTest(dataset, holdout, &result);
  if (!(result.test.rmse <= kLargestRmse)) {
    result.folds.clear();
    result.why_failed = fmt::format(
        "its RMSE of {:.3g} is too large to be squared", result.test.rmse);
  }
  return result;
}

stats::ErrorMetrics Judge(const Dataset& dataset, const VectorXd& predicted) {
  return JudgeTargets(dataset.target_values(), predicted);
}

}  // namespace errmap::models
