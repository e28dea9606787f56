#include "cli/netcg/report_study.h"

#include <filesystem>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/turning_centre/simulation_files.h"
#include "data/files/atomic_file.h"
#include "data/input_error.h"
#include "tests/cli/cli_runner.h"

namespace errmap::netcg {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
namespace fs = std::filesystem;

class ReportStudy : public ::testing::Test {
 protected:
  ReportStudy() {
    turning_centre::SimulationOptions options;
    options.days = 1;
    options.dead = {3, 20};
    const auto simulation = turning_centre::Simulate(options);
    for (const char* file :
         {"x_displacement_down.csv", "x_displacement_up.csv"}) {
      data::WriteFileAtomically(
          folder_ / file, turning_centre::SimulationFile(simulation, {}, file));
    }
  }

  ScratchFolder folder_;
};

TEST_F(ReportStudy, RunsTheNineExperimentsWhateverTheJobs) {
  NetcgStudyOptions options;
  options.iterations = 4;
  options.jobs = 1;
  const NetcgStudy study = RunReportStudy(folder_.path(), options);
  ASSERT_EQ(study.runs.size(), 9U);
  std::vector<std::size_t> thermocouples;
  std::vector<Eigen::Index> patterns;
  std::vector<int> implied;  // by the report's weights
  for (const NetcgStudyRun& run : study.runs) {
    thermocouples.push_back(run.thermocouples.size());
    patterns.push_back(run.record.specification.patterns);
    implied.push_back(run.report.implied_thermocouples());
  }
  EXPECT_THAT(implied, ElementsAre(40, 36, 35, 8, 14, 7, 12, 36, 36));
  // 3 and 20 are dead: 20 is Z-related, and failed in the report's upward run.
  EXPECT_THAT(thermocouples, ElementsAre(40, 35, 34, 8, 13, 7, 12, 35, 35));
  EXPECT_THAT(patterns,
              ElementsAre(397, 397, 298, 397, 397, 298, 298, 397, 397));
  const std::string text = StudyText(study);
  EXPECT_THAT(text, HasSubstr("thermocouples 3, 20 are dead in "));
  EXPECT_THAT(text,
              HasSubstr("run 5: 13 thermocouples here, 14 in the report"));
  EXPECT_THAT(text,
              HasSubstr("run 4: Table 4 prints 6 thermocouples and 6 input "
                        "nodes; its 661 weights are those of 8 and 9"));
  options.jobs = 3;
  const NetcgStudy again = RunReportStudy(folder_.path(), options);
  for (std::size_t i = 0; i < study.runs.size(); ++i) {
    EXPECT_EQ(study.runs[i].record.result.weights,
              again.runs[i].record.result.weights);
  }
}

TEST_F(ReportStudy, WritesARunFileThatGivesTheSameAgain) {
  NetcgStudyOptions options;
  options.iterations = 3;
  options.netcg.out = folder_ / "out";
  const NetcgStudy study = RunReportStudy(folder_.path(), options);
  fs::create_directory(options.netcg.out);
  std::map<std::string, std::string> contents;
  for (const NetcgOutputFile& file : study.files) {
    contents[file.path] = file.content;
    if (file.path.ends_with(".in") || file.path.ends_with(".pat")) {
      data::WriteFileAtomically(file.path, file.content);
    }
  }
  const auto records = RunNetcgFile(options.netcg.out + "/netcg.in", {});
  ASSERT_EQ(records.size(), study.runs.size());
  for (const NetcgRecord& record : records) {
    const NetcgOutputFile& report = record.files.front();
    EXPECT_EQ(report.content, contents.at(report.path));
  }
}

TEST_F(ReportStudy, NamesWhatIsMissing) {
  EXPECT_THAT([&] { RunReportStudy(folder_ / "no", {}); },
              ThrowsMessage<data::InputError>(
                  HasSubstr("x_displacement_down.csv: cannot be read")));
  data::WriteFileAtomically(folder_ / "x_displacement_up.csv",
                            "day,position_mm,t00_degC,error_mm\n1,2,3,4\n"
                            "1,3,4,5\n1,4,5,6\n");
  EXPECT_THAT([&] { RunReportStudy(folder_.path(), {}); },
              ThrowsMessage<data::InputError>(
                  HasSubstr("x_displacement_up.csv: line 1: no column 't01")));
}

}  // namespace
}  // namespace errmap::netcg
