#include "models/inner_folds.h"

#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/models/history/history_data.h"

namespace errmap::models {
namespace {

using Eigen::Index;

// Groups of these sizes in order, numbered `step` apart as after a selection of
// rows; no groups where `sizes` is empty.
data::Dataset Grouped(const std::vector<Index>& sizes,
                      Index rows_without_groups = 0) {
  data::Dataset::Parts parts;
  parts.source = "grouped";
  parts.inputs = {{"position_mm", {}}};
  parts.target = {"error_mm", {}};
  constexpr Index kStep = 3;
  for (std::size_t group = 0; group < sizes.size(); ++group) {
    parts.groups.column = "day";
    for (Index i = 0; i < kStep; ++i) parts.groups.labels.push_back("d");
    for (Index i = 0; i < sizes[group]; ++i) {
      parts.groups.codes.push_back(kStep * static_cast<Index>(group));
    }
  }
  const Index rows = sizes.empty()
                         ? rows_without_groups
                         : static_cast<Index>(parts.groups.codes.size());
  parts.input_values = Eigen::MatrixXd::Zero(rows, 1);
  parts.target_values = Eigen::VectorXd::LinSpaced(rows, 0.0, 1.0);
  return data::Dataset(std::move(parts));
}

TEST(TypicalError, IsTheMeanSquareWhereFoldsAreNoSessions) {
  const Eigen::Vector3d squares(1.0, 4.0, 9.0);
  const Eigen::Vector3d rows(2.0, 1.0, 1.0);
  const InnerError error = TypicalError({}, squares, rows, 0.02);
  EXPECT_DOUBLE_EQ(error.mean_square, 15.0 / 4.0);
  // sqrt(sum share (square - mean)^2 / (folds - 1))
  EXPECT_DOUBLE_EQ(error.standard_error, std::sqrt(171.0 / 16.0 / 2.0));
  EXPECT_TRUE(std::isnan(TypicalError({},
                                      Eigen::VectorXd::Constant(1, 4.0),
                                      Eigen::VectorXd::Constant(1, 3.0),
                                      0.0)
                             .standard_error));
}

TEST(TypicalError, OfSessionsIsNotDecidedByTheOneThatIsFarFromAllOthers) {
  InnerFolds folds;
  folds.whole_sessions = true;
  const Eigen::Vector4d rows(10.0, 10.0, 10.0, 10.0);
  // A map that is good on three days of four, and one that is good on none.
  const Eigen::Vector4d good(0.1, 0.1, 0.1, 9.0);
  const Eigen::Vector4d poor(2.0, 2.0, 2.0, 2.0);
  const auto error = [&](const Eigen::Vector4d& squares) {
    return TypicalError(folds, squares, rows, 0.0).mean_square;
  };
  EXPECT_NEAR(error(good), std::pow(0.1 * 0.1 * 0.1 * 9.0, 0.25), 1e-15);
  EXPECT_LT(error(good), error(poor));
  EXPECT_GT(good.mean(), poor.mean());
  // In other units of length the choice is the same.
  EXPECT_NEAR(error(1e6 * good), 1e6 * error(good), 1e-9);
}

TEST(TypicalError, OfASessionWithoutErrorStopsAtTheIndifference) {
  InnerFolds folds;
  folds.whole_sessions = true;
  const Eigen::Vector2d rows(5.0, 5.0);
  const double none =
      TypicalError(folds, Eigen::Vector2d(0.0, 1.0), rows, 0.1).mean_square;
  const double little =
      TypicalError(folds, Eigen::Vector2d(1e-9, 1.0), rows, 0.1).mean_square;
  EXPECT_NEAR(none, std::sqrt(0.01 * 1.01), 1e-15);
  EXPECT_NEAR(little, none, 1e-8);
}

TEST(InnerFolds, FollowTheKindOfHoldOutOutside) {
  const data::Dataset days = Grouped({4, 4, 4, 4, 4, 4, 4});
  const data::Dataset rows = Grouped({}, 30);
  const auto text = [](const data::Dataset& dataset, InnerHoldout kind) {
    return MakeInnerFolds(dataset, {.inner_holdout = kind}).text;
  };
  EXPECT_EQ(text(days, InnerHoldout::kWholeGroups), "groups:5 of day");
  EXPECT_EQ(text(days, InnerHoldout::kRows), "kfold:5");
  EXPECT_EQ(text(days, InnerHoldout::kForward), "forward:4 of day");
  EXPECT_EQ(text(days, InnerHoldout::kBlocks), "blocks:5");
  EXPECT_EQ(text(rows, InnerHoldout::kWholeGroups), "blocks:5");
  EXPECT_EQ(text(rows, InnerHoldout::kWholeSessions), "blocks:5");
  EXPECT_EQ(text(rows, InnerHoldout::kRows), "kfold:5");
  EXPECT_EQ(text(rows, InnerHoldout::kForward), "forward:4");
  // What a fit uses unless told otherwise.
  EXPECT_EQ(MakeInnerFolds(days, {}).text, "groups:5 of day");
}

TEST(InnerFolds, KeepEveryGroupOnOneSide) {
  for (const std::vector<Index>& sizes :
       {std::vector<Index>{1, 1},
        {7, 1, 30},
        {5, 5, 5, 5, 5, 5},
        {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}}) {
    const data::Dataset dataset = Grouped(sizes);
    for (const InnerHoldout kind :
         {InnerHoldout::kWholeGroups, InnerHoldout::kForward}) {
      const InnerFolds inner = MakeInnerFolds(dataset, {.inner_holdout = kind});
      std::map<Index, std::set<Index>> folds_of;
      for (std::size_t i = 0; i < inner.folds.codes.size(); ++i) {
        folds_of[dataset.groups().codes[i]].insert(inner.folds.codes[i]);
      }
      for (const auto& [group, folds] : folds_of) EXPECT_EQ(folds.size(), 1U);
      for (Index fold = inner.folds.first_judged(); fold < inner.folds.count();
           ++fold) {
        const auto [train, test] = inner.folds.Split(fold);
        EXPECT_FALSE(train.empty());
        EXPECT_FALSE(test.empty());
        for (const Index a : train) {
          for (const Index b : test) {
            const auto& codes = dataset.groups().codes;
            const Index of_train = codes[static_cast<std::size_t>(a)];
            const Index of_test = codes[static_cast<std::size_t>(b)];
            EXPECT_NE(of_train, of_test);
            if (kind == InnerHoldout::kForward) {
              EXPECT_LT(of_train, of_test);
            }
          }
        }
      }
    }
  }
}

TEST(InnerFolds, DealWholeGroupsInTurnWhereAskedTo) {
  const data::Dataset cycles = Grouped({2, 1, 3, 1, 1, 2, 1});
  const FitContext by_groups{.inner_holdout = InnerHoldout::kWholeGroups};
  const InnerFolds inner =
      MakeInnerFolds(cycles, by_groups, GroupDeal::kInTurn);
  EXPECT_TRUE(inner.in_turn);
  EXPECT_EQ(inner.text, "groups:5 of day");
  EXPECT_EQ(inner.folds.codes,
            (std::vector<Index>{0, 0, 1, 2, 2, 2, 3, 4, 0, 0, 1}));
  EXPECT_FALSE(MakeInnerFolds(cycles, by_groups).in_turn);
  // What is to hold on another day is chosen on runs.
  EXPECT_FALSE(MakeInnerFolds(cycles, {}, GroupDeal::kInTurn).in_turn);
}

TEST(InnerFolds, HoldOutBlocksWhereThereIsOneGroup) {
  EXPECT_EQ(MakeInnerFolds(Grouped({20}), {}).text, "blocks:5");
  EXPECT_EQ(MakeInnerFolds(Grouped({}, 3), {}).text, "blocks:3");
}

// Sessions of 10 rows, each of two groups.
data::Dataset OfSessions(Index sessions) {
  std::vector<Index> codes;
  for (Index row = 0; row < 10 * sessions; ++row) codes.push_back(row / 10);
  const Index rows = 10 * sessions;
  const data::Dataset dataset =
      errmap::testing::WithLog({{"position_mm", {}}},
                               Eigen::MatrixXd::Zero(rows, 1),
                               Eigen::VectorXd::LinSpaced(rows, 0.0, 1.0),
                               codes);
  data::Dataset::Parts parts;
  parts.inputs = dataset.inputs();
  parts.input_values = dataset.input_values();
  parts.target = dataset.target();
  parts.target_values = dataset.target_values();
  parts.groups.column = "cycle";
  for (Index row = 0; row < rows; ++row) {
    parts.groups.codes.push_back(row / 5);
    parts.groups.labels.push_back("c");
  }
  parts.log = dataset.log();
  parts.log_rows = dataset.log_rows();
  return data::Dataset(std::move(parts));
}

TEST(InnerFolds, HoldOutSessionsWhereTheyDecide) {
  const auto text = [](Index sessions, InnerHoldout kind) {
    return MakeInnerFolds(OfSessions(sessions), {.inner_holdout = kind}).text;
  };
  EXPECT_EQ(text(7, InnerHoldout::kDecisive), "sessions:5 of day");
  EXPECT_EQ(text(4, InnerHoldout::kDecisive), "sessions:4 of day");
  EXPECT_EQ(text(3, InnerHoldout::kDecisive), "groups:5 of cycle");
  EXPECT_EQ(text(3, InnerHoldout::kWholeSessions), "sessions:3 of day");
  EXPECT_EQ(text(1, InnerHoldout::kWholeSessions), "groups:2 of cycle");
  EXPECT_EQ(text(7, InnerHoldout::kWholeGroups), "groups:5 of cycle");
  const InnerFolds inner = MakeInnerFolds(OfSessions(4), {});
  for (std::size_t row = 0; row < inner.folds.codes.size(); ++row) {
    EXPECT_EQ(inner.folds.codes[row], static_cast<Index>(row / 10));
  }
}

TEST(InnerFolds, NeedTwoRows) {
  EXPECT_THROW(MakeInnerFolds(Grouped({}, 1), {}), std::invalid_argument);
  EXPECT_THROW(
      MakeInnerFolds(Grouped({1}), {.inner_holdout = InnerHoldout::kForward}),
      std::invalid_argument);
}

}  // namespace
}  // namespace errmap::models
