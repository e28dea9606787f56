#include "cli/report/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/comparison/compare.h"
#include "tests/places.h"

namespace errmap::report {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

models::StudyRecord SmallRecord() {
  return MakeRecord(
      {models::CompareMaps(
          tests::SourceDir() + "/data/sets/nistir5367_xdisp_down.csv",
          {},
          {.models = {"mean", "poly:eq8"}, .seed = 7})},
      7);
}

TEST(Report, DrawsTheSameOfARecordThatWasReadAgain) {
  const models::StudyRecord record = SmallRecord();
  EXPECT_EQ(record.schema, models::kResultsSchema);
  EXPECT_EQ(record.seed, 7U);
  EXPECT_EQ(record.provenance.inputs.size(), 1U);
  EXPECT_THAT(record.provenance.compiler, HasSubstr("++"));
  const models::StudyRecord again =
      models::FromJsonText(models::ToJsonText(record));
  EXPECT_EQ(ReportHtml(again), ReportHtml(record));
  EXPECT_EQ(ReportMarkdown(again), ReportMarkdown(record));
  EXPECT_EQ(ScreenText(again, 100), ScreenText(record, 100));
  EXPECT_EQ(TableText(again, "csv"), TableText(record, "csv"));
  EXPECT_EQ(TableText(again, "md"), TableText(record, "md"));
}

TEST(Report, BeginsTheScreenWithTheVerdict) {
  const models::StudyRecord record = SmallRecord();
  const std::string verdict = VerdictText(record.components[0], 100);
  EXPECT_THAT(verdict, HasSubstr("poly:"));
  EXPECT_THAT(ScreenText(record, 100), HasSubstr("\n" + verdict + "\n"));
  EXPECT_THAT(*TableText(record, "csv"), HasSubstr("groups:5,poly:eq8"));
}

TEST(Report, SaysWhyNothingIsRecommended) {
  models::ComponentRecord nothing;
  EXPECT_THAT(VerdictText(nothing), HasSubstr("none could be judged"));
  nothing.interrupted = true;
  EXPECT_THAT(VerdictText(nothing), HasSubstr("interrupted"));
}

}  // namespace
}  // namespace errmap::report
