#pragma once

#include <map>
#include <string>
#include <utility>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "models/study/study.h"

namespace errmap::models {

/// Predictions made elsewhere (MATLAB, Python, the 1995 program), in the
/// target's unit, for the data rows of a file.
struct GivenPredictions {
  std::string name;
  std::string file;
  /// By 0-based data row: of a file with row,predicted. They serve every
  /// hold-out of the data file itself.
  std::map<Eigen::Index, double> by_row;
  /// By (hold-out, fold) and data row: of row,holdout,fold,predicted.
  std::map<std::pair<std::string, Eigen::Index>, std::map<Eigen::Index, double>>
      by_fold;
};

/// Reads CSV row,predicted or row,holdout,fold,predicted. Throws
/// data::InputError naming file, line and remedy: a missing column, no finite
/// number, a row given twice.
GivenPredictions ReadGivenPredictions(const std::string& name,
                                      const data::CsvTable& file);

/// They enter the comparison as a model without a map: judged on the test
/// rows of every fold, and on the training rows where they have all of them.
/// A hold-out whose test rows are not all there has failed, with the row.
ModelResult JudgeGivenPredictions(const GivenPredictions& given,
                                  const data::Dataset& dataset,
                                  const std::vector<Holdout>& holdouts);

}  // namespace errmap::models
