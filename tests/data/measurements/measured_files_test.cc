#include "data/measurements/measured_files.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/input_error.h"

namespace errmap::data {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

TEST(FindFiles, PutsFilesInTheOrderOfTheirDatesElseOfTheirNumbers) {
  EXPECT_THAT(FindFiles({"x_20240302.csv", "y_2024-03-01.csv"}).paths,
              ElementsAre("y_2024-03-01.csv", "x_20240302.csv"));
  EXPECT_THAT(FindFiles({"day1.csv", "day10.csv", "day2.csv"}).paths,
              ElementsAre("day1.csv", "day2.csv", "day10.csv"));
  // Somebody's own order.
  EXPECT_THAT(FindFiles({"monday.csv", "friday.csv"}).paths,
              ElementsAre("monday.csv", "friday.csv"));
}

TEST(FindFiles, RefusesAFileNamedTwiceAndBesideItsPackedSelf) {
  for (const char* again : {"./a.csv", "a.csv.gz"}) {
    EXPECT_THAT(
        [&] {
          FindFiles({"a.csv", again});
        },
        ThrowsMessage<InputError>(HasSubstr("is named twice")));
  }
}

TEST(FileLabel, IsTheDateElseTheName) {
  EXPECT_EQ(FileLabel("/logs/x_2024_03_01_night.csv.gz"), "2024-03-01");
  EXPECT_EQ(FileLabel("serial_20249999.csv"), "serial_20249999");
  EXPECT_EQ(FileLabel("n123456789.csv"), "n123456789");
  EXPECT_EQ(FileLabel("day.1.csv"), "day.1");
}

TEST(NamesOfFiles, CutsALongList) {
  EXPECT_EQ(NamesOfFiles({"a.csv"}), "a.csv");
  EXPECT_EQ(NamesOfFiles({"a", "b", "c"}), "a, b, c");
  EXPECT_EQ(NamesOfFiles({"a", "b", "c", "d"}), "a and 3 more");
}

class InFolder : public ::testing::Test {
 protected:
  InFolder() { std::filesystem::create_directories(folder_); }
  ~InFolder() override { std::filesystem::remove_all(folder_); }
  void Touch(const std::string& name) const {
    std::ofstream(folder_ + "/" + name);
  }

  std::string folder_ = ::testing::TempDir() + "/errmap_in_folder";
};

TEST_F(InFolder, TheTablesOfOneComponentAreItsDays) {
  for (const char* name : {"x_mon_10.csv",
                           "x_tue_9.csv",
                           "x_wed.lvm",
                           "x_thu.XLSM",
                           "notes.txt",
                           ".x.csv"}) {
    Touch(name);
  }
  const MeasuredFiles found = FindFiles({folder_});
  EXPECT_THAT(found.paths,
              ElementsAre(folder_ + "/x_mon_10.csv",
                          folder_ + "/x_thu.XLSM",
                          folder_ + "/x_tue_9.csv",
                          folder_ + "/x_wed.lvm"));
  EXPECT_THAT(found.remarks,
              ElementsAre(HasSubstr("left out, since they are no")));
}

TEST_F(InFolder, SeveralComponentsArePointedToInit) {
  Touch("x_down.csv");
  Touch("y_down.csv");
  EXPECT_THAT(
      [&] { FindFiles({folder_}); },
      ThrowsMessage<InputError>(HasSubstr("map each: errmap init " + folder_)));
}

// They would pass for measurements.
TEST_F(InFolder, AComparisonsResidualsAreNoMeasurements) {
  Touch("residuals.csv");
  EXPECT_THAT(FindFiles({folder_}).paths,
              ElementsAre(folder_ + "/residuals.csv"));
  Touch("results.json");
  EXPECT_THAT(
      [&] { FindFiles({folder_}); },
      ThrowsMessage<InputError>(HasSubstr("errmap report " + folder_ + " ")));
  EXPECT_THAT([&] { FindFiles({folder_ + "/residuals.csv"}); },
              ThrowsMessage<InputError>(HasSubstr("not measurements")));
  std::filesystem::create_directory(folder_ + "/residuals");
  Touch("residuals/x_down.csv");
  EXPECT_TRUE(IsOfComparison(folder_ + "/residuals/x_down.csv"));
  // What was measured may lie beside them (--out .).
  Touch("x_down.csv");
  EXPECT_THAT(FindFiles({folder_}).paths, ElementsAre(folder_ + "/x_down.csv"));
}

TEST(FindFiles, RefusesAStudyFile) {
  EXPECT_THAT([&] { FindFiles({"study.toml"}); },
              ThrowsMessage<InputError>(HasSubstr("a study file with config")));
}

TEST_F(InFolder, AFolderWithoutTablesIsRefused) {
  EXPECT_THAT(
      [&] { FindFiles({folder_}); },
      ThrowsMessage<InputError>(HasSubstr("a folder without CSV files")));
}

}  // namespace
}  // namespace errmap::data
