#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/study/fit_outcome.h"
#include "stats/error_metrics.h"
#include "stats/holdout.h"

namespace errmap::models {

/// A way of holding rows out, ready for one data set.
struct Holdout {
  std::string name;             // its SPEC
  bool whole_groups = false;    // no group is on both sides of a fold
  bool whole_sessions = false;  // likewise of two sessions or more
  /// Rows between which others were fitted are judged: interpolation.
  bool among_neighbours = false;
  bool forward = false;            // earlier rows predict later ones
  Eigen::Index repeats = 1;        // cuts of the same rows, one after another
  std::vector<stats::Fold> folds;  // indices into the data set
  /// Rows judged instead of the folds' own (file:TEST.csv), or null.
  std::shared_ptr<const data::Dataset> test_data;
  /// Of those, the ones that stand in the data set too: they were learnt, so
  /// the figures tell nothing of another day. Then among_neighbours is set.
  Eigen::Index rows_of_training = 0;
  /// Of the choices made inside the training rows of a fold.
  InnerHoldout inner = InnerHoldout::kDecisive;
};

/// Folds of `spec` over `dataset`; `test_data` for file:TEST.csv only. Throws
/// std::invalid_argument where the data do not allow it.
Holdout MakeHoldout(const stats::HoldoutSpec& spec,
                    const data::Dataset& dataset,
                    std::uint64_t seed,
                    std::shared_ptr<const data::Dataset> test_data = nullptr);

/// What happened in one fold.
struct FoldResult {
  double train_rmse = 0.0;
  double test_rmse = 0.0;
  fitting::FitSummary summary;
  double fit_seconds = 0.0;
  std::vector<std::string> remarks;
  std::vector<EffectiveOption> choices;  // of the fit, such as wfactor=cv
  std::vector<StartResult> starts;       // empty where there was one only
  Eigen::VectorXd test_predictions;      // one per test row of the fold
  /// What was fitted, less what stands above; null for predictions made
  /// elsewhere.
  std::shared_ptr<const FittedModel> map;
};

/// A model under one hold-out, in the target's unit.
struct HoldoutResult {
  std::string holdout;
  std::string why_failed;     // "" = every fold was fitted
  stats::ErrorMetrics train;  // each figure averaged over the folds
  stats::ErrorMetrics test;   // of the pooled residuals of all folds
  std::vector<FoldResult> folds;

  bool ok() const { return why_failed.empty(); }
};

/// A model in the comparison.
struct ModelResult {
  std::string name;  // the SPEC as given
  ModelKind kind = ModelKind::kPolynomial;
  bool baseline = false;  // what any map must beat: see IsBaseline
  std::vector<EffectiveOption> options;
  std::vector<HoldoutResult> holdouts;   // as the study's
  std::optional<FittedModel> final_fit;  // to all rows; the map to use
  std::string final_why_failed;
  double final_fit_seconds = 0.0;
  std::optional<Memorisation> memorisation;  // of a net, fitted to all rows
  double predict_ns = 0.0;  // per prediction; NaN where nothing was fitted

  bool ok() const;          // every hold-out, and the final fit if there is one
  std::string why() const;  // the first reason of failure, "" if ok
};

/// A fit that has just ended.
struct FitProgress {
  int done = 0;  // fits
  int all = 0;
  StudyTask task;
  double seconds = 0.0;  // that it took, in whichever run
  /// Of its model under its hold-out, once the last fold is there; else NaN.
  double holdout_rmse = std::numeric_limits<double>::quiet_NaN();
};

struct StudyOptions {
  std::uint64_t seed = 1;
  int jobs = 1;  // at least 1
  const std::atomic<bool>* stop = nullptr;
  /// The difference in error that never matters (target's unit).
  double indifference = 0.0;
  bool fit_all_rows = true;  // else models have no final fit
  /// Told of each fit, from any thread; may be empty.
  std::function<void(const FitProgress&)> progress = {};
  /// Keeps finished fits and gives back those of an earlier run; may be null.
  FitJournal* journal = nullptr;
};

struct StudyResult {
  std::vector<ModelResult> models;  // as the recipes
  bool interrupted = false;
  int short_of_memory = 0;  // fits that may succeed another time
};

/// Of many components they would take much memory: once their last use is
/// behind.
void ForgetFoldMaps(StudyResult* study);

/// All fits of a study in the order in which they begin: nets last, so that
/// whoever interrupts a long run has the quick fits.
std::vector<StudyTask> StudyTasks(
    const std::vector<Holdout>& holdouts,
    const std::vector<std::unique_ptr<ModelRecipe>>& recipes);

/// What the fit of `task` may use besides its rows.
FitContext ContextOfTask(const StudyTask& task,
                         const std::vector<Holdout>& holdouts,
                         const StudyOptions& options);

/// Fits every recipe to the training rows of every fold and to all rows, and
/// judges each on the rows held out; all see the same rows. Fits run in
/// parallel; nothing but the measured times depends on `jobs`. A fit that
/// fails is a result, not an error. Throws std::invalid_argument for no
/// recipes, no hold-outs or jobs < 1.
StudyResult RunStudy(const data::Dataset& dataset,
                     const std::vector<Holdout>& holdouts,
                     const std::vector<std::unique_ptr<ModelRecipe>>& recipes,
                     const StudyOptions& options);

}  // namespace errmap::models
