#include "models/study/study.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "data/argument_name.h"
#include "fitting/interruption.h"
#include "fitting/parallel_for.h"
#include "models/recipe_catalog.h"
#include "models/shared_work.h"
#include "models/study/fold_pool.h"
#include "models/study/repeated_rows.h"
#include "stats/indices.h"

namespace errmap::models {
namespace {

using data::Dataset;
using Clock = std::chrono::steady_clock;

constexpr const char* kNotBegun = "interrupted before it began";
constexpr const char* kNoMemory = "not enough memory";  // may be there later

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

FitOutcome FitOnce(const ModelRecipe& recipe,
                   const Dataset& training,
                   const Dataset* test,
                   const FitContext& context) {
  FitOutcome outcome;
  if (fitting::IsInterrupted()) {
    outcome.why_failed = kNotBegun;
    return outcome;
  }
  const auto start = Clock::now();
  try {
    FittedModel fitted = recipe.Fit(training, context);
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
    outcome.why_failed = kNoMemory;
    outcome.try_again = true;
  } catch (const std::exception& error) {
    outcome.why_failed = error.what();
  }
  return outcome;
}

// The fit to all rows is the one to use, so it is the one to explain: a
// regression's tables, a net's error-reduction curve and what it knows by
// heart.
FitOutcome FitAllRows(const ModelRecipe& recipe,
                      const Dataset& dataset,
                      FitContext context) {
  const bool is_net = recipe.kind() == ModelKind::kNet;
  context.explain = !is_net;
  context.default_bootstraps = false;  // seconds, where fits take milliseconds
  context.keep_trace = is_net;
  FitOutcome outcome = FitOnce(recipe, dataset, nullptr, context);
  if (is_net && outcome.fitted) {
    outcome.memorisation =
        FitShuffledTargets(recipe, dataset, *outcome.fitted, context);
    outcome.try_again = outcome.memorisation->why_not == kNoMemory;
  }
  return outcome;
}

// Nanoseconds per prediction, from the shortest of several runs: other work of
// the computer only makes a run longer.
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
  // Keeps the loop from being removed.
  if (std::isnan(sink)) return stats::kNaN;
  return 1e9 * shortest / static_cast<double>(dataset.num_rows());
}

// Rows if rows are held out, so that every fold tunes for what judges it. A
// test file says nothing, so it uses the decisive kind.
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
      return InnerHoldout::kWholeGroups;
    case stats::HoldoutKind::kSessions:
      return InnerHoldout::kWholeSessions;
    case stats::HoldoutKind::kBlocks:
      return InnerHoldout::kBlocks;
    case stats::HoldoutKind::kFile:
      break;
  }
  return InnerHoldout::kDecisive;
}

// MakeFolds knows codes, and not which column they may come from.
void RequireUnits(const stats::HoldoutSpec& spec,
                  const Dataset& dataset,
                  const std::vector<Index>& sessions) {
  const auto refuse = [&](const std::string& why) {
    throw std::invalid_argument(
        fmt::format("hold-out '{}': {}", spec.text, why));
  };
  const bool of_groups = spec.kind == stats::HoldoutKind::kGroups ||
                         spec.kind == stats::HoldoutKind::kLeaveOneGroupOut;
  if (of_groups && !dataset.has_groups()) {
    refuse(
        fmt::format("there are no groups; name a column with {}, or hold "
                    "out rows (every:3, kfold:5)",
                    data::ArgumentName("group")));
  }
  if (spec.kind == stats::HoldoutKind::kSessions && sessions.empty()) {
    refuse(
        fmt::format("needs at least {} sessions, found 0; name their column "
                    "with {}, or hold out rows (blocks:5)",
                    spec.k,
                    data::ArgumentName("session")));
  }
}

