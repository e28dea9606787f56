#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/report/tables/report_tables.h"
#include "tests/cli/report/report_document.h"

namespace errmap::report {
namespace {

using ::testing::HasSubstr;

// A row per model: what stands under a name.
std::vector<std::string> ShownUnder(const Table& table,
                                    const std::string& name) {
  const auto at = std::ranges::find(table.columns, name, &Table::Column::name) -
                  table.columns.begin();
  std::vector<std::string> shown;
  for (const std::vector<Cell>& row : table.rows) {
    shown.push_back(table.Shown(row.at(static_cast<std::size_t>(at))));
  }
  return shown;
}

TEST(RunTable, HasErrorsOfTheScaledTargetOnly) {
  models::StudyRecord record = Recorded(MakeReportDocument());
  models::ComponentRecord& component = record.components[0];
  auto& direct = component.models[1].final->summary.value;
  direct.iterations = 0;
  direct.initial_cost = models::kNotKnown;
  direct.final_cost = 5000.0;
  const Table table = RunTable(ViewOf(component));
  EXPECT_THAT(ShownUnder(table, "sqrt(2 E) first"),
              ::testing::ElementsAre("1", "-", "1"));
  EXPECT_THAT(ShownUnder(table, "sqrt(2 E) last"),
              ::testing::ElementsAre("0.04472", "-", "0.04472"));
}

TEST(StartTable, HasARowPerStart) {
  const models::StudyRecord record = Recorded(MakeReportDocument());
  const Table table = StartTable(ViewOf(record.components[0]));
  EXPECT_THAT(ShownUnder(table, "chosen"),
              ::testing::ElementsAre("yes", "no", "no", "no", "no"));
  EXPECT_THAT(CsvTable(table), HasSubstr("net:scg"));
}

}  // namespace
}  // namespace errmap::report
