#include "data/measurements/merged_log.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "data/measurements/dataset.h"

namespace errmap::data {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// Four readings of an error at 0, 10, 20 and 30 s, with decimal points.
PreparedDataset MadeWith(const std::string& log) {
  CsvTable table = ParseCsv("time_s,error_um\n0,1.5\n10,2.5\n20,3.5\n30,5.5\n",
                            "errors.csv");
  MergeLog(ParseCsv(log, "log.csv"), {}, &table);
  return MakeDataset(table, {});
}

TEST(MergeLog, TakesTheLastReadingOfALogOfItsOwnDecimals) {
  const PreparedDataset prepared =
      MadeWith("time_s;t_degC\n0;20,5\n10;21,5\n20;22,5\n30;24,5\n");
  EXPECT_THAT(prepared.dataset.input_values().col(0),
              ElementsAre(20.5, 21.5, 22.5, 24.5));
}

TEST(MergeLog, RefusesALogThatMixesDecimalMarks) {
  EXPECT_THAT(
      [] {
        MadeWith(
            "time_s;t1_degC;t2_degC\n0;20,5;20.5\n10;21,5;21.5\n"
            "20;22,5;22.5\n30;24,5;24.5\n");
      },
      ThrowsMessage<InputError>(HasSubstr("decimal comma (20,5)")));
}

}  // namespace
}  // namespace errmap::data
