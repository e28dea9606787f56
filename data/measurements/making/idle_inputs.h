#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"

namespace errmap::data {

/// What one value in many rows says of an input.
struct IdleInput {
  std::string how;    // "0 in all 40 rows", "0 in 38 of 40 rows"; "": nothing
  bool dead = false;  // one value in all rows
};

/// Of an input (m, not empty) with one value in at least 90 % of the rows: dead
/// where it is in all, else sparse, as a flag is.
IdleInput HowIdle(const Eigen::Ref<const Eigen::VectorXd>& values);

/// Whether the values (m) of each session lie above all of those before it;
/// `sessions` has the code of each row, in the order of the file.
bool CountsOn(const Eigen::Ref<const Eigen::VectorXd>& values,
              const std::vector<Eigen::Index>& sessions);

/// Whether values (m) of more than a few rows rise in at least a quarter of
/// these and fall in none.
bool NeverFalls(const Eigen::Ref<const Eigen::VectorXd>& values);

/// Whether values (m) are whole numbers, one for each of `sessions` (at least
/// three): the day of the year.
bool NumberEach(const Eigen::Ref<const Eigen::VectorXd>& values,
                Eigen::Index sessions);

/// Whether values (m; NaN apart) are of two kinds, as those of a switch.
bool HasTwoValues(const Eigen::Ref<const Eigen::VectorXd>& values);

/// Tells which inputs repeat another value for value. Columns are met by their
/// hash, so that many stay cheap.
class RepeatedInputs {
 public:
  /// Of the last of `parts.inputs`, one column of `parts.input_values` each:
  /// remarks where it repeats the target, and the name of the earlier input
  /// that was looked at and that it repeats, or "".
  struct Found {
    std::vector<std::string> remarks;
    std::string repeats;
  };
  Found Look(const Dataset::Parts& parts);

 private:
  std::unordered_map<std::uint64_t, std::vector<Eigen::Index>> inputs_by_hash_;
};

}  // namespace errmap::data
