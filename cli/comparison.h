#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "data/dataset.h"
#include "models/study.h"
#include "models/verdict.h"

namespace errmap::cli {

/// One component's comparison with all that its outputs need: table, JSON and
/// files are written from this and nothing else.
struct Comparison {
  std::string name;  // of the component
  std::string file;
  std::string sha256;
  std::string command_line;
  std::uint64_t seed = 1;
  double goal = 0.0;  // target's unit; NaN: none
  data::PreparedDataset data;
  std::vector<models::Holdout> holdouts;
  models::StudyResult study;
  std::vector<models::Verdict> verdicts;
};

}  // namespace errmap::cli
