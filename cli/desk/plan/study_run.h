#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cli/desk/plan/study_plan.h"
#include "cli/desk/provenance.h"
#include "cli/desk/study_config.h"
#include "models/study/record/component_study.h"
#include "models/study/study.h"

namespace errmap::models {
class KeptFits;
}

namespace errmap::desk {

/// A whole run: table, JSON and files are written from this and nothing else.
struct StudyRun {
  std::uint64_t seed = 1;
  std::string command_line;
  StudyConfig config;             // as it was carried out
  std::vector<InputFile> inputs;  // every file read, in the order of reading
  /// Those of the plan that were begun.
  std::vector<models::ComponentStudy> components;
  bool interrupted = false;

  /// Names of files and headings tell components apart where this is true.
  bool has_several() const { return config.components.size() > 1; }
};

struct RunOptions {
  int jobs = 1;
  const std::atomic<bool>* stop = nullptr;
  models::KeptFits* journal = nullptr;  // keeps the fits; may be null
  std::string cache = {};  // folder of the last fits (kept_fits.h); "" for none
  Remark journal_has = {};      // told what the journal has of them
  bool keep_fold_maps = false;  // of the hold-outs: FoldResult::map
  /// Told which component of the plan a fit was of and of the fit, its counts
  /// those of the whole plan, from any thread; may be empty.
  std::function<void(std::size_t, const models::FitProgress&)> progress = {};
};

/// Fits and judges the components one after another, the fits of each in
/// parallel. Where `stop` is set, components not yet begun are left out.
/// `command_line`: for provenance, what is said to have asked for it.
StudyRun RunPlan(StudyPlan plan,
                 const std::string& command_line = "",
                 const RunOptions& options = {});

}  // namespace errmap::desk
