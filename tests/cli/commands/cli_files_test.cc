#include "tests/cli/cli_fixture.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// Days as people have them: a file each.
class CliFiles : public Cli {
 protected:
  CliFiles() {
    std::filesystem::create_directories(scratch_ / "days");
    for (int day = 1; day <= 3; ++day) {
      Write("days/x_2024-03-0" + std::to_string(day) + ".csv", Day(day, true));
    }
    Write("today.csv", Day(4, true));
  }

  // Errors follow a lagging state, so that maps with a memory are worth it.
  static std::string Day(int day, bool in_um) {
    std::string text = in_um ? "time_s,position_mm,t1_degC,error_um\n"
                             : "time_s,position_mm,T1_K,error_mm\n";
    double state = 0.0;
    for (int i = 0; i < 40; ++i) {
      const double t = 20.0 + day % 2 + 0.1 * day + 3.0 * (i % 20) / 20.0;
      state += 0.2 * (t - 20.0 - state);
      const double error = 4.0 * state + 0.1 * (i % 7);
      text += std::to_string(300 * i) + "," + std::to_string(i % 8 * 10) + "," +
              std::to_string(in_um ? t : t + 273.15) + "," +
              std::to_string(in_um ? error : error / 1000.0) + "\n";
    }
    return text;
  }

  Json Compare(std::vector<std::string> data) const {
    data.insert(data.begin(), "compare");
    data.insert(data.end(),
                {"--models", "mean,poly:ridge:view=auto", "--format", "json"});
    return RunJson(data);
  }
};

TEST_F(CliFiles, AFolderAndItsFilesAreTheSameDays) {
  const Json by_folder = Compare({"days"});
  const Json data = by_folder["components"][0]["data"];
  EXPECT_EQ(data["rows"], 120);
  EXPECT_EQ(data["sessions"], 3);
  EXPECT_EQ(data["session"], "file");
  EXPECT_EQ(by_folder["provenance"]["inputs"].size(), 3U);
  const Json by_files = Compare({"days/x_2024-03-02.csv",
                                 "days/x_2024-03-01.csv",
                                 "days/x_2024-03-03.csv"});
  EXPECT_EQ(
      by_files["components"][0]["models"][1]["results"]["sessions:3"]["test"],
      by_folder["components"][0]["models"][1]["results"]["sessions:3"]["test"]);
}

TEST_F(CliFiles, AMapOfFilesTakesTheNextFileForADay) {
  ASSERT_EQ(Run({"fit",
                 "days",
                 "--model",
                 "poly:ridge:view=auto",
                 "-o",
                 "map.json",
                 "--quiet"})
                .status,
            0);
  const Json provenance = Json::parse(Read("map.json"))["provenance"];
  EXPECT_EQ(provenance["data"], "days/x_2024-03-01.csv");
  EXPECT_EQ(provenance["data_3"], "days/x_2024-03-03.csv");
  const Json one =
      RunJson({"evaluate", "map.json", "today.csv", "--format", "json"});
  EXPECT_LT(one["summary"]["rmse"].get<double>(), 2.0);
  EXPECT_EQ(RunJson({"evaluate",
                     "map.json",
                     "today.csv",
                     "days",
                     "--format",
                     "json"})["summary"]["n"],
            160);
  const Outcome predicted = Run({"predict", "map.json", "today.csv"});
  EXPECT_EQ(predicted.status, 0) << predicted.err;
  EXPECT_THAT(predicted.out, Not(HasSubstr("start")));
  EXPECT_EQ(Run({"check", "map.json", "today.csv", "--quiet"}).status, 0);
  // What went before is of the same day.
  const std::vector<std::string> lines = SplitLines(Read("today.csv"));
  std::string morning = lines[0] + "\n";
  std::string noon = morning;
  for (std::size_t row = 1; row < lines.size(); ++row) {
    (row < lines.size() / 2 ? morning : noon) += lines[row] + "\n";
  }
  Write("morning.csv", morning);
  Write("noon.csv", noon);
  EXPECT_THAT(
      Run({"predict", "map.json", "noon.csv", "--after", "morning.csv"}).err,
      Not(HasSubstr("changes nothing")));
}

TEST_F(CliFiles, DifferencesAreSaidAndContradictionsRefused) {
  Write("days/x_2024-03-04.csv", Day(4, false));
  const Outcome said = Run({"compare", "days", "--models", "mean"});
  EXPECT_EQ(said.status, 0) << said.err;
  EXPECT_THAT(said.err,
              AllOf(HasSubstr("'T1_K' is read as 't1_degC', from K to degC"),
                    HasSubstr("'error_mm' is read as 'error_um', from mm")));
  Write("other.csv", "position_mm,error_y_um\n1,2\n2,3\n");
  EXPECT_THAT(
      RefusalOf(Run({"compare", "today.csv", "other.csv"}), kUnusable),
      HasSubstr("other.csv: no column 'error_um', which today.csv has"));
  EXPECT_THAT(RefusalOf(Run({"compare", "today.csv", "today.csv"}), kUnusable),
              HasSubstr("is named twice"));
}

TEST_F(CliFiles, AStudyFileMayNameSeveral) {
  Write("study.toml",
        "models = [\"mean\"]\n[[component]]\nname = \"x\"\ndata = "
        "[\"days/x_2024-03-01.csv\", \"today.csv\"]\n");
  const Json study =
      RunJson({"compare", "--config", "study.toml", "--format", "json"});
  EXPECT_EQ(study["components"][0]["data"]["sessions"], 2);
}

TEST_F(CliFiles, NextCommandsNameAllFiles) {
  const Outcome outcome = Run({"compare",
                               "today.csv",
                               "days/x_2024-03-01.csv",
                               "--models",
                               "mean,poly:position"});
  EXPECT_THAT(outcome.out,
              HasSubstr("errmap fit today.csv days/x_2024-03-01.csv"));
}

}  // namespace
}  // namespace errmap
