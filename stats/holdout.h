#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace errmap::stats {

/// How rows are held out of a fit.
enum class HoldoutKind {
  kEvery,             // every:K          rows i with i % K == K-1
  kGroups,            // groups:K[:repeats=R]  runs of whole groups
  kLeaveOneGroupOut,  // leave-one-group-out
  kKFold,             // kfold:K          seeded shuffle of rows
  kForward,           // forward:K[:gap=G]     earlier blocks predict the next
  kRandom,            // random:F         seeded test share F
  kFile,              // file:TEST.csv    all rows train, another file tests
};

/// A hold-out as the user writes it.
struct HoldoutSpec {
  HoldoutKind kind = HoldoutKind::kEvery;
  std::string text;          // as given: the name in every output
  Eigen::Index k = 0;        // every, groups, kfold, forward; at least 2
                             // (forward: at least 1)
  Eigen::Index repeats = 0;  // groups: 0 = one cut of the sorted groups
  Eigen::Index gap = 0;      // forward: groups left out before the test block
  double share = 0.0;        // random: 0 < share < 1
  std::string file;          // file
};

/// Reads "every:3", "groups:5:repeats=20", ... Throws std::invalid_argument
/// with what was found and what is allowed.
HoldoutSpec ParseHoldout(std::string_view text);

/// Indices of the rows fitted and of the rows judged, both ascending.
struct Fold {
  std::vector<Eigen::Index> train;
  std::vector<Eigen::Index> test;
};

/// Folds of `spec` over rows 0 .. num_rows-1.
///
/// `group_codes` (num_rows, or empty: no groups) numbers the group of each row
/// in the order of the groups; numbers that no row has are passed over. `seed`
/// serves kfold, random and repeats. kFile gives one fold that trains on every
/// row and tests none here.
///
/// Throws std::invalid_argument, with what is possible instead, where the data
/// do not allow it: groups asked for and none or too few there, more folds
/// than rows, an empty training or test side.
std::vector<Fold> MakeFolds(const HoldoutSpec& spec,
                            Eigen::Index num_rows,
                            const std::vector<Eigen::Index>& group_codes,
                            std::uint64_t seed);

}  // namespace errmap::stats
