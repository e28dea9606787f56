// MakeDataset of data/measurements/dataset.h: targets, weights and units.

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/data/measurements/make_dataset_test_data.h"

namespace errmap::data {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(MakeDataset, WeightsOfAnySizeAreTheSame) {
  const auto weights = [](const std::string& first, const std::string& second) {
    return Make("a,w,error\n1," + first + ",3\n2," + second + ",5\n",
                {.weight = "w"})
        .dataset.weights();
  };
  EXPECT_EQ(weights("0.5", "1.5"), Eigen::Vector2d(0.5, 1.5));
  EXPECT_EQ(weights("0.5e308", "1.5e308"), weights("1", "3"));
  EXPECT_EQ(weights("1e-300", "3e-300"), weights("1", "3"));
  EXPECT_EQ(weights("0.1", "0.1"), Eigen::Vector2d(1.0, 1.0));
  EXPECT_THAT(ErrorOf("a,w,error\n1,1e-10,3\n2,1e25,5\n", {.weight = "w"}),
              AllOf(HasSubstr("line 2 (data row 0), column 'w': weight 1e-10"),
                    HasSubstr("less than 1e-30 of the largest")));
}

TEST(MakeDataset, RefusesTargetsWhoseSquaresCannotBeSummed) {
  for (const char* size : {"e160", "e101", "e-101", "e-170"}) {
    const std::string text =
        std::string("a,error\n1,1") + size + "\n2,-2" + size + "\n3,0" + "\n";
    EXPECT_THAT(ErrorOf(text),
                AllOf(HasSubstr("line 3 (data row 1), column 'error'"),
                      HasSubstr("-2" + std::string(size).replace(
                                           0, 1, size[1] == '-' ? "e" : "e+")),
                      HasSubstr("choose another unit")));
  }
  EXPECT_EQ(Make("a,error\n1,1e99\n2,0\n").dataset.num_rows(), 2);
}

TEST(MakeDataset, RefusesInputsWhoseSquaresCannotBeSummed) {
  const std::string text = "a,b,error\n1,2,1\n-2e200,3,2\n3,5,4\n4,7,9\n";
  EXPECT_THAT(ErrorOf(text),
              AllOf(HasSubstr("line 3 (data row 1), column 'a'"),
                    HasSubstr("the largest input, -2e+200"),
                    HasSubstr("choose another unit")));
  EXPECT_EQ(
      Make(text, {.inputs = {}, .only_to_judge = true}).dataset.num_rows(), 4);
}

TEST(MakeDataset, ConstantTarget) {
  EXPECT_EQ(ErrorOf("a,error\n1,0.5\n2,0.5\n"),
            "f.csv: target 'error' is constant (0.5 in all 2 rows), so there "
            "is nothing to map; name another with target");
  EXPECT_THAT(
      ErrorOf("a,error\n1,1\n2,1\n,2\n", {.missing = MissingPolicy::kDropRows}),
      HasSubstr("is constant (1 in all 2 rows)"));
  EXPECT_THAT(ErrorOf("a,error\n1,1\n"), HasSubstr("has a single row"));
}

TEST(MakeDataset, WeightThatIsNotPositive) {
  EXPECT_EQ(ErrorOf("a,w,error\n1,1,1\n2,0,2\n", {.weight = "w"}),
            "f.csv: line 3 (data row 1), column 'w': weight 0 is not positive; "
            "correct it or remove the row");
}

TEST(MakeDataset, TakesRowsOnlyToJudgeAsTheyAre) {
  const PreparedDataset prepared =
      Make("a,b,error\n1,x,5\n1,,5\n",
           {.inputs = {}, .keep_dead = true, .only_to_judge = true});
  EXPECT_EQ(prepared.dataset.num_rows(), 2);
  EXPECT_EQ(prepared.dataset.num_inputs(), 0);
}

TEST(MakeDataset, RemarksOnErrorsThatNoMachineHas) {
  const auto remarks = [](const std::string& header, double scale) {
    return Make("a," + header + "\n1," + std::to_string(3.0 * scale) + "\n2," +
                std::to_string(4.0 * scale) + "\n")
        .remarks;
  };
  EXPECT_THAT(
      remarks("error_mm", 1.0),
      ElementsAre("error_mm is 3.54 mm RMS, more than errors of machine tools; "
                  "if it is in another unit, write that into its "
                  "name: error_um, 'error [mm]'"));
  EXPECT_THAT(remarks("error_um", 1e-3),
              ElementsAre(HasSubstr("0.00354 um RMS, less than")));
  EXPECT_THAT(remarks("error_um", 1.0), IsEmpty());
  EXPECT_THAT(remarks("error_um", 100.0), IsEmpty());
  EXPECT_THAT(remarks("error_mm", 1e-3), IsEmpty());
  EXPECT_THAT(remarks("error_arcsec", 1e5), IsEmpty());
}

TEST(MakeDataset, RemarksOnThermometersWithoutAUnitThatReadAsInDegF) {
  const auto remarks = [](const std::string& name, double first) {
    return Make(name + ",error_um\n" + std::to_string(first) + ",1\n" +
                std::to_string(first + 15.0) + ",2\n")
        .remarks;
  };
  EXPECT_THAT(
      remarks("T1", 68.0),
      ElementsAre(
          "readings of 'T1' look like degF, but have no unit; if they are, "
          "write it: 'T1 [degF]'"));
  EXPECT_THAT(remarks("Spindle temp", 70.0),
              ElementsAre(HasSubstr("like degF")));
  EXPECT_THAT(remarks("T1", 20.0), IsEmpty());
  EXPECT_THAT(remarks("T1", 140.0), IsEmpty());
  EXPECT_THAT(remarks("T1 [degC]", 68.0), IsEmpty());
  EXPECT_THAT(remarks("load", 68.0), IsEmpty());
}

TEST(MakeDataset, LeavesOutProbesThatAreCalledAsAxesAre) {
  // By `scale` larger than the error.
  const auto inputs = [](double scale) {
    std::string text = "X_um,T1,error_um\n";
    for (int i = 0; i < 12; ++i) {
      text += std::to_string(scale * (i * 5 % 12)) + "," +
              std::to_string(20 + i) + "," + std::to_string(i % 4) + "\n";
    }
    const PreparedDataset prepared = Make(text);
    std::vector<std::string> names;
    for (const ColumnInfo& input : prepared.dataset.inputs()) {
      names.push_back(input.name);
    }
    return names;
  };
  EXPECT_THAT(inputs(1.0), ElementsAre("T1"));
  EXPECT_THAT(inputs(1000.0), ElementsAre("X_um", "T1"));
}

TEST(MakeDataset, SaysWhichUnitOfTheTargetIsOnlyAssumed) {
  EXPECT_THAT(Make("a,error_x\n1,0.02\n2,0.03\n").remarks,
              ElementsAre("error_x: no unit in its name, taken as mm"));
}

TEST(MakeDataset, NamesInputsWhoseUnitIsNotRead) {
  EXPECT_THAT(
      Make("travel_m,T_in,error_um\n1,1,2\n2,0,3\n").remarks,
      ElementsAre("no unit is read from 'travel_m': 'm' counts as a unit "
                  "in brackets or parentheses only"));
}

TEST(MakeDataset, DropsRowsOfFailedReadingsWhereAsked) {
  std::string text = "a,w,error_mm\n";
  for (int i = 0; i < 20; ++i) {
    text += std::to_string(i % 7) + "," + std::to_string(1 + i) + "," +
            (i == 4 ? "9999" : std::to_string(i)) + "\n";
  }
  const PreparedDataset kept = Make(text, {.weight = "w"});
  EXPECT_EQ(kept.dataset.num_rows(), 20);
  ASSERT_EQ(kept.faults.size(), 1U);
  EXPECT_THAT(kept.faults[0].rows, ElementsAre(4));
  const PreparedDataset dropped =
      Make(text, {.weight = "w", .faults = FaultPolicy::kDropRows});
  EXPECT_EQ(dropped.dataset.num_rows(), 19);
  EXPECT_EQ(dropped.dataset.rows()[4], 5);
  EXPECT_EQ(dropped.dataset.weights()[4] / dropped.dataset.weights()[0], 6.0);
  EXPECT_EQ(dropped.dataset.target_values()[4], 5.0);
  EXPECT_EQ(dropped.faults.size(), 1U);
}

}  // namespace
}  // namespace errmap::data
