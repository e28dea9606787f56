#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"

namespace errmap::data {

/// Kind of an input that has one value in many rows.
struct IdleInput {
  std::string how;    // "0 in all 40 rows", "0 in 38 of 40 rows"; "": nothing
  bool dead = false;  // one value in all rows
};

/// Examines an input (m, not empty) with one value in at least 90 % of the
/// rows: dead if in all of them, else sparse, like a flag.
IdleInput HowIdle(const Eigen::Ref<const Eigen::VectorXd>& values);

/// True if the values (m) of each session lie above all those of the sessions
/// before it. `sessions` has the code of each row, in the order of the file.
bool CountsOn(const Eigen::Ref<const Eigen::VectorXd>& values,
              const std::vector<Eigen::Index>& sessions);

/// True if values (m) of more than a few rows never fall, and rise in at least
/// a quarter of the rows.
bool NeverFalls(const Eigen::Ref<const Eigen::VectorXd>& values);

/// True if values (m) are whole numbers that only rise or only fall, and differ
/// between sessions (at least three), such as the day of the year or the number
/// of a job. `sessions` has the code of each row, in the order of the file.
bool AreNumbersThatNeverReturn(const Eigen::Ref<const Eigen::VectorXd>& values,
                               const std::vector<Eigen::Index>& sessions);

/// True if there are two distinct values (except NaN), as for a switch.
bool HasTwoValues(const Eigen::Ref<const Eigen::VectorXd>& values);

/// Finds inputs that repeat another one exactly. Compares sums first, so that
/// many columns take little time.
class RepeatedInputs {
 public:
  struct Found {
    std::vector<std::string> remarks;  // if it repeats the target
    std::string repeats;  // name of an input examined earlier, or ""
  };
  /// Examines the last of `parts.inputs`, with one column of
  /// `parts.input_values` each.
  Found Look(const Dataset::Parts& parts);

 private:
  std::unordered_map<double, std::vector<Eigen::Index>> inputs_by_sum_;
};

}  // namespace errmap::data
