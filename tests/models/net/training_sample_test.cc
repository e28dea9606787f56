#include <algorithm>
#include <map>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/column_header.h"
#include "models/net/net_fit.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::Ge;
using ::testing::Le;

// `sizes` of the groups in order; none: no groups, `rows` rows.
data::Dataset RowsOfInTrainingSample(const std::vector<Index>& sizes,
                                     Index rows = 0) {
  data::Dataset::Parts parts;
  parts.source = "rows";
  parts.inputs = {{"t1_degC", data::UnitOfColumn("t1_degC")}};
  parts.target = {"error_mm", data::UnitOfColumn("error_mm")};
  if (!sizes.empty()) parts.groups.column = "cycle";
  for (std::size_t g = 0; g < sizes.size(); ++g) {
    parts.groups.labels.push_back(std::to_string(g));
    for (Index i = 0; i < sizes[g]; ++i) {
      parts.groups.codes.push_back(static_cast<Index>(g));
    }
    rows += sizes[g];
  }
  parts.input_values = Eigen::VectorXd::LinSpaced(rows, 0.0, 1.0);
  parts.target_values = Eigen::VectorXd::LinSpaced(rows, 0.0, 1.0);
  return data::Dataset(std::move(parts));
}

TEST(StratifiedRows, AreAllWhereTheyAreFew) {
  EXPECT_THAT(StratifiedRows(RowsOfInTrainingSample({}, 4), 4),
              ElementsAre(0, 1, 2, 3));
  EXPECT_THROW(StratifiedRows(RowsOfInTrainingSample({}, 4), 0),
               std::invalid_argument);
}

TEST(StratifiedRows, AreOneOfEachStretchOfRows) {
  const std::vector<Index> rows =
      StratifiedRows(RowsOfInTrainingSample({}, 1000), 100);
  ASSERT_EQ(rows.size(), 100U);
  std::map<Index, int> within;  // place in the stretch
  for (Index k = 0; k < 100; ++k) {
    EXPECT_EQ(rows[static_cast<std::size_t>(k)] / 10, k);
    ++within[rows[static_cast<std::size_t>(k)] % 10];
  }
  EXPECT_EQ(within.size(), 10U) << "no regular steps";
  EXPECT_EQ(rows, StratifiedRows(RowsOfInTrainingSample({}, 1000), 100));
}

TEST(StratifiedRows, AreWholeGroupsFromAllOverTheFile) {
  std::vector<Index> sizes;
  for (Index g = 0; g < 1000; ++g) sizes.push_back(5 + g % 7);
  const data::Dataset dataset = RowsOfInTrainingSample(sizes);
  constexpr Index kMost = 2000;
  const std::vector<Index> rows = StratifiedRows(dataset, kMost);
  EXPECT_THAT(rows.size(), Le(static_cast<std::size_t>(kMost)));
  EXPECT_THAT(rows.size(), Ge(static_cast<std::size_t>(kMost * 9 / 10)));
  EXPECT_TRUE(std::ranges::is_sorted(rows));
  std::map<Index, Index> taken;
  for (const Index row : rows) {
    ++taken[dataset.groups().codes[static_cast<std::size_t>(row)]];
  }
  std::vector<int> by_tenth(10);
  for (const auto& [group, count] : taken) {
    EXPECT_EQ(count, sizes[static_cast<std::size_t>(group)]) << "whole";
    ++by_tenth[static_cast<std::size_t>(group / 100)];
  }
  EXPECT_THAT(by_tenth, Each(Ge(20)));
}

TEST(StratifiedRows, TakeRowsOfEachGroupWhereFewGroupsWouldFit) {
  const data::Dataset dataset =
      RowsOfInTrainingSample(std::vector<Index>(20, 100));
  std::map<Index, int> taken;
  for (const Index row : StratifiedRows(dataset, 400)) ++taken[row / 100];
  EXPECT_EQ(taken.size(), 20U);
  for (const auto& [group, count] : taken) EXPECT_EQ(count, 20) << group;
}

}  // namespace
}  // namespace errmap::models