// What a model achieved: `outcomes` by hold-out and fold, and its fit to all
// rows.
ModelResult PoolModel(const ModelRecipe& recipe,
                      const Dataset& dataset,
                      const std::vector<Holdout>& holdouts,
                      std::vector<std::vector<FoldOutcome>> outcomes,
                      FitOutcome final_outcome) {
  ModelResult judged;
  judged.name = recipe.name();
  judged.kind = recipe.kind();
  judged.baseline = IsBaseline(judged.name);
  judged.options = recipe.options();
  for (std::size_t h = 0; h < holdouts.size(); ++h) {
    judged.holdouts.push_back(
        PoolFolds(dataset, holdouts[h], std::move(outcomes[h])));
  }
  judged.final_fit = std::move(final_outcome.fitted);
  judged.final_why_failed = std::move(final_outcome.why_failed);
  judged.memorisation = final_outcome.memorisation;
  judged.final_fit_seconds = final_outcome.seconds;
  judged.predict_ns = judged.final_fit
                          ? MeasurePrediction(*judged.final_fit, dataset)
                          : stats::kNaN;
  return judged;
}

// The fits of a study, side by side, and what becomes of them.
class StudyRun {
 public:
  StudyRun(const Dataset& dataset,
           const std::vector<Holdout>& holdouts,
           const std::vector<std::unique_ptr<ModelRecipe>>& recipes,
           const StudyOptions& options)
      : dataset_(dataset),
        holdouts_(holdouts),
        recipes_(recipes),
        options_(options),
        tasks_(StudyTasks(holdouts, recipes)),
        final_outcomes_(recipes.size()),
        outcomes_(recipes.size()) {
    if (!options.fit_all_rows) {
      std::erase_if(tasks_, [](const StudyTask& t) { return t.holdout < 0; });
    }
    for (auto& of_model : outcomes_) {
      for (const Holdout& holdout : holdouts) {
        of_model.emplace_back(holdout.folds.size());
      }
    }
    of_all_rows_.every_penalty = std::ranges::any_of(
        recipes,
        [](const auto& recipe) { return recipe->kind() == ModelKind::kBlend; });
    for (const StudyTask& task : tasks_) {
      if (task.holdout < 0) continue;
      of_folds_[{task.holdout, task.fold}].every_penalty =
          of_all_rows_.every_penalty;
    }
  }

  StudyResult Run() {
    fitting::ParallelFor(options_.jobs, tasks_.size(), [&](std::size_t i) {
      RunTask(tasks_[i]);
    });
    StudyResult result;
    for (std::size_t model = 0; model < recipes_.size(); ++model) {
      result.models.push_back(PoolModel(*recipes_[model],
                                        dataset_,
                                        holdouts_,
                                        std::move(outcomes_[model]),
                                        std::move(final_outcomes_[model])));
    }
    result.interrupted = is_stopped();
    result.short_of_memory = short_of_memory_;
    return result;
  }

 private:
  bool is_stopped() const {
    return options_.stop != nullptr && options_.stop->load();
  }

  const Holdout& HoldoutOf(const StudyTask& task) const {
    return holdouts_[static_cast<std::size_t>(task.holdout)];
  }

  void RunTask(const StudyTask& task) {
    FitProgress progress{.all = static_cast<int>(tasks_.size()), .task = task};
    const auto start = Clock::now();
    FitOutcome outcome = FindOrFit(task);
    if (outcome.try_again) ++short_of_memory_;
    // What an earlier run has found took its time there.
    progress.seconds = std::max(outcome.seconds, SecondsSince(start));
    if (task.holdout < 0) {
      final_outcomes_[task.model] = std::move(outcome);
    } else {
      outcomes_[task.model][static_cast<std::size_t>(task.holdout)][task.fold] =
          JudgeFold(dataset_, HoldoutOf(task), task.fold, std::move(outcome));
      if (options_.progress) progress.holdout_rmse = RmseAfter(task);
    }
    progress.done = ++done_;
    if (options_.progress) options_.progress(progress);
  }

  FitOutcome FindOrFit(const StudyTask& task) {
    if (options_.journal == nullptr) return Fit(task);
    if (auto found = options_.journal->Find(task)) return std::move(*found);
    FitOutcome outcome = Fit(task);
    if (!is_stopped() && !outcome.try_again) {
      options_.journal->Record(task, outcome);
    }
    return outcome;
  }

