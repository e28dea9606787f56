#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/study_setup/given_error.h"
#include "data/measurements/dataset.h"
#include "models/record.h"
#include "models/study/judgement/recommendation.h"

namespace errmap::study_setup {

/// Predictions of another program, shown in the table as model `name`.
struct PredictionsFile {
  std::string name;
  std::string file;
};

/// One error component to be mapped, as the user requests it. Empty texts and
/// NaN stand for the defaults (models/study/study_defaults.h).
struct ComponentConfig {
  std::string name;  // default: the data file's name without its ending
  std::string data;  // a file or folder, as it can be opened
  std::vector<std::string> more_data;  // further files of the same component
  data::DatasetSelection selection;    // of the file's rows and columns
  GivenError goal;  // RMSE wanted on held-out rows; default: the study's
  /// RMSE that makes no practical difference; default: the study's.
  GivenError indifference;
  std::string split;       // split file to judge by
  std::string save_split;  // file that gets the folds
  std::vector<PredictionsFile> predictions;
  std::vector<std::string> later;  // sessions that no fit may see
  /// Returns `data` and `more_data`; both may be folders.
  std::vector<std::string> AllData() const {
    std::vector<std::string> all{data};
    all.insert(all.end(), more_data.begin(), more_data.end());
    return all;
  }
  /// Set by the plan: the options with which a command reads the same
  /// measurements.
  models::ByName<std::string> options = {};
};

/// A study as the user requests it, on the command line or in a study file. It
/// does not include jobs, the output folder or the settings of slices.
struct StudyConfig {
  std::uint64_t seed = 1;
  /// For components without their own; default: none.
  GivenError goal;
  /// For components without their own; default: 0.02 um for lengths, else 0.
  GivenError indifference;
  models::Choose choose = models::Choose::kAuto;  // the map to recommend
  models::Prefer prefer = models::Prefer::kLeastError;
  std::vector<std::string> holdouts;  // SPECs; empty: those that the data allow
  std::vector<std::string> models;    // SPECs; empty: all that suit
  std::string rezero;  // models::ParseRezero; "": held-out rows as they are
  std::vector<ComponentConfig> components;
};

}  // namespace errmap::study_setup
