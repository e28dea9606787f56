#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/report/report.h"
#include "cli/report/tables/report_tables.h"
#include "tests/cli/report/report_document.h"

namespace errmap::report {
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

TEST(LeaderboardRows, CarryTheAnswerInOneUnit) {
  const models::StudyRecord record = Recorded(MakeReportDocument());
  const std::string csv = CsvTable(LeaderboardRows(record));
  EXPECT_THAT(csv,
              HasSubstr(",test_ci95_low,test_ci95_high,interchangeable,gap,"
                        "sensors,goal,established,unit\n"));
  EXPECT_THAT(csv, HasSubstr(",no,,1,no,,mm\n"));
  EXPECT_THAT(MarkdownTable(LeaderboardRows(record)), HasSubstr("| um |"));
}

TEST(TerminalLeaderboard, StandsByTheDecisiveErrorAndMarksTheRecommended) {
  const models::StudyRecord record = Recorded(MakeReportDocument());
  const ReportView view = ViewOf(record.components[0]);
  const Table table = TerminalLeaderboard(view, 12);
  const std::vector<std::string> lines = TerminalLines(table, 80);
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_THAT(lines[1], StartsWith("  model     sensors  "));
  EXPECT_THAT(lines[2], StartsWith("= mean "));
  EXPECT_THAT(lines[3], StartsWith("* poly:eq8 "));
  EXPECT_THAT(lines[4], StartsWith("  net:scg "));
  EXPECT_EQ(table.marked, 1U);
}

TEST(TerminalLeaderboard, HeadsTheSecondErrorByWhatIsHeldOut) {
  models::StudyRecord record = Recorded(MakeReportDocument());
  models::ComponentRecord& component = record.components[0];
  const ReportView view = ViewOf(component);
  ASSERT_FALSE(view.neighbours.empty());
  for (models::HoldoutRecord& holdout : component.holdouts) {
    if (holdout.name == view.neighbours) holdout.among_neighbours = true;
  }
  EXPECT_EQ(TerminalLeaderboard(view, 12).columns[4].name, "neighbours");
  for (models::HoldoutRecord& holdout : component.holdouts) {
    holdout.among_neighbours = false;
  }
  EXPECT_EQ(TerminalLeaderboard(view, 12).columns[4].name, "held-out rows");
}

// Where so few units could never show a difference, p says nothing of it.
TEST(CorrectedP, IsNothingWhereTheUnitsAreTooFew) {
  models::PairRecord pair;
  pair.p_holm = 1.0;
  pair.smallest_p = 0.03;
  pair.holm_pairs = 1;
  EXPECT_EQ(Table().Shown(CorrectedP(pair)), "1.0000");
  pair.holm_pairs = 2;
  EXPECT_EQ(Table().Shown(CorrectedP(pair)), "-");
}

TEST(StandInWords, NameWhatTheLineOverATemperatureReadsWithoutOne) {
  models::StudyRecord record = Recorded(MakeReportDocument());
  models::ComponentRecord& component = record.components[0];
  EXPECT_EQ(StandInWords(ViewOf(component), 99), "");
  models::ModelRecord& model = component.models[0];
  model.name = "poly:temperature";
  model.inputs_used = {"elapsed_cycles"};
  model.sensors = std::vector<std::string>{};
  EXPECT_EQ(StandInWords(ViewOf(component), 0), "");
  EXPECT_EQ(StandInWords(ViewOf(component), 99),
            "poly:temperature is a line over elapsed_cycles, as there is no "
            "thermometer.");
  model.inputs_used = {"t1_degC"};
  model.sensors = {"t1_degC"};
  EXPECT_EQ(StandInWords(ViewOf(component), 99), "");
}

TEST(TerminalLeaderboard, AlwaysHoldsTheRecommended) {
  const models::StudyRecord record = Recorded(MakeReportDocument());
  const Table table = TerminalLeaderboard(ViewOf(record.components[0]), 1);
  EXPECT_EQ(table.rows.size(), 1U);
  EXPECT_EQ(table.marked, 0U);
}

TEST(ErrorTextOf, TakesRoundingsForNoError) {
  models::StudyRecord record = Recorded(MakeReportDocument());
  models::ComponentRecord& component = record.components[0];
  const std::string before = ErrorTextOf(component)(0.0012345);
  models::ModelRecord& net = component.models.back();
  for (auto& [holdout, result] : net.results) result.test.rmse = 1e-17;
  EXPECT_EQ(ErrorTextOf(component)(0.0012345), before);
}

TEST(DrawnRowsWords, NameWhatLearntFromAPart) {
  models::StudyRecord record = Recorded(MakeReportDocument());
  models::ComponentRecord& component = record.components[0];
  EXPECT_EQ(DrawnRowsWords(ViewOf(component)), "");
  component.data.rows = 28560;
  component.models[2].final->choices =
      models::ByName<models::OptionValue>{{"rows", std::int64_t{19992}}};
  const std::string words =
      "net:scg trained on 19992 of 28560 rows (rows=all uses all).";
  EXPECT_EQ(DrawnRowsWords(ViewOf(component)), words);
  std::string screen = ScreenText(record, 1000);
  std::ranges::replace(screen, '\n', ' ');
  EXPECT_THAT(screen, HasSubstr(words));
  EXPECT_THAT(PageLeaderboard(ViewOf(component)).note, StartsWith(words));
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
  EXPECT_THAT(row_of(TerminalLeaderboard(ViewOf(component), 12), 0),
              HasSubstr(" 1.900 1.520-2.470 "));
  EXPECT_THAT(row_of(PageLeaderboard(ViewOf(component)), 0),
              HasSubstr(" 1.900 (1.520 to 2.470) 1.200 no "));
}

}  // namespace
}  // namespace errmap::report
