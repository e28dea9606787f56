#include "models/history/point_log.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"

namespace errmap::models {
namespace {

using ::testing::ElementsAre;

// Sessions that no column names are those of the map: a pause of an hour
// between readings of 10 s is none of their ends, a night is.
TEST(PointLog, PartsSessionsByNights) {
  History history;
  history.time_unit = "s";
  history.time = "time_s";
  std::string text = "time_s,t1_degC\n";
  for (const double begin : {0.0, 3700.0, 60000.0}) {
    for (int row = 0; row < 5; ++row) {
      text += data::CsvNumber(begin + 10.0 * row) + ",20\n";
    }
  }
  const data::CsvTable log = data::ParseCsv(text, "log.csv");
  const data::CsvTable points =
      data::ParseCsv("time_s,t1_degC\n3725,21\n60045,22\n", "points.csv");
  const MatrixXd of_log = MatrixXd::Constant(15, 1, 20.0);
  const MatrixXd of_points{{21.0}, {22.0}};
  const RowsForMap rows{log, of_log};
  const PointLog merged = MakePointLog(history, {points, of_points}, &rows, {});
  EXPECT_THAT(merged.rows, ElementsAre(8, 16));
  EXPECT_THAT(merged.log->sessions.codes,
              ElementsAre(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1));
}

}  // namespace
}  // namespace errmap::models
