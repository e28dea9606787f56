#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "data/measurements/dataset.h"

namespace errmap::cli {

/// Predictions made elsewhere, to stand in the table as model `name`.
struct PredictionsFile {
  std::string name;
  std::string file;
};

/// One error component to be mapped, as the user asks for it: empty texts and
/// NaN leave the choice to the defaults of the command line.
struct ComponentConfig {
  std::string name;  // default: the data file's name without its ending
  std::string data;  // path as it can be opened
  std::vector<data::ColumnFilter> where;
  std::string target;
  std::vector<std::string> inputs;
  std::vector<std::string> exclude;
  std::string group;
  std::string time;
  std::string session;
  data::Alignment align = data::Alignment::kNone;
  std::string weight;
  data::MissingPolicy missing = data::MissingPolicy::kError;
  data::FaultPolicy faults = data::FaultPolicy::kKeep;
  bool keep_dead = false;
  /// sd wanted on held-out rows, target's unit; NaN: the study's.
  double goal = std::numeric_limits<double>::quiet_NaN();
  /// RMSE that makes no practical difference, target's unit; NaN: the study's.
  double indifference = std::numeric_limits<double>::quiet_NaN();
  std::string split;       // split file to judge by
  std::string save_split;  // file that gets the folds
  std::vector<PredictionsFile> predictions;
  std::vector<std::string> later;  // sessions that no fit may see
};

/// A study as the user asks for it, on the command line or in a study file:
/// everything that decides a figure, nothing that does not (jobs, folders).
struct StudyConfig {
  std::uint64_t seed = 1;
  /// For components without their own; NaN: 0.5 um for lengths, else none.
  double goal = std::numeric_limits<double>::quiet_NaN();
  /// For components without their own; NaN: 0.02 um for lengths, else 0.
  double indifference = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::string> holdouts;  // SPECs; empty: those that the data allow
  std::vector<std::string> models;    // SPECs; empty: all that suit
  std::vector<ComponentConfig> components;
};

}  // namespace errmap::cli
