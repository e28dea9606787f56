#include "cli/fleet/store/component_summary.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/fleet/run/fleet_run.h"
#include "data/input_error.h"

namespace errmap::fleet {
namespace {

using ::testing::HasSubstr;

ComponentSummary Large(int models) {
  ComponentSummary summary;
  summary.name = "m01/x";
  summary.status = ModelStatus::kOk;
  summary.recommendation.emplace().model = "poly:7";
  summary.recommendation->holdout = "groups:5";
  for (int i = 0; i < models; ++i) {
    SummaryModelRecord& model = summary.models.emplace_back();
    model.name = "poly:" + std::to_string(i);
    model.status = ModelStatus::kOk;
    SummaryMetricsRecord& result = model.results.emplace_back();
    result.holdout = "groups:5";
    result.rmse = 1.0 / (3.0 + i);
    result.tier = 1;
  }
  return summary;
}

TEST(ComponentSummary, ReadsBackWhatItWrote) {
  const ComponentSummary summary = Large(3);
  EXPECT_TRUE(models::Same(SummaryFromJsonText(ToJsonText(summary)), summary));
}

TEST(ComponentSummary, LeavesOutTheWorstModelsWhereThereIsNoRoom) {
  const std::string text = ToJsonText(Large(300));
  EXPECT_LE(text.size(), kLongestSummary);
  const ComponentSummary read = SummaryFromJsonText(text);
  ASSERT_GT(read.models.size(), 40U);
  EXPECT_EQ(read.models_left_out + std::ssize(read.models), 300);
  EXPECT_EQ(read.models.front().name, "poly:7");
  EXPECT_EQ(read.models[1].name, "poly:299");
}

TEST(ComponentSummary, RefusesWhatIsNone) {
  for (const char* text : {"", "{}", "[]", R"({"schema": "other"})"}) {
    EXPECT_THROW(SummaryFromJsonText(text), data::InputError) << text;
  }
}

TEST(Share, DealsEveryNameOnceAndEvenly) {
  constexpr int kNames = 4000;
  constexpr int kShares = 8;
  std::vector<int> dealt(kShares, 0);
  for (int i = 0; i < kNames; ++i) {
    int owners = 0;
    for (int share = 0; share < kShares; ++share) {
      if (!Share{.index = share, .count = kShares}.Has("machine " +
                                                       std::to_string(i))) {
        continue;
      }
      ++owners;
      ++dealt[static_cast<std::size_t>(share)];
    }
    EXPECT_EQ(owners, 1);
  }
  for (const int count : dealt) EXPECT_NEAR(count, kNames / kShares, 80);
}

// The deal is part of the contract: stores are filled by shares over days.
TEST(Share, DealsAsItAlwaysDid) {
  EXPECT_TRUE((Share{.index = 0, .count = 8}.Has("m01/x_displacement, down")));
}

}  // namespace
}  // namespace errmap::fleet
