#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/study/fit_outcome.h"
#include "stats/error_metrics.h"
#include "stats/holdout.h"
#include "stats/not_a_number.h"

namespace errmap::models {

/// A way of holding out rows, ready for one data set.
struct Holdout {
  std::string name;             // its SPEC
  bool whole_groups = false;    // no group is on both sides of a fold
  bool whole_sessions = false;  // likewise for at least two sessions
  /// True if training rows lie around the test rows: interpolation.
  bool among_neighbours = false;
  bool forward = false;  // earlier rows predict later ones
  Index repeats = 1;     // different splits of the same rows, in order
  /// Training rows are indices into the data set, test rows into Source.
  std::vector<stats::Fold> folds;
  /// file:TEST.csv, or null.
  std::shared_ptr<const data::Dataset> test_data;
  /// Number of rows of that file that the data set also contains. The model was
  /// fitted to them, so their errors say nothing about another day;
  /// among_neighbours is then set.
  Index rows_of_training = 0;
  /// The inner hold-out for choices inside the training rows of a fold.
  InnerHoldout inner = InnerHoldout::kDecisive;

  /// Returns where the test rows are: another file, or the data set `all`.
  const data::Dataset& Source(const data::Dataset& all) const {
    return test_data != nullptr ? *test_data : all;
  }
};

/// True if whole sessions of `dataset`, and nothing coarser, are held out. It
/// then counts as a sessions hold-out, whatever its SPEC.
bool IsOfSessions(const Holdout& holdout, const data::Dataset& dataset);

/// Makes the folds of `spec` over `dataset`; `test_data` is for file:TEST.csv
/// only. Throws std::invalid_argument if the data do not allow it.
Holdout MakeHoldout(const stats::HoldoutSpec& spec,
                    const data::Dataset& dataset,
                    std::uint64_t seed,
                    std::shared_ptr<const data::Dataset> test_data = nullptr);

/// The result of one fold.
struct FoldResult {
  double train_rmse = 0.0;
  double test_rmse = 0.0;
  fitting::FitSummary summary;
  double fit_seconds = 0.0;
  std::vector<std::string> remarks;
  std::vector<EffectiveOption> choices;  // of the fit, such as wfactor=cv
  std::vector<StartResult> starts;       // empty if there was only one
  VectorXd test_predictions;             // one per test row of the fold
  /// The fitted map, without the values stored above; null for predictions by
  /// other programs.
  std::shared_ptr<const FittedModel> map;
};

/// The results of a model under one hold-out, in the target's unit.
struct HoldoutResult {
  std::string holdout;
  std::string why_failed;     // "" = every fold was fitted
  stats::ErrorMetrics train;  // metrics averaged over the folds
  stats::ErrorMetrics test;   // of the pooled residuals of all folds
  std::vector<FoldResult> folds;

  bool ok() const { return why_failed.empty(); }
};

/// A model in the comparison.
struct ModelResult {
  std::string name;  // the SPEC as given
  ModelKind kind = ModelKind::kPolynomial;
  bool baseline = false;  // a baseline: see IsBaseline
  std::vector<EffectiveOption> options;
  std::vector<HoldoutResult> holdouts;   // as the study's
  std::optional<FittedModel> final_fit;  // to all rows; the map to use
  std::string final_why_failed;
  double final_fit_seconds = 0.0;
  std::optional<ShuffledTargetFit>
      memorisation;         // of a net, fitted to all rows
  double predict_ns = 0.0;  // per prediction; NaN if no fit succeeded

  bool ok() const;          // every hold-out, and the final fit if any
  std::string why() const;  // the first reason for failure, "" if ok
};

/// A fit that has just ended.
struct FitProgress {
  int done = 0;  // fits
  int all = 0;
  StudyTask task;
  double seconds = 0.0;  // spent on it, in whichever run
  /// RMSE of its model and hold-out; NaN until the last fold.
  double holdout_rmse = stats::kNaN;
};

struct StudyOptions {
  std::uint64_t seed = 1;
  int jobs = 1;  // at least 1
  const std::atomic<bool>* stop = nullptr;
  /// The difference in error that does not matter (target's unit).
  double indifference = 0.0;
  bool fit_all_rows = true;  // else models have no final fit
  /// Called at each fit, from any thread; may be empty.
  std::function<void(const FitProgress&)> progress = {};
  /// Keeps finished fits and returns those of earlier runs; may be null.
  FitJournal* journal = nullptr;
};

struct StudyResult {
  std::vector<ModelResult> models;  // in the order of the recipes
  bool interrupted = false;
  int short_of_memory = 0;  // fits that may succeed next time
};

/// Frees the folds' maps after their last use, since those of many components
/// need much memory.
void ForgetFoldMaps(StudyResult* study);

/// Returns all fits of a study in the order in which they start. Nets are last,
/// so that an interrupted run has the quick fits.
std::vector<StudyTask> StudyTasks(
    const std::vector<Holdout>& holdouts,
    const std::vector<std::unique_ptr<ModelRecipe>>& recipes);

/// Returns the context for the fit of `task`.
FitContext ContextOfTask(const StudyTask& task,
                         const std::vector<Holdout>& holdouts,
                         const StudyOptions& options);

/// Fits every recipe to the training rows of every fold and to all rows.
/// Judges each on the held-out rows; all see the same rows. Fits run in
/// parallel; only measured times depend on `jobs`. A failed fit is a result,
/// not an error. Throws std::invalid_argument for no recipes, no hold-outs or
/// jobs < 1.
StudyResult RunStudy(const data::Dataset& dataset,
                     const std::vector<Holdout>& holdouts,
                     const std::vector<std::unique_ptr<ModelRecipe>>& recipes,
                     const StudyOptions& options);

}  // namespace errmap::models