  FitOutcome Fit(const StudyTask& task) {
    const fitting::InterruptionScope interruptible(options_.stop);
    const ModelRecipe& recipe = *recipes_[task.model];
    FitContext context = ContextOfTask(task, holdouts_, options_);
    if (task.holdout < 0) {
      context.shared = &of_all_rows_;
      return FitAllRows(recipe, dataset_, context);
    }
    context.shared = &of_folds_.at({task.holdout, task.fold});
    if (fitting::IsInterrupted()) {
      FitOutcome outcome;
      outcome.why_failed = kNotBegun;
      return outcome;
    }
    const PreparedFold fold = PrepareFold(dataset_, HoldoutOf(task), task.fold);
    return FitOnce(recipe, fold.training, fold.test.get(), context);
  }

  // RMSE of the task's model if this was the last fold to end, else NaN.
  double RmseAfter(const StudyTask& task) {
    const Holdout& holdout = HoldoutOf(task);
    const std::lock_guard lock(ended_mutex_);
    if (++ended_[{task.model, task.holdout}] < holdout.folds.size()) {
      return stats::kNaN;
    }
    double squares = 0.0;
    double rows = 0.0;
    for (std::size_t fold = 0; fold < holdout.folds.size(); ++fold) {
      const std::vector<Index>& test = holdout.folds[fold].test;
      const FitOutcome& fit =
          outcomes_[task.model][static_cast<std::size_t>(task.holdout)][fold]
              .fit;
      if (fit.test_predictions.size() != std::ssize(test)) return stats::kNaN;
      squares += (holdout.Source(dataset_).target_values()(test) -
                  fit.test_predictions)
                     .squaredNorm();
      rows += static_cast<double>(test.size());
    }
    return std::sqrt(squares / rows);
  }

  const Dataset& dataset_;
  const std::vector<Holdout>& holdouts_;
  const std::vector<std::unique_ptr<ModelRecipe>>& recipes_;
  const StudyOptions& options_;
  std::vector<StudyTask> tasks_;
  std::vector<FitOutcome> final_outcomes_;  // (models)
  // (models, hold-outs, folds)
  std::vector<std::vector<std::vector<FoldOutcome>>> outcomes_;
  // What the recipes share of the same rows: all rows, then fold by fold.
  SharedWork of_all_rows_;
  std::map<std::pair<std::ptrdiff_t, std::size_t>, SharedWork> of_folds_;
  std::mutex ended_mutex_;
  // Folds by model and hold-out.
  std::map<std::pair<std::size_t, std::ptrdiff_t>, std::size_t> ended_;
  std::atomic<int> done_{0};
  std::atomic<int> short_of_memory_{0};
};

}  // namespace

bool ModelResult::ok() const { return why().empty(); }

std::string ModelResult::why() const {
  for (const HoldoutResult& holdout : holdouts) {
    if (!holdout.ok()) return holdout.holdout + ": " + holdout.why_failed;
  }
  return final_why_failed.empty() ? "" : "all rows: " + final_why_failed;
}

bool IsOfSessions(const Holdout& holdout, const Dataset& dataset) {
  const bool groups_are_coarser =
      holdout.whole_groups &&
      std::ssize(dataset.groups().labels) < dataset.num_sessions();
  return holdout.whole_sessions && !groups_are_coarser;
}

