#include "models/study.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace errmap::models {
namespace {

using data::Dataset;
using Eigen::Index;
using Eigen::VectorXd;
using Clock = std::chrono::steady_clock;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

FitOutcome FitOnce(const ModelRecipe& recipe,
                   const Dataset& training,
                   const Dataset* test,
                   const StudyOptions& options,
                   InnerHoldout inner) {
  FitOutcome outcome;
  if (options.stop != nullptr && options.stop->load()) {
    outcome.why_failed = "interrupted before it began";
    return outcome;
  }
  const auto start = Clock::now();
  try {
    FittedModel fitted = recipe.Fit(
        training,
        {.seed = options.seed, .stop = options.stop, .inner_holdout = inner});
    outcome.seconds = SecondsSince(start);
    if (fitted.summary.termination == fitting::Termination::kFailed) {
      outcome.why_failed = fitted.summary.message;
      return outcome;
    }
    outcome.train_predictions = fitted.Predict(training);
    if (test != nullptr) outcome.test_predictions = fitted.Predict(*test);
    if (!outcome.train_predictions.allFinite() ||
        !outcome.test_predictions.allFinite()) {
      outcome.why_failed = "a prediction is not finite";
      return outcome;
    }
    outcome.fitted = std::move(fitted);
  } catch (const std::bad_alloc&) {
    outcome.why_failed = "not enough memory";
  } catch (const std::exception& error) {
    outcome.why_failed = error.what();
  }
  return outcome;
}

// Training and test rows of every fold, made once and shared by all models.
struct PreparedFold {
  Dataset training;
  std::shared_ptr<const Dataset> test;
};

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

// Pools the folds of one model under one hold-out.
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
    train.push_back(Judge(fold.training, outcome.train_predictions));
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

// Nanoseconds per prediction by the shortest of several runs: what else the
// machine does can only make one longer.
double MeasurePrediction(const FittedModel& fitted, const Dataset& dataset) {
  constexpr double kEnoughSeconds = 2e-3;
  constexpr int kMostRuns = 1000;
  const auto start = Clock::now();
  double shortest = std::numeric_limits<double>::infinity();
  double sink = 0.0;
  for (int run = 0; run < kMostRuns && SecondsSince(start) < kEnoughSeconds;
       ++run) {
    const auto begin = Clock::now();
    sink += fitted.Predict(dataset)[0];
    shortest = std::min(shortest, SecondsSince(begin));
  }
  if (std::isnan(sink)) return kNaN;  // keeps the loop from being removed
  return 1e9 * shortest / static_cast<double>(dataset.num_rows());
}

// Of rows where rows are held out, so that every fold tunes for what it is
// judged by; a test file says nothing, so groups stay whole.
InnerHoldout InnerHoldoutLike(stats::HoldoutKind kind) {
  switch (kind) {
    case stats::HoldoutKind::kEvery:
    case stats::HoldoutKind::kKFold:
    case stats::HoldoutKind::kRandom:
      return InnerHoldout::kRows;
    case stats::HoldoutKind::kForward:
      return InnerHoldout::kForward;
    case stats::HoldoutKind::kGroups:
    case stats::HoldoutKind::kLeaveOneGroupOut:
    case stats::HoldoutKind::kFile:
      break;
  }
  return InnerHoldout::kWholeGroups;
}

}  // namespace

bool ModelResult::ok() const { return why().empty(); }

std::string ModelResult::why() const {
  for (const HoldoutResult& holdout : holdouts) {
    if (!holdout.ok()) return holdout.holdout + ": " + holdout.why_failed;
  }
  return final_fit ? "" : "all rows: " + final_why_failed;
}

Holdout MakeHoldout(const stats::HoldoutSpec& spec,
                    const Dataset& dataset,
                    std::uint64_t seed,
                    std::shared_ptr<const Dataset> test_data) {
  if ((spec.kind == stats::HoldoutKind::kFile) != (test_data != nullptr)) {
    throw std::invalid_argument("MakeHoldout: test data belong to file: only");
  }
  const bool by_group = spec.kind == stats::HoldoutKind::kGroups ||
                        spec.kind == stats::HoldoutKind::kLeaveOneGroupOut ||
                        spec.kind == stats::HoldoutKind::kForward;
  return {
      spec.text,
      by_group && dataset.has_groups(),
      stats::MakeFolds(spec, dataset.num_rows(), dataset.groups().codes, seed),
      std::move(test_data),
      InnerHoldoutLike(spec.kind)};
}

