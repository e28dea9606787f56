#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/study_file/provenance.h"
#include "cli/study_file/study_config.h"
#include "data/dataset.h"
#include "models/study/study.h"
#include "models/study/verdict.h"

namespace errmap::cli {

/// One component's comparison with all that its outputs need.
struct Comparison {
  std::string name;  // of the component
  std::string file;
  std::string sha256;
  double goal = 0.0;          // target's unit; NaN: none
  double indifference = 0.0;  // target's unit
  data::PreparedDataset data;
  std::vector<models::Holdout> holdouts;
  models::StudyResult study;
  /// Models of the study that nobody asked for, baselines, from `first_added`.
  std::size_t first_added = 0;
  std::size_t num_added = 0;
  models::Judgement judgement;
};

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
