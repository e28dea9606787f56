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
  kSessions,          // sessions:K[:repeats=R]  the same of sessions
  kBlocks,            // blocks:K         contiguous runs of rows
  kLeaveOneGroupOut,  // leave-one-group-out
  kKFold,             // kfold:K          seeded shuffle of rows
  kForward,           // forward:K[:gap=G]     earlier blocks predict the next
  kRandom,            // random:F         seeded test share F
  kFile,              // file:TEST.csv    all rows train, another file tests
};

/// What people are told of a kind of hold-out.
struct HoldoutForm {
  std::string_view form;  // "groups:K[:repeats=R]"
  std::string_view meaning;
  std::vector<std::string_view> examples;
};
/// One per kind; whatever lists the kinds for people is made from this.
const std::vector<HoldoutForm>& HoldoutForms();
/// "every:K, groups:K[:repeats=R], ..., file:TEST.csv".
std::string HoldoutFormsText();
/// Of a hold-out's name; "" for one of a split file.
std::string_view HoldoutMeaning(std::string_view name);

/// A hold-out as the user writes it.
struct HoldoutSpec {
  HoldoutKind kind = HoldoutKind::kEvery;
  std::string text;          // as given: the name in every output
  Eigen::Index k = 0;        // every, groups, sessions, blocks, kfold,
                             // forward; at least 2 (forward: at least 1)
  Eigen::Index repeats = 0;  // groups, sessions: 0 = one cut, in their order
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
/// in the order of the groups, for sessions:K the session likewise; numbers
/// that no row has are passed over. `seed` serves kfold, random and repeats.
/// kFile gives one fold that trains on every row and tests none here.
///
/// Throws std::invalid_argument, with what is possible instead, where the data
/// do not allow it: groups or sessions asked for and none or too few, more
/// folds than rows, an empty training or test side.
std::vector<Fold> MakeFolds(const HoldoutSpec& spec,
                            Eigen::Index num_rows,
                            const std::vector<Eigen::Index>& group_codes,
                            std::uint64_t seed);

/// Whether no code (one per row: group or session) is on both sides of a fold.
bool KeepsWhole(const std::vector<Fold>& folds,
                const std::vector<Eigen::Index>& codes);

}  // namespace errmap::stats
