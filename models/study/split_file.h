#pragma once

#include <string>
#include <vector>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "models/study/study.h"

namespace errmap::models {

/// Reads the hold-outs of a split file: CSV row,holdout,fold,role with role
/// train|test|unused and 0-based data rows. Keeps the order of the file, with
/// folds by ascending number. A hold-out keeps groups whole if no fold has a
/// group on both sides.
///
/// Throws data::InputError naming file, line and remedy: a missing column, a
/// row that `dataset` lacks, an unknown role, a row twice in a fold, folds not
/// numbered 0, 1, ..., or a fold without training or test rows.
std::vector<Holdout> ReadSplitFile(const data::CsvTable& file,
                                   const data::Dataset& dataset);

/// Writes the hold-outs as such a file, without those that use a test file.
std::string SplitFileText(const std::vector<Holdout>& holdouts,
                          const data::Dataset& dataset);

}  // namespace errmap::models
