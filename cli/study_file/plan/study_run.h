#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "cli/study_file/comparison.h"
#include "cli/study_file/plan/study_plan.h"
#include "models/study/journal/fit_journal_file.h"

namespace errmap::cli {

struct RunOptions {
  int jobs = 1;
  const std::atomic<bool>* stop = nullptr;
  models::JournalFile* journal = nullptr;  // keeps the fits; may be null
  bool describe_resume = false;  // say on stderr what the journal has of them
  bool keep_fold_maps = false;   // of the hold-outs: FoldResult::map
  /// Told which component of the plan a fit was of and of the fit, its counts
  /// those of the whole plan, from any thread; may be empty.
  std::function<void(std::size_t, const models::FitProgress&)> progress = {};
};

/// Fits and judges the components one after another, the fits of each in
/// parallel. Where `stop` is set, components not yet begun are left out.
StudyRun RunPlan(StudyPlan plan,
                 const std::string& command_line,
                 const RunOptions& options);

}  // namespace errmap::cli
