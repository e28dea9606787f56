#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "stats/eigen.h"

namespace errmap::stats {

/// How rows are held out of a fit.
enum class HoldoutKind {
  kEvery,             // every:K          rows i with i % K == K-1
  kGroups,            // groups:K[:repeats=R]  runs of whole groups
  kSessions,          // sessions:K[:repeats=R]  runs of whole sessions
  kBlocks,            // blocks:K         contiguous runs of rows
  kLeaveOneGroupOut,  // leave-one-group-out
  kKFold,             // kfold:K          seeded shuffle of rows
  kForward,           // forward:K[:gap=G]     earlier blocks predict the next
  kRandom,            // random:F         seeded test share F
  kFile,              // file:TEST.csv    all rows train, another file tests
};

/// User-facing text for a kind of hold-out.
struct HoldoutForm {
  std::string_view form;  // "groups:K[:repeats=R]"
  std::string_view meaning;
  std::vector<std::string_view> examples;
};
/// Returns one entry per kind, the source of all user-facing lists of kinds.
const std::vector<HoldoutForm>& HoldoutForms();
/// Returns "every:K, groups:K[:repeats=R], ..., file:TEST.csv".
std::string HoldoutFormsText();
/// Returns the meaning of a hold-out's name; "" for a name from a split file.
std::string_view HoldoutMeaning(std::string_view name);

/// A hold-out as specified by the user.
struct HoldoutSpec {
  HoldoutKind kind = HoldoutKind::kEvery;
  std::string text;    // as given; the name in every output
  Index k = 0;         // every, groups, sessions, blocks, kfold,
                       // forward; at least 2 (forward: at least 1)
  Index repeats = 0;   // groups, sessions: 0 = one cut, in order
  Index gap = 0;       // forward: groups left out before the test block
  double share = 0.0;  // random: 0 < share < 1
  std::string file;    // file
};

/// Parses "every:3", "groups:5:repeats=20", ... Throws std::invalid_argument
/// with the text found and the forms allowed.
HoldoutSpec ParseHoldout(std::string_view text);

/// Indices of the training rows and of the test rows, both ascending.
struct Fold {
  std::vector<Index> train;
  std::vector<Index> test;
};

/// Returns the folds of `spec` over rows 0 .. num_rows-1.
///
/// `group_codes` (num_rows, or empty: no groups) holds each row's group number,
/// in the order of the groups; for sessions:K its session number. Numbers
/// without rows are skipped. `seed` is used by kfold, random and repeats. kFile
/// gives one fold with all rows for training and no test rows.
///
/// Throws std::invalid_argument if the data do not allow the hold-out; the
/// message says what is possible instead. Causes: no groups or sessions, too
/// few of them, more folds than rows, an empty training or test set.
std::vector<Fold> MakeFolds(const HoldoutSpec& spec,
                            Index num_rows,
                            const std::vector<Index>& group_codes,
                            std::uint64_t seed);

/// Returns true if no code (one per row) is on both sides of a fold.
bool KeepsWhole(const std::vector<Fold>& folds,
                const std::vector<Index>& codes);

}  // namespace errmap::stats
