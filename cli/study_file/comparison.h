#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/study_file/provenance.h"
#include "cli/study_file/study_config.h"
#include "models/study/record/component_study.h"

namespace errmap::cli {

using Comparison = models::ComponentStudy;

/// A whole run: table, JSON and files are written from this and nothing else.
struct StudyRun {
  std::uint64_t seed = 1;
  std::string command_line;
  StudyConfig config;             // as it was carried out
  std::vector<InputFile> inputs;  // every file read, in the order of reading
  /// Those of the plan that were begun.
  std::vector<Comparison> components;
  bool interrupted = false;

  /// Names of files and headings tell components apart where this is true.
  bool has_several() const { return config.components.size() > 1; }
};

}  // namespace errmap::cli
