#include "cli/report/result_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/report_document.h"

namespace errmap::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(LeaderboardRows, HasARowPerHoldoutAndModel) {
  const models::StudyRecord record = Recorded(MakeReportDocument());
  const Table table = LeaderboardRows(record);
  const models::ComponentRecord& component = record.components[0];
  EXPECT_EQ(table.rows.size(),
            component.holdouts.size() * component.models.size());
  EXPECT_THAT(CsvTable(table),
              StartsWith("component,holdout,model,kind,status,parameters,"
                         "test_n,test_rmse,"));
}

TEST(TerminalLeaderboard, SetsTheHoldoutsSideBySide) {
  const models::StudyRecord record = Recorded(MakeReportDocument());
  const std::string text =
      TerminalTable(TerminalLeaderboard(record.components[0]));
  EXPECT_THAT(text, HasSubstr("every:3"));
  EXPECT_THAT(text, HasSubstr("groups:5"));
  EXPECT_THAT(text, HasSubstr("\nmodel    params sens"));
}

// What the same model is said to have in each of the three tables.
TEST(ResultTables, AgreeWithEachOther) {
  const models::StudyRecord record = Recorded(MakeReportDocument());
  const models::ComponentRecord& component = record.components[0];
  const auto row_of = [](const Table& table, std::size_t at) {
    std::string text;
    for (const auto& row : table.rows) {
      if (table.Shown(row[at]) != "poly:eq8") continue;
      for (const Cell& cell : row) text += table.Shown(cell) + " ";
    }
    return text;
  };
  EXPECT_THAT(row_of(LeaderboardRows(record), 2), HasSubstr(" 1.9 "));
  EXPECT_THAT(row_of(TerminalLeaderboard(component), 0),
              HasSubstr(" 1.900 1.520-2.470 2 "));
  EXPECT_THAT(row_of(PageLeaderboard(ViewOf(component)), 0),
              HasSubstr(" 2 1.900 (1.520 to 2.470) "));
}

}  // namespace
}  // namespace errmap::cli
