#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "models/error_model.h"
#include "models/study/shuffled_target_fit.h"
#include "stats/eigen.h"

namespace errmap::models {

/// The outcome of one fit of a study.
struct FitOutcome {
  std::optional<FittedModel> fitted;  // empty: failed
  std::string why_failed;
  double seconds = 0.0;
  VectorXd train_predictions;  // target's unit; empty if failed
  VectorXd test_predictions;   // the same; empty for a fit to all rows
  std::optional<ShuffledTargetFit> memorisation;  // of a net fitted to all rows
  /// True if memory ran out: another try may succeed, so it is not kept.
  bool try_again = false;
};

/// One fit of a study: a model on one fold of one hold-out, or on all rows.
struct StudyTask {
  std::size_t model = 0;
  std::ptrdiff_t holdout = -1;  // -1: all rows
  std::size_t fold = 0;
};

/// Keeps finished fits, so that an interrupted study can be resumed. Find and
/// Record are called from several threads.
class FitJournal {
 public:
  virtual ~FitJournal() = default;
  /// Returns the outcome of the same fit in an earlier run, if any.
  virtual std::optional<FitOutcome> Find(const StudyTask& task) = 0;
  /// Keeps an outcome for later runs, except of interrupted fits and of those
  /// that may succeed next time.
  virtual void Record(const StudyTask& task, const FitOutcome& outcome) = 0;
};

}  // namespace errmap::models