Holdout MakeHoldout(const stats::HoldoutSpec& spec,
                    const Dataset& dataset,
                    std::uint64_t seed,
                    std::shared_ptr<const Dataset> test_data) {
  if ((spec.kind == stats::HoldoutKind::kFile) != (test_data != nullptr)) {
    throw std::invalid_argument("MakeHoldout: test data belong to file: only");
  }
  const bool forward = spec.kind == stats::HoldoutKind::kForward;
  // Days follow each other as their cycles do, and are what is to be foreseen.
  const bool by_session = spec.kind == stats::HoldoutKind::kSessions ||
                          (forward && dataset.num_sessions() > spec.k);
  const bool by_group = spec.kind == stats::HoldoutKind::kGroups ||
                        spec.kind == stats::HoldoutKind::kLeaveOneGroupOut ||
                        (forward && !by_session);
  Holdout holdout;
  holdout.name = spec.text;
  holdout.among_neighbours = spec.kind == stats::HoldoutKind::kEvery ||
                             spec.kind == stats::HoldoutKind::kKFold ||
                             spec.kind == stats::HoldoutKind::kRandom;
  holdout.forward = forward;
  holdout.repeats = std::max<Index>(1, spec.repeats);
  const std::vector<Index> sessions = dataset.session_codes();
  RequireUnits(spec, dataset, sessions);
  holdout.folds =
      stats::MakeFolds(spec,
                       dataset.num_rows(),
                       by_session ? sessions : dataset.groups().codes,
                       seed);
  holdout.whole_groups =
      dataset.has_groups() &&
      (by_group ||
       (forward && stats::KeepsWhole(holdout.folds, dataset.groups().codes)));
  holdout.whole_sessions = test_data == nullptr && dataset.has_sessions() &&
                           stats::KeepsWhole(holdout.folds, sessions);
  if (test_data != nullptr) {
    holdout.rows_of_training = CountRowsOf(dataset, *test_data);
    holdout.among_neighbours = holdout.rows_of_training > 0;
    holdout.folds.front().test = stats::AllIndices(test_data->num_rows());
  }
  holdout.test_data = std::move(test_data);
  // What was measured before is chosen from as all of it will be; a cut of
  // groups that is one of sessions chooses, and finds, what that would.
  holdout.inner = forward && by_session ? InnerHoldout::kDecisive
                  : !forward && IsOfSessions(holdout, dataset)
                      ? InnerHoldout::kWholeSessions
                      : InnerHoldoutLike(spec.kind);
  return holdout;
}

void ForgetFoldMaps(StudyResult* study) {
  for (ModelResult& model : study->models) {
    for (HoldoutResult& holdout : model.holdouts) {
      for (FoldResult& fold : holdout.folds) fold.map.reset();
    }
  }
}

std::vector<StudyTask> StudyTasks(
    const std::vector<Holdout>& holdouts,
    const std::vector<std::unique_ptr<ModelRecipe>>& recipes) {
  std::vector<StudyTask> tasks;
  for (const bool nets : {false, true}) {
    for (std::size_t model = 0; model < recipes.size(); ++model) {
      const ModelKind kind = recipes[model]->kind();
      if ((kind == ModelKind::kNet || kind == ModelKind::kBlend) != nets) {
        continue;
      }
      tasks.push_back({model, -1, 0});
      for (std::size_t h = 0; h < holdouts.size(); ++h) {
        for (std::size_t fold = 0; fold < holdouts[h].folds.size(); ++fold) {
          tasks.push_back({model, static_cast<std::ptrdiff_t>(h), fold});
        }
      }
    }
  }
  return tasks;
}

FitContext ContextOfTask(const StudyTask& task,
                         const std::vector<Holdout>& holdouts,
                         const StudyOptions& options) {
  FitContext context{.seed = options.seed,
                     .indifference = options.indifference};
  if (task.holdout >= 0) {
    context.inner_holdout =
        holdouts[static_cast<std::size_t>(task.holdout)].inner;
  }
  return context;
}

StudyResult RunStudy(const Dataset& dataset,
                     const std::vector<Holdout>& holdouts,
                     const std::vector<std::unique_ptr<ModelRecipe>>& recipes,
                     const StudyOptions& options) {
  if (recipes.empty() || holdouts.empty() || options.jobs < 1) {
    throw std::invalid_argument(
        "RunStudy: needs at least one model, one hold-out and one job");
  }
  return StudyRun(dataset, holdouts, recipes, options).Run();
}

}  // namespace errmap::models
