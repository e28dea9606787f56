#include "stats/holdout.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace errmap::stats {
namespace {

using Eigen::Index;
using Rows = std::vector<Index>;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

constexpr std::uint64_t kHoldoutSeed = 1;

std::vector<Fold> Folds(const std::string& text,
                        Index num_rows,
                        const Rows& group_codes = {},
                        std::uint64_t seed = kHoldoutSeed) {
  return MakeFolds(ParseHoldout(text), num_rows, group_codes, seed);
}

std::vector<Rows> TestRows(const std::vector<Fold>& folds) {
  std::vector<Rows> rows;
  for (const Fold& fold : folds) rows.push_back(fold.test);
  return rows;
}

std::vector<Rows> TrainRows(const std::vector<Fold>& folds) {
  std::vector<Rows> rows;
  for (const Fold& fold : folds) rows.push_back(fold.train);
  return rows;
}

Rows RangeOf(Index size) {
  Rows rows;
  for (Index row = 0; row < size; ++row) rows.push_back(row);
  return rows;
}

// `groups` groups of `length` rows each, one after the other.
Rows EqualGroupsInHoldout(Index groups, Index length) {
  Rows codes;
  for (Index group = 0; group < groups; ++group) {
    codes.insert(codes.end(), static_cast<std::size_t>(length), group);
  }
  return codes;
}

// Both sides ascending, within 0 .. num_rows-1 and without a common row.
void ExpectSound(const Fold& fold, Index num_rows) {
  Rows both = fold.train;
  both.insert(both.end(), fold.test.begin(), fold.test.end());
  EXPECT_TRUE(std::is_sorted(fold.train.begin(), fold.train.end()));
  EXPECT_TRUE(std::is_sorted(fold.test.begin(), fold.test.end()));
  const std::set<Index> distinct(both.begin(), both.end());
  EXPECT_EQ(distinct.size(), both.size()) << "a row is on both sides or twice";
  ASSERT_FALSE(both.empty());
  EXPECT_GE(*distinct.begin(), 0);
  EXPECT_LT(*distinct.rbegin(), num_rows);
}

// Sound, and train and test together are all rows.
void ExpectSplitsAllRows(const std::vector<Fold>& folds, Index num_rows) {
  for (const Fold& fold : folds) {
    ExpectSound(fold, num_rows);
    EXPECT_EQ(static_cast<Index>(fold.train.size() + fold.test.size()),
              num_rows);
  }
}

// The test sides of folds first .. first+count-1 hold each row exactly once.
void ExpectTestsPartitionRows(const std::vector<Fold>& folds,
                              std::size_t first,
                              std::size_t count,
                              Index num_rows) {
  ASSERT_LE(first + count, folds.size());
  Rows tested;
  for (std::size_t i = first; i < first + count; ++i) {
    tested.insert(tested.end(), folds[i].test.begin(), folds[i].test.end());
  }
  std::sort(tested.begin(), tested.end());
  EXPECT_EQ(tested, RangeOf(num_rows));
}

void ExpectKeepsGroupsWhole(const std::vector<Fold>& folds, const Rows& codes) {
  for (const Fold& fold : folds) {
    std::set<Index> trained;
    for (const Index row : fold.train) {
      trained.insert(codes[static_cast<std::size_t>(row)]);
    }
    for (const Index row : fold.test) {
      EXPECT_FALSE(trained.contains(codes[static_cast<std::size_t>(row)]))
          << "row " << row << " is tested by a model that knows its group";
    }
  }
}

void ExpectParseError(const std::string& text, const std::string& why) {
  EXPECT_THAT([&] { ParseHoldout(text); },
              ThrowsMessage<std::invalid_argument>(AllOf(
                  StartsWith("hold-out '" + text + "': "), HasSubstr(why))))
      << text;
}

void ExpectRefused(const std::string& text,
                   Index num_rows,
                   const Rows& codes,
                   const std::string& why) {
  EXPECT_THAT([&] { Folds(text, num_rows, codes); },
              ThrowsMessage<std::invalid_argument>(AllOf(
                  StartsWith("hold-out '" + text + "': "), HasSubstr(why))))
      << text;
}

TEST(ParseHoldout, ReadsEveryKind) {
  const HoldoutSpec every = ParseHoldout("every:3");
  EXPECT_EQ(every.kind, HoldoutKind::kEvery);
  EXPECT_EQ(every.text, "every:3");
  EXPECT_EQ(every.k, 3);

  const HoldoutSpec groups = ParseHoldout("groups:5");
  EXPECT_EQ(groups.kind, HoldoutKind::kGroups);
  EXPECT_EQ(groups.k, 5);
  EXPECT_EQ(groups.repeats, 0);

  const HoldoutSpec repeated = ParseHoldout("groups:5:repeats=20");
  EXPECT_EQ(repeated.kind, HoldoutKind::kGroups);
  EXPECT_EQ(repeated.text, "groups:5:repeats=20");
  EXPECT_EQ(repeated.k, 5);
  EXPECT_EQ(repeated.repeats, 20);

  EXPECT_EQ(ParseHoldout("leave-one-group-out").kind,
            HoldoutKind::kLeaveOneGroupOut);

  const HoldoutSpec kfold = ParseHoldout("kfold:10");
  EXPECT_EQ(kfold.kind, HoldoutKind::kKFold);
  EXPECT_EQ(kfold.k, 10);

  const HoldoutSpec forward = ParseHoldout("forward:1");
  EXPECT_EQ(forward.kind, HoldoutKind::kForward);
  EXPECT_EQ(forward.k, 1);
  EXPECT_EQ(forward.gap, 0);
  EXPECT_EQ(ParseHoldout("forward:4:gap=2").gap, 2);
  EXPECT_EQ(ParseHoldout("forward:4:gap=0").gap, 0);

  const HoldoutSpec random = ParseHoldout("random:0.25");
  EXPECT_EQ(random.kind, HoldoutKind::kRandom);
  EXPECT_EQ(random.share, 0.25);

  const HoldoutSpec file = ParseHoldout("file:C:/data/day:2.csv");
  EXPECT_EQ(file.kind, HoldoutKind::kFile);
  EXPECT_EQ(file.file, "C:/data/day:2.csv");
}

TEST(ParseHoldout, RefusesAnUnknownKindAndListsTheForms) {
  const std::string forms =
      "unknown; use every:K, groups:K[:repeats=R], sessions:K[:repeats=R], "
      "blocks:K, leave-one-group-out, kfold:K, forward:K[:gap=G], random:F, "
      "file:TEST.csv";
  for (const char* text : {"", ":", "evry:3", "Every:3", "every 3", "5"}) {
    ExpectParseError(text, forms);
  }
}

TEST(ParseHoldout, RefusesCountsThatAreNone) {
  for (const std::string kind :
       {"every", "groups", "sessions", "blocks", "kfold"}) {
    for (const std::string value : {"",
                                    "1",
                                    "0",
                                    "-3",
                                    "+3",
                                    " 3",
                                    "3 ",
                                    "2.5",
                                    "three",
                                    "1e3",
                                    "99999999999999999999",
                                    "2000000000"}) {
      ExpectParseError(
          kind + ":" + value,
          "K must be a whole number of at least 2, found '" + value + "'");
    }
    ExpectParseError(kind, "K must be a whole number of at least 2, found ''");
  }
  ExpectParseError("forward:0",
                   "K must be a whole number of at least 1, found '0'");
  ExpectParseError("forward",
                   "K must be a whole number of at least 1, found ''");
}

TEST(ParseHoldout, RefusesOptionsThatAKindDoesNotHave) {
  ExpectParseError("every:3:gap=1", "takes no option 'gap=1'");
  ExpectParseError("every:3:", "takes no option ''");
  ExpectParseError("kfold:3:repeats=2", "takes no option 'repeats=2'");
  ExpectParseError("random:0.2:seed=3", "takes no option 'seed=3'");
  ExpectParseError("leave-one-group-out:", "takes no options");
  ExpectParseError("leave-one-group-out:3", "takes no options");
  ExpectParseError("groups:5:gap=1",
                   "the only option is repeats=N, found 'gap=1'");
  ExpectParseError("groups:5:", "the only option is repeats=N, found ''");
  ExpectParseError("forward:5:repeats=2",
                   "the only option is gap=N, found 'repeats=2'");
}

TEST(ParseHoldout, RefusesOptionValuesOutOfRange) {
  ExpectParseError("groups:5:repeats=0",
                   "repeats must be a whole number of at least 1, found '0'");
  EXPECT_EQ(ParseHoldout("groups:5:repeats=1000").repeats, 1000);
  ExpectParseError("groups:5:repeats=1001",
                   "repeats must be at most 1000, found 1001");
  ExpectParseError("groups:5:repeats=",
                   "repeats must be a whole number of at least 1, found ''");
  ExpectParseError("groups:5:repeats=2:x",
                   "repeats must be a whole number of at least 1, found '2:x'");
  ExpectParseError("forward:5:gap=-1",
                   "gap must be a whole number of at least 0, found '-1'");
}

TEST(ParseHoldout, RefusesSharesOutsideZeroToOne) {
  for (const std::string value :
       {"", "0", "1", "-0.1", "1.5", "nan", "inf", "0,3", "0.3x", "third"}) {
    ExpectParseError(
        "random:" + value,
        "the test share must be above 0 and below 1, found '" + value + "'");
  }
}

TEST(ParseHoldout, RefusesAFileWithoutAName) {
  ExpectParseError("file:", "names no file; use file:TEST.csv");
  ExpectParseError("file", "names no file; use file:TEST.csv");
}

TEST(MakeFolds, EveryHoldsOutTheLastRowOfEachRunOfK) {
  const auto folds = Folds("every:3", 8);
  ASSERT_THAT(folds, SizeIs(1));
  EXPECT_THAT(folds[0].test, ElementsAre(2, 5));
  EXPECT_THAT(folds[0].train, ElementsAre(0, 1, 3, 4, 6, 7));
}

TEST(MakeFolds, EveryFollowsItsRuleForAllSizes) {
  for (Index k = 2; k <= 6; ++k) {
    for (Index rows = k; rows <= 20; ++rows) {
      const auto folds = Folds("every:" + std::to_string(k), rows);
      ASSERT_THAT(folds, SizeIs(1));
      ExpectSplitsAllRows(folds, rows);
      for (const Index row : folds[0].test) EXPECT_EQ(row % k, k - 1);
      EXPECT_EQ(static_cast<Index>(folds[0].test.size()), rows / k);
    }
  }
}

TEST(MakeFolds, GroupsCutsRunsWithLongerRunsFirst) {
  // Seven groups in three runs: 3, 2, 2.
  const auto folds = Folds("groups:3", 7, RangeOf(7));
  EXPECT_THAT(TestRows(folds),
              ElementsAre(Rows{0, 1, 2}, Rows{3, 4}, Rows{5, 6}));
  EXPECT_THAT(
      TrainRows(folds),
      ElementsAre(Rows{3, 4, 5, 6}, Rows{0, 1, 2, 5, 6}, Rows{0, 1, 2, 3, 4}));
  // Eight in three: 3, 3, 2.
  EXPECT_THAT(TestRows(Folds("groups:3", 8, RangeOf(8))),
              ElementsAre(Rows{0, 1, 2}, Rows{3, 4, 5}, Rows{6, 7}));
}

TEST(MakeFolds, GroupsTakesGroupsInTheOrderOfTheirCodesNotOfTheRows) {
  const Rows codes = {2, 0, 1, 2, 0, 3};
  const auto folds = Folds("groups:2", 6, codes);
  EXPECT_THAT(TestRows(folds), ElementsAre(Rows{1, 2, 4}, Rows{0, 3, 5}));
  ExpectKeepsGroupsWhole(folds, codes);
}

TEST(MakeFolds, GroupsCountsGroupsNotRows) {
  // One long group is one run all the same.
  const Rows codes = {0, 0, 0, 0, 0, 0, 1, 2, 3};
  EXPECT_THAT(TestRows(Folds("groups:2", 9, codes)),
              ElementsAre(Rows{0, 1, 2, 3, 4, 5, 6}, Rows{7, 8}));
}

TEST(MakeFolds, GroupsDoesNotDependOnTheSeed) {
  const Rows codes = EqualGroupsInHoldout(10, 3);
  EXPECT_EQ(TestRows(Folds("groups:4", 30, codes, 1)),
            TestRows(Folds("groups:4", 30, codes, 2)));
}

TEST(MakeFolds, CodesThatNoRowHasArePassedOver) {
  const Rows gaps = {7, 7, 2, 40, 40, 11};
  const Rows dense = {1, 1, 0, 3, 3, 2};
  for (const std::string text : {"groups:3",
                                 "groups:2:repeats=3",
                                 "leave-one-group-out",
                                 "forward:2",
                                 "forward:2:gap=1"}) {
    const auto with_gaps = Folds(text, 6, gaps);
    const auto without = Folds(text, 6, dense);
    EXPECT_EQ(TestRows(with_gaps), TestRows(without)) << text;
    EXPECT_EQ(TrainRows(with_gaps), TrainRows(without)) << text;
  }
  EXPECT_THAT(TestRows(Folds("groups:2", 6, gaps)),
              ElementsAre(Rows{0, 1, 2}, Rows{3, 4, 5}));
}

TEST(MakeFolds, GroupsMayBeAsManyAsRuns) {
  const Rows codes = EqualGroupsInHoldout(4, 2);
  EXPECT_EQ(TestRows(Folds("groups:4", 8, codes)),
            TestRows(Folds("leave-one-group-out", 8, codes)));
}

TEST(MakeFolds, LeaveOneGroupOutHoldsOutEachInItsOrder) {
  const Rows codes = {1, 0, 1, 2};
  const auto folds = Folds("leave-one-group-out", 4, codes);
  EXPECT_THAT(TestRows(folds), ElementsAre(Rows{1}, Rows{0, 2}, Rows{3}));
  ExpectSplitsAllRows(folds, 4);
}

// Reference: mt19937_64 seeded with 1, Fisher-Yates from the last element down
// with draw % bound (draws below 2^64 mod bound are discarded), the shuffled
// order cut into runs; by an independent program of thirty lines in Python.
TEST(MakeFolds, ShufflesAreTheSameWithEveryStandardLibrary) {
  EXPECT_THAT(TestRows(Folds("kfold:3", 8)),
              ElementsAre(Rows{3, 4, 6}, Rows{1, 5, 7}, Rows{0, 2}));
  EXPECT_THAT(TestRows(Folds("random:0.3", 10)), ElementsAre(Rows{1, 3, 7}));
  EXPECT_THAT(
      TestRows(Folds("groups:2:repeats=2", 5, RangeOf(5))),
      ElementsAre(Rows{0, 1, 4}, Rows{2, 3}, Rows{0, 2, 3}, Rows{1, 4}));
}

TEST(MakeFolds, EachRepeatHoldsOutEveryGroupOnce) {
  constexpr std::size_t kRepeats = 6;
  constexpr std::size_t kRuns = 3;
  const Rows codes = EqualGroupsInHoldout(8, 3);
  const auto folds = Folds("groups:3:repeats=6", 24, codes);
  ASSERT_THAT(folds, SizeIs(kRepeats * kRuns));
  ExpectSplitsAllRows(folds, 24);
  ExpectKeepsGroupsWhole(folds, codes);
  std::set<std::vector<Rows>> cuts;
  for (std::size_t repeat = 0; repeat < kRepeats; ++repeat) {
    ExpectTestsPartitionRows(folds, repeat * kRuns, kRuns, 24);
    // 8 groups in 3 runs: 3, 3, 2 groups of three rows.
    EXPECT_THAT(folds[repeat * kRuns].test, SizeIs(9));
    EXPECT_THAT(folds[repeat * kRuns + 1].test, SizeIs(9));
    EXPECT_THAT(folds[repeat * kRuns + 2].test, SizeIs(6));
    cuts.insert({folds[repeat * kRuns].test, folds[repeat * kRuns + 1].test});
  }
  EXPECT_GT(cuts.size(), 1U) << "every repeat made the same cut";
}

TEST(MakeFolds, KFoldHoldsOutEachRowOnceInRunsOfEqualSize) {
  for (Index k = 2; k <= 7; ++k) {
    for (Index rows = k; rows <= 25; rows += 3) {
      const auto folds = Folds("kfold:" + std::to_string(k), rows);
      ASSERT_EQ(static_cast<Index>(folds.size()), k);
      ExpectSplitsAllRows(folds, rows);
      ExpectTestsPartitionRows(folds, 0, folds.size(), rows);
      for (Index fold = 0; fold < k; ++fold) {
        const auto& test = folds[static_cast<std::size_t>(fold)].test;
        EXPECT_EQ(static_cast<Index>(test.size()),
                  rows / k + (fold < rows % k ? 1 : 0));
      }
    }
  }
}

TEST(MakeFolds, KFoldIsAboutRowsEvenWhereThereAreGroups) {
  EXPECT_EQ(TestRows(Folds("kfold:3", 12, EqualGroupsInHoldout(2, 6))),
            TestRows(Folds("kfold:3", 12)));
}

TEST(MakeFolds, RandomHoldsOutTheShareAskedFor) {
  for (const auto& [text, rows, expected] :
       std::vector<std::tuple<std::string, Index, std::size_t>>{
           {"random:0.25", 100, 25},
           {"random:0.3", 10, 3},
           {"random:0.5", 5, 3},       // 2.5 is rounded up
           {"random:0.333", 9, 3}}) {  // 2.997
    const auto folds = Folds(text, rows);
    ASSERT_THAT(folds, SizeIs(1));
    EXPECT_THAT(folds[0].test, SizeIs(expected)) << text;
    ExpectSplitsAllRows(folds, rows);
  }
}

TEST(MakeFolds, SameSeedSameFoldsAnotherSeedOthers) {
  const Rows codes = EqualGroupsInHoldout(20, 5);
  for (const std::string text :
       {"kfold:5", "random:0.3", "groups:4:repeats=2"}) {
    const auto first = Folds(text, 100, codes, 17);
    const auto again = Folds(text, 100, codes, 17);
    const auto other = Folds(text, 100, codes, 18);
    EXPECT_EQ(TestRows(first), TestRows(again)) << text;
    EXPECT_EQ(TrainRows(first), TrainRows(again)) << text;
    EXPECT_NE(TestRows(first), TestRows(other)) << text;
  }
}

TEST(MakeFolds, ForwardPredictsEachBlockFromAllBeforeIt) {
  // Seven groups in four blocks: 2, 2, 2, 1.
  const auto folds = Folds("forward:3", 7, RangeOf(7));
  EXPECT_THAT(
      TrainRows(folds),
      ElementsAre(Rows{0, 1}, Rows{0, 1, 2, 3}, Rows{0, 1, 2, 3, 4, 5}));
  EXPECT_THAT(TestRows(folds), ElementsAre(Rows{2, 3}, Rows{4, 5}, Rows{6}));
}

TEST(MakeFolds, ForwardLeavesTheLastGroupsBeforeTheTestOut) {
  const Rows codes = EqualGroupsInHoldout(6, 2);
  const auto folds = Folds("forward:2:gap=1", 12, codes);
  EXPECT_THAT(TrainRows(folds),
              ElementsAre(Rows{0, 1}, Rows{0, 1, 2, 3, 4, 5}));
  EXPECT_THAT(TestRows(folds),
              ElementsAre(Rows{4, 5, 6, 7}, Rows{8, 9, 10, 11}));
  ExpectKeepsGroupsWhole(folds, codes);
}

TEST(MakeFolds, ForwardTakesRowsWhereThereAreNoGroups) {
  const auto folds = Folds("forward:2:gap=1", 9);
  EXPECT_THAT(TrainRows(folds), ElementsAre(Rows{0, 1}, Rows{0, 1, 2, 3, 4}));
  EXPECT_THAT(TestRows(folds), ElementsAre(Rows{3, 4, 5}, Rows{6, 7, 8}));
}

TEST(MakeFolds, ForwardNeverTrainsOnALaterGroup) {
  const Rows codes = {4, 2, 0, 1, 3, 2, 0, 4, 1, 3};
  for (const std::string text : {"forward:1", "forward:2", "forward:4"}) {
    for (const Fold& fold : Folds(text, 10, codes)) {
      ExpectSound(fold, 10);
      Index last_trained = -1;
      for (const Index row : fold.train) {
        last_trained =
            std::max(last_trained, codes[static_cast<std::size_t>(row)]);
      }
      for (const Index row : fold.test) {
        EXPECT_GT(codes[static_cast<std::size_t>(row)], last_trained) << text;
      }
    }
  }
}

TEST(MakeFolds, FileTrainsOnEveryRowAndTestsNoneHere) {
  const auto folds = Folds("file:other.csv", 4);
  ASSERT_THAT(folds, SizeIs(1));
  EXPECT_THAT(folds[0].train, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(folds[0].test, IsEmpty());
}

TEST(MakeFolds, RefusesGroupsWhereThereAreNone) {
  for (const std::string text :
       {"groups:5", "groups:5:repeats=2", "leave-one-group-out"}) {
    ExpectRefused(text,
                  10,
                  {},
                  "there are no groups; give the code of each row's, or hold "
                  "out rows (every:3, kfold:5)");
  }
}

TEST(MakeFolds, RefusesMoreRunsThanGroupsAndSaysWhatIsPossible) {
  ExpectRefused("groups:5",
                6,
                EqualGroupsInHoldout(3, 2),
                "needs at least 5 groups, found 3; groups:3 or "
                "leave-one-group-out is possible");
  // Codes without rows are not groups.
  ExpectRefused(
      "groups:3", 4, {0, 9, 9, 0}, "needs at least 3 groups, found 2");
  for (const std::string text : {"groups:2", "leave-one-group-out"}) {
    ExpectRefused(text,
                  3,
                  {0, 0, 0},
                  "needs at least 2 groups, found 1; with one group only rows "
                  "can be held out (every:3, kfold:5), which says nothing "
                  "about another day");
  }
}

TEST(MakeFolds, HoldsOutSessionsAsGroups) {
  const Rows codes = EqualGroupsInHoldout(7, 3);
  EXPECT_EQ(TestRows(Folds("sessions:5", 21, codes)),
            TestRows(Folds("groups:5", 21, codes)));
  EXPECT_EQ(TestRows(Folds("sessions:3:repeats=4", 21, codes)),
            TestRows(Folds("groups:3:repeats=4", 21, codes)));
  ExpectRefused("sessions:5",
                6,
                EqualGroupsInHoldout(3, 2),
                "needs at least 5 sessions, found 3; sessions:3 is possible");
  ExpectRefused("sessions:2",
                3,
                {0, 0, 0},
                "needs at least 2 sessions, found 1; of one run only groups or "
                "rows can be held out (groups:5, blocks:5), which says nothing "
                "about another day");
  ExpectRefused("sessions:2",
                3,
                {},
                "found 0; give the code of each row's, or hold out rows "
                "(blocks:5)");
}

TEST(MakeFolds, HoldsOutContiguousBlocksLongerFirst) {
  EXPECT_THAT(
      TestRows(Folds("blocks:3", 8)),
      ElementsAre(
          ElementsAre(0, 1, 2), ElementsAre(3, 4, 5), ElementsAre(6, 7)));
  // Whatever the groups.
  EXPECT_EQ(TestRows(Folds("blocks:3", 8, {0, 1, 0, 1, 0, 1, 0, 1})),
            TestRows(Folds("blocks:3", 8)));
  ExpectRefused(
      "blocks:4",
      3,
      {},
      "needs at least 4 rows, found 3; measure more, or use a smaller K");
}

TEST(KeepsWhole, SeesACodeOnBothSides) {
  const Rows codes = EqualGroupsInHoldout(4, 2);
  EXPECT_TRUE(KeepsWhole(Folds("groups:2", 8, codes), codes));
  EXPECT_TRUE(KeepsWhole(Folds("blocks:4", 8), codes));
  EXPECT_FALSE(KeepsWhole(Folds("blocks:3", 8), codes));
  EXPECT_FALSE(KeepsWhole(Folds("every:2", 8), codes));
}

TEST(MakeFolds, RefusesMoreFoldsThanRows) {
  ExpectRefused(
      "every:4",
      3,
      {},
      "needs at least 4 rows, found 3; measure more, or use a smaller K");
  ExpectRefused(
      "kfold:4",
      3,
      {},
      "needs at least 4 rows, found 3; measure more, or use a smaller K");
  ExpectRefused(
      "forward:3",
      3,
      {},
      "needs at least 4 rows, found 3; measure more, or use a smaller K");
  ExpectRefused(
      "forward:3",
      6,
      EqualGroupsInHoldout(3, 2),
      "needs at least 4 groups, found 3; measure more, or use a smaller K");
}

TEST(MakeFolds, RefusesAGapThatLeavesNothingToTrainOn) {
  ExpectRefused("forward:2:gap=2",
                6,
                RangeOf(6),
                "fold 1 has 2 groups or rows before it and a gap of 2 leaves "
                "none to train on; use a smaller gap or fewer blocks");
  EXPECT_NO_THROW(Folds("forward:2:gap=1", 6, RangeOf(6)));
}

TEST(MakeFolds, RefusesAnEmptySide) {
  ExpectRefused("random:0.01",
                10,
                {},
                "leaves no rows to test out of 10; use another hold-out or "
                "more data");
  ExpectRefused("random:0.99", 10, {}, "leaves no rows to train on out of 10");
  ExpectRefused("random:0.5", 1, {}, "leaves no rows to train on out of 1");
  ExpectRefused("random:0.5", 0, {}, "leaves no rows to train on out of 0");
  ExpectRefused("file:a.csv", 0, {}, "leaves no rows to train on out of 0");
}

TEST(MakeFolds, RefusesCodesOfAnotherLength) {
  EXPECT_THAT(
      [] {
        Folds("every:2", 3, {0, 1});
      },
      ThrowsMessage<std::invalid_argument>(
          "MakeFolds: 2 group codes for 3 rows"));
}

}  // namespace
}  // namespace errmap::stats
