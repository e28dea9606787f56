#pragma once

#include <string>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/study/study.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Name of the unit if there are no groups.
inline constexpr const char* kBlockOfRows = "block of rows";

/// Units that count as one observation each in every test.
struct UnitsOfAnalysis {
  std::string name;           // "cycle", "day", ...; "session"; kBlockOfRows
  bool are_sessions = false;  // whole sessions are held out
  bool separate_sessions = false;   // known from a column; confidence.h
  std::vector<std::string> labels;  // (units) group, or "rows 0-16"
};

/// Every held-out row of every fold, in the order of the folds.
struct HeldOutRows {
  const data::Dataset* source = nullptr;  // not owned
  std::vector<Index> rows;                // (n) index into source
  std::vector<std::size_t> fold_of;       // (n)
};
HeldOutRows GatherHeldOut(const data::Dataset& dataset, const Holdout& holdout);

/// Returns target minus prediction (n) of those rows.
VectorXd ResidualsOf(const HeldOutRows& held, const HoldoutResult& result);

/// Fills `units` and returns the unit of each of those rows (n), an index into
/// `units->labels`. Groups and sessions that are never held out are not units.
std::vector<Index> AssignUnits(const Holdout& holdout,
                               const HeldOutRows& held,
                               UnitsOfAnalysis* units);

}  // namespace errmap::models
