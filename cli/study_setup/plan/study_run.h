#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cli/study_setup/plan/study_plan.h"
#include "cli/study_setup/provenance.h"
#include "cli/study_setup/study_config.h"
#include "models/study/record/component_study.h"
#include "models/study/record/study_record.h"
#include "models/study/study.h"

namespace errmap::models {
class KeptFits;
}

namespace errmap::study_setup {

/// A whole run, the only source of tables, JSON and files.
struct StudyRun {
  std::uint64_t seed = 1;
  std::string command_line;
  StudyConfig config;             // as it was carried out
  std::vector<InputFile> inputs;  // every file read, in the order of reading
  /// The components of the plan that were started.
  std::vector<models::ComponentStudy> components = {};
  bool interrupted = false;

  /// True if file names and headings must distinguish components.
  bool has_several() const { return config.components.size() > 1; }
};

struct RunOptions {
  int jobs = 1;
  const std::atomic<bool>* stop = nullptr;
  models::KeptFits* journal = nullptr;  // keeps the fits; may be null
  std::string cache = {};  // folder of the last fits (kept_fits.h); "" for none
  Remark journal_has = {};      // receives what the journal has of the fits
  bool keep_fold_maps = false;  // of the hold-outs: FoldResult::map
  /// Receives the index of the component in the plan, and the fit. Its counts
  /// are those of the whole plan. Called from any thread; may be empty.
  std::function<void(std::size_t, const models::FitProgress&)> progress = {};
};

/// Fits and judges the components one after another; the fits of each run in
/// parallel. Once `stop` is set, it starts no further component.
/// `command_line`: the command shown as the origin of the results.
StudyRun RunPlan(StudyPlan plan,
                 const std::string& command_line = "",
                 const RunOptions& options = {});

/// Returns the results of a run, judged and put into words. results.json, every
/// table and every page are made from it. `jobs`: number of threads that assess
/// residuals.
models::StudyRecord RecordOf(const StudyRun& run, int jobs = 1);

}  // namespace errmap::study_setup
