#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"
#include "models/study/study.h"

namespace errmap::models {

/// Name of the unit where there are no groups.
inline constexpr const char* kBlockOfRows = "block of rows";

/// What is met as a whole and so counts as one observation in every test.
struct UnitsOfAnalysis {
  std::string name;         // "cycle", "day", ...; "session"; kBlockOfRows
  bool are_groups = false;  // groups or sessions, else blocks of held-out rows
  bool are_sessions = false;        // what is held out whole is sessions
  bool separate_sessions = false;   // units are, by a column; confidence.h
  std::vector<std::string> labels;  // (units) group, or "rows 0-16"
};

/// Every held-out row of every fold, in the order of the folds.
struct HeldOutRows {
  const data::Dataset* source = nullptr;  // not owned
  std::vector<Eigen::Index> rows;         // (n) index into source
  std::vector<std::size_t> fold_of;       // (n)
};
HeldOutRows GatherHeldOut(const data::Dataset& dataset, const Holdout& holdout);

/// (n) target less prediction of those rows.
Eigen::VectorXd ResidualsOf(const HeldOutRows& held,
                            const HoldoutResult& result);

/// (n) the unit of each of those rows, an index into `units->labels`; `units`
/// is filled. Groups and sessions that are never held out are no units.
std::vector<Eigen::Index> AssignUnits(const Holdout& holdout,
                                      const HeldOutRows& held,
                                      UnitsOfAnalysis* units);

}  // namespace errmap::models
