#include "models/study/split_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/input_error.h"
#include "tests/models/model_test_data.h"
#include "tests/models/study/study_test_tools.h"

namespace errmap::models {
namespace {

using data::InputError;
using errmap::testing::MakeHoldouts;
using errmap::testing::MessageOf;
using errmap::testing::QuadraticData;
using errmap::testing::ShippedMeasurements;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string RefusalInSplitFile(const std::string& content) {
  return MessageOf<InputError>([&] {
    ReadSplitFile(data::ParseCsv(content, "split.csv"), QuadraticData(6));
  });
}

TEST(SplitFile, ReadsBackTheVeryFoldsThatWereWritten) {
  const data::Dataset dataset = ShippedMeasurements();
  const auto written = MakeHoldouts(
      dataset, {"every:3", "groups:5", "forward:3:gap=1", "random:0.3"});
  const auto read = ReadSplitFile(
      data::ParseCsv(SplitFileText(written, dataset), "split.csv"), dataset);
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t h = 0; h < written.size(); ++h) {
    EXPECT_EQ(read[h].name, written[h].name);
    EXPECT_EQ(read[h].whole_groups, written[h].whole_groups) << read[h].name;
    ASSERT_EQ(read[h].folds.size(), written[h].folds.size());
    for (std::size_t fold = 0; fold < written[h].folds.size(); ++fold) {
      EXPECT_EQ(read[h].folds[fold].train, written[h].folds[fold].train);
      EXPECT_EQ(read[h].folds[fold].test, written[h].folds[fold].test);
    }
  }
}

TEST(SplitFile, TakesRowsInAnyOrderAndLeavesOutUnusedOnes) {
  const auto holdouts = ReadSplitFile(
      data::ParseCsv("role,row,fold,holdout\n"
                     "test,5,0,mine\ntrain,2,0,mine\nunused,1,0,mine\n"
                     "train,0,0,mine\n",
                     "split.csv"),
      QuadraticData(6));
  ASSERT_EQ(holdouts.size(), 1u);
  EXPECT_EQ(holdouts[0].name, "mine");
  EXPECT_FALSE(holdouts[0].whole_groups);  // the data have no groups
  EXPECT_THAT(holdouts[0].folds[0].train, ElementsAre(0, 2));
  EXPECT_THAT(holdouts[0].folds[0].test, ElementsAre(5));
}

TEST(SplitFile, SaysWhatIsWrongWhere) {
  const std::string header = "row,holdout,fold,role\n";
  EXPECT_THAT(RefusalInSplitFile("row,fold,role\n0,0,train\n"),
              HasSubstr("no column 'holdout'"));
  EXPECT_THAT(RefusalInSplitFile(header + "9,a,0,train\n"),
              AllOf(HasSubstr("line 2"), HasSubstr("no data row 9")));
  EXPECT_THAT(RefusalInSplitFile(header + "1.5,a,0,train\n"),
              HasSubstr("'1.5' is not a whole number"));
  EXPECT_THAT(RefusalInSplitFile(header + "1,a,-1,train\n"),
              HasSubstr("'-1' is not a whole number"));
  EXPECT_THAT(RefusalInSplitFile(header + "1,a,0,exam\n"),
              HasSubstr("'exam' is none of train, test, unused"));
  EXPECT_THAT(RefusalInSplitFile(header + "1,a,0,train\n1,a,0,test\n"),
              HasSubstr("stands twice"));
  EXPECT_THAT(RefusalInSplitFile(header + "1,a,0,train\n"),
              HasSubstr("no test rows"));
  EXPECT_THAT(RefusalInSplitFile(header + "1,a,1,train\n2,a,1,test\n"),
              HasSubstr("no fold 0"));
}

}  // namespace
}  // namespace errmap::models
