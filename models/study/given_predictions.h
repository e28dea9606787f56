#pragma once

#include <map>
#include <string>
#include <utility>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "models/study/study.h"

namespace errmap::models {

/// Predictions by another program (MATLAB, Python, the 1995 program), in the
/// target's unit, for the data rows of a file.
struct GivenPredictions {
  std::string name;
  std::string file;
  /// By 0-based data row, from a file with row,predicted. They apply to every
  /// hold-out of the data file itself.
  std::map<Index, double> by_row;
  /// By (hold-out, fold) and data row, from row,holdout,fold,predicted.
  std::map<std::pair<std::string, Index>, std::map<Index, double>> by_fold;
};

/// Reads CSV row,predicted or row,holdout,fold,predicted. Throws
/// data::InputError naming file, line and remedy: a missing column, a number
/// that is not finite, a duplicate row.
GivenPredictions ReadGivenPredictions(const std::string& name,
                                      const data::CsvTable& file);

/// Scores predictions like those of a model, but without a map. It uses the
/// test rows of every fold, and the training rows if all are given. If a test
/// row is missing, the hold-out has failed, and the reason names the row.
ModelResult JudgeGivenPredictions(const GivenPredictions& given,
                                  const data::Dataset& dataset,
                                  const std::vector<Holdout>& holdouts);

}  // namespace errmap::models