stats::ErrorMetrics Judge(const Dataset& dataset, const VectorXd& predicted) {
  const VectorXd& targets = dataset.target_values();
  return stats::ComputeErrorMetrics(
      targets,
      targets - predicted,
      VectorXd::Constant(targets.size(), stats::Summarize(targets).mean));
}

StudyResult RunStudy(const Dataset& dataset,
                     const std::vector<Holdout>& holdouts,
                     const std::vector<std::unique_ptr<ModelRecipe>>& recipes,
                     const StudyOptions& options) {
  if (recipes.empty() || holdouts.empty() || options.jobs < 1) {
    throw std::invalid_argument(
        "RunStudy: needs at least one model, one hold-out and one job");
  }
  const auto prepared = PrepareFolds(dataset, holdouts);

  // Nets last: whoever interrupts a long run has the quick fits.
  std::vector<StudyTask> tasks;
  for (const bool nets : {false, true}) {
    for (std::size_t model = 0; model < recipes.size(); ++model) {
      if ((recipes[model]->kind() == ModelKind::kNet) != nets) continue;
      tasks.push_back({model, -1, 0});
      for (std::size_t h = 0; h < holdouts.size(); ++h) {
        for (std::size_t fold = 0; fold < prepared[h].size(); ++fold) {
          tasks.push_back({model, static_cast<std::ptrdiff_t>(h), fold});
        }
      }
    }
  }
  std::vector<FitOutcome> final_outcomes(recipes.size());
  std::vector<std::vector<std::vector<FitOutcome>>> outcomes(recipes.size());
  for (auto& of_model : outcomes) {
    for (const auto& folds : prepared) of_model.emplace_back(folds.size());
  }
  const auto fit = [&](const StudyTask& task) {
    const ModelRecipe& recipe = *recipes[task.model];
    if (task.holdout < 0) {
      return FitOnce(
          recipe, dataset, nullptr, options, InnerHoldout::kWholeGroups);
    }
    const auto h = static_cast<std::size_t>(task.holdout);
    const PreparedFold& fold = prepared[h][task.fold];
    return FitOnce(
        recipe, fold.training, fold.test.get(), options, holdouts[h].inner);
  };
  const auto find_or_fit = [&](const StudyTask& task) {
    if (options.journal == nullptr) return fit(task);
    if (auto found = options.journal->Find(task)) return std::move(*found);
    FitOutcome outcome = fit(task);
    const bool stopped = options.stop != nullptr && options.stop->load();
    if (!stopped) options.journal->Record(task, outcome);
    return outcome;
  };
  std::atomic<int> done{0};
  const auto run = [&](std::size_t index) {
    const StudyTask& task = tasks[index];
    FitOutcome& outcome =
        task.holdout < 0
            ? final_outcomes[task.model]
            : outcomes[task.model][static_cast<std::size_t>(task.holdout)]
                      [task.fold];
    outcome = find_or_fit(task);
    const int now_done = ++done;
    if (options.progress) {
      options.progress(now_done, static_cast<int>(tasks.size()));
    }
  };
  // Each worker takes the next task, so that they start in the order above.
  std::atomic<std::size_t> next{0};
  const oneapi::tbb::global_control allow_jobs(
      oneapi::tbb::global_control::max_allowed_parallelism,
      static_cast<std::size_t>(options.jobs));
  oneapi::tbb::task_arena arena(options.jobs);
  arena.execute([&] {
    oneapi::tbb::parallel_for(0, options.jobs, [&](int /*worker*/) {
      for (std::size_t i = next++; i < tasks.size(); i = next++) run(i);
    });
  });

  StudyResult result;
  for (std::size_t model = 0; model < recipes.size(); ++model) {
    ModelResult judged;
    judged.name = recipes[model]->name();
    judged.kind = recipes[model]->kind();
    judged.options = recipes[model]->options();
    for (std::size_t h = 0; h < holdouts.size(); ++h) {
      judged.holdouts.push_back(
          PoolFolds(holdouts[h], prepared[h], std::move(outcomes[model][h])));
    }
    judged.final_fit = std::move(final_outcomes[model].fitted);
    judged.final_why_failed = final_outcomes[model].why_failed;
    judged.final_fit_seconds = final_outcomes[model].seconds;
    judged.predict_ns =
        judged.final_fit ? MeasurePrediction(*judged.final_fit, dataset) : kNaN;
    result.models.push_back(std::move(judged));
  }
  result.interrupted = options.stop != nullptr && options.stop->load();
  return result;
}

}  // namespace errmap::models
