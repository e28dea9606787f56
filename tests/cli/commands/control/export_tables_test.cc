// Compensation tables, read back by the rules of who uses them.

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "tests/cli/cli_fixture.h"

namespace errmap {
namespace {

using ::testing::HasSubstr;

// What LinuxCNC 2.9 was measured to do with a COMP_FILE of type 0: three
// numbers a line, a line that is none ends the reading, ascending, at most
// 256; it adds nominal - column, linear between the points and constant beyond
// the ends; the forward column holds where the position increases.
class LinuxcncReader {
 public:
  explicit LinuxcncReader(const std::string& text) {
    std::istringstream lines(text);
    double nominal = 0.0;
    double forward = 0.0;
    double reverse = 0.0;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream numbers(line);
      if (!(numbers >> nominal >> forward >> reverse)) break;
      if (!nominals_.empty() && !(nominal > nominals_.back())) break;
      nominals_.push_back(nominal);
      added_[0].push_back(nominal - forward);
      added_[1].push_back(nominal - reverse);
    }
  }

  std::size_t size() const { return nominals_.size(); }
  const std::vector<double>& nominals() const { return nominals_; }

  double Added(double position, bool increasing) const {
    const std::vector<double>& added = added_[increasing ? 0 : 1];
    if (position <= nominals_.front()) return added.front();
    if (position >= nominals_.back()) return added.back();
    const auto above = static_cast<std::size_t>(
        std::ranges::upper_bound(nominals_, position) - nominals_.begin());
    const double share = (position - nominals_[above - 1]) /
                         (nominals_[above] - nominals_[above - 1]);
    return added[above - 1] + share * (added[above] - added[above - 1]);
  }

 private:
  std::vector<double> nominals_;
  std::vector<double> added_[2];
};

std::vector<double> Column(const data::CsvTable& table,
                           const std::string& name) {
  const std::ptrdiff_t index = table.Find(name);
  EXPECT_GE(index, 0) << name;
  return table.columns[static_cast<std::size_t>(index)].values;
}

// RMS of the error left in a file's rows when the table is applied.
double LeftOver(const LinuxcncReader& table,
                const std::string& csv,
                bool increasing) {
  const data::CsvTable rows = data::ReadCsv(csv);
  const std::vector<double> position = Column(rows, "position_mm");
  const std::vector<double> error = Column(rows, "error_mm");
  double sum = 0.0;
  for (std::size_t i = 0; i < error.size(); ++i) {
    sum += std::pow(error[i] + table.Added(position[i], increasing), 2.0);
  }
  return std::sqrt(sum / static_cast<double>(error.size()));
}

class CliExportTables : public Cli {
 protected:
  // The slide moves towards increasing positions in the files `up`.
  void SetUp() override {
    ASSERT_EQ(Run({"simulate",
                   "turning-centre",
                   "-o",
                   "sim",
                   "--days",
                   "1",
                   "--cycles",
                   "3",
                   "--quiet"})
                  .status,
              0);
    for (const char* direction : {"up", "down"}) {
      const Outcome outcome = Run({"fit",
                                   File(direction),
                                   "--model",
                                   "poly:formula=position_mm+position_mm^2+"
                                   "t12_degC",
                                   "--inputs",
                                   "position_mm,t12_degC",
                                   "-o",
                                   std::string(direction) + ".json",
                                   "--no-interval",
                                   "--quiet"});
      ASSERT_EQ(outcome.status, 0) << outcome.err;
    }
  }

  static std::string File(const std::string& direction) {
    return "sim/x_displacement_" + direction + ".csv";
  }
  std::string Path(const std::string& name) const {
    return (scratch_ / name).string();
  }

  Outcome Linuxcnc(const std::vector<std::string>& more) const {
    std::vector<std::string> words{"export", "--linuxcnc", "-o", "x.comp.txt"};
    words.insert(words.end(), more.begin(), more.end());
    return Run(words);
  }

  // The map's error at these positions, one thermocouple at `t12`.
  std::vector<double> Predicted(const std::string& model,
                                const std::vector<double>& positions,
                                double t12) const {
    std::string csv = "position_mm,t12_degC\n";
    for (const double position : positions) {
      csv += fmt::format("{},{}\n", position, t12);
    }
    Write("points.csv", csv);
    return Column(data::ParseCsv(Run({"predict", model, "points.csv"}).out, ""),
                  "predicted");
  }
};

TEST_F(CliExportTables, GivesLinuxcncEachDirectionItsColumn) {
  const Outcome outcome =
      Linuxcnc({"--increasing", "up.json", "--decreasing", "down.json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(
      outcome.err,
      HasSubstr("forward column (position increases): up.json; reverse: "
                "down.json"));
  const LinuxcncReader right(Read("x.comp.txt"));
  ASSERT_EQ(
      Linuxcnc({"--increasing", "down.json", "--decreasing", "up.json"}).status,
      0);
  const LinuxcncReader wrong(Read("x.comp.txt"));
  for (const bool increasing : {true, false}) {
    const std::string csv = Path(File(increasing ? "up" : "down"));
    // Before: 13 to 18 um. Two thirds of what remains is thermal.
    EXPECT_LT(LeftOver(right, csv, increasing), 0.0010);
    EXPECT_GT(LeftOver(wrong, csv, increasing),
              2.0 * LeftOver(right, csv, increasing));
  }
}

TEST_F(CliExportTables, KeepsTheInterpolationErrorThatItPrints) {
  const Outcome outcome = Linuxcnc({"--increasing",
                                    "up.json",
                                    "--decreasing",
                                    "down.json",
                                    "--at",
                                    "t12_degC=24.5",
                                    "--points",
                                    "12"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const LinuxcncReader table(Read("x.comp.txt"));
  EXPECT_EQ(table.size(), 12);
  EXPECT_TRUE(std::ranges::is_sorted(table.nominals()));
  std::vector<double> positions;
  for (int i = 0; i <= 500; ++i) {
    positions.push_back(-215.9 + i * (215.9 - 12.7) / 500.0);
  }
  const std::string before = "it is off by up to ";
  const double printed =
      std::stod(outcome.err.substr(outcome.err.find(before) + before.size())) /
      kUmPerMm;
  EXPECT_LT(printed, 0.00005);
  constexpr double kDigits = 1.01;  // three are printed
  for (const bool increasing : {true, false}) {
    const std::vector<double> errors =
        Predicted(increasing ? "up.json" : "down.json", positions, 24.5);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      EXPECT_NEAR(
          table.Added(positions[i], increasing), -errors[i], kDigits * printed);
    }
  }
}

TEST_F(CliExportTables, SaysWhatStepsLose) {
  const Outcome outcome = Linuxcnc({"up.json", "--resolution", "0.001"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.err, HasSubstr("up.json fills both columns"));
  EXPECT_THAT(
      outcome.err,
      ::testing::ContainsRegex("in steps of 0.001 mm by up to 0.(49|50)"));
  const LinuxcncReader table(Read("x.comp.txt"));
  EXPECT_LE(table.size(), 256);
  for (const double nominal : table.nominals()) {
    const double steps = table.Added(nominal, true) / 0.001;
    EXPECT_NEAR(steps, std::round(steps), 1e-6);
  }
}

TEST_F(CliExportTables, KeepsToTheLargestOffsetAndSaysWhere) {
  constexpr double kMost = 0.005;
  constexpr double kRounding = 1e-12;
  const Outcome outcome = Linuxcnc({"up.json", "--max-offset", "5um"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err,
              HasSubstr("errors forward: at most 5.00 um, reached in "));
  const LinuxcncReader table(Read("x.comp.txt"));
  double largest = 0.0;
  for (const double nominal : table.nominals()) {
    largest = std::max(largest, std::fabs(table.Added(nominal, true)));
  }
  EXPECT_NEAR(largest, kMost, kRounding);
  // In steps of 2 um the limit lies between two of them.
  ASSERT_EQ(
      Linuxcnc({"up.json", "--max-offset", "5um", "--resolution", "0.002"})
          .status,
      0);
  const LinuxcncReader steps(Read("x.comp.txt"));
  for (const double nominal : steps.nominals()) {
    EXPECT_LT(std::fabs(steps.Added(nominal, true)), 0.0041);
  }
  EXPECT_THAT(Linuxcnc({"up.json"}).err, HasSubstr("nowhere reached"));

  const Outcome grid =
      Run({"export", "up.json", "--table", "-o", ".", "--max-offset", "5um"});
  ASSERT_EQ(grid.status, 0) << grid.err;
  EXPECT_THAT(grid.err, HasSubstr("at most 5.00 um, reached in "));
  EXPECT_THAT(Read("up.csv"), HasSubstr("at most 0.005 in size"));
  for (const data::CsvColumn& column : data::ReadCsv(Path("up.csv")).columns) {
    if (column.name == "position_mm") continue;
    for (const double value : column.values) {
      EXPECT_LE(std::fabs(value), kMost + kRounding);
    }
  }
  EXPECT_THAT(
      RefusalOf(Linuxcnc({"up.json", "--max-rate", "1um"}), kWrongCommandLine),
      HasSubstr("--max-rate is for programs"));
}

TEST_F(CliExportTables, RefusesAMapOfTheOtherDirection) {
  for (const char* direction : {"up", "down"}) {
    const std::string file = std::string(direction) + ".json";
    Json map = Json::parse(Read(file));
    map["where"] = Json::array({{{"column", "way"}, {"text", direction}}});
    WriteMapFile(file, map);
  }
  EXPECT_EQ(
      Linuxcnc({"--increasing", "up.json", "--decreasing", "down.json"}).status,
      0);
  EXPECT_THAT(
      RefusalOf(
          Linuxcnc({"--increasing", "down.json", "--decreasing", "up.json"}),
          kUnusable),
      HasSubstr("down.json: it is made for way down; exchange --increasing and "
                "--decreasing"));
  const std::string alone =
      "up.json: it is made for way up alone and would act in the other "
      "direction, too; name the maps of both, --increasing and --decreasing";
  EXPECT_THAT(RefusalOf(Linuxcnc({"up.json"}), kUnusable), HasSubstr(alone));
  EXPECT_THAT(RefusalOf(Linuxcnc({"--increasing", "up.json"}), kUnusable),
              HasSubstr(alone));
  for (const char* language : {"--c", "--st", "--python", "--hal"}) {
    EXPECT_THAT(
        RefusalOf(Run({"export", "up.json", language, "-o", "."}), kUnusable),
        HasSubstr(alone));
  }
  for (const bool right : {true, false}) {
    const Outcome outcome = Run({"export",
                                 "--increasing",
                                 right ? "up.json" : "down.json",
                                 "--decreasing",
                                 right ? "down.json" : "up.json",
                                 "--hal",
                                 "-o",
                                 "."});
    if (right) {
      EXPECT_EQ(outcome.status, 0) << outcome.err;
      EXPECT_THAT(outcome.err, HasSubstr("the second while it decreases"));
      EXPECT_THAT(Read("errmap_up.comp"),
                  HasSubstr("Two maps: the first acts"));
    } else {
      EXPECT_THAT(RefusalOf(outcome, kUnusable), HasSubstr("exchange"));
    }
  }
  // A grid acts by whoever enters it, and says what it is for.
  EXPECT_THAT(Run({"export", "up.json", "--table", "-o", "."}).err,
              HasSubstr("for way up"));
  EXPECT_THAT(Read("up.csv"), HasSubstr("; for way up"));
}

TEST_F(CliExportTables, WritesInches) {
  ASSERT_EQ(Linuxcnc({"up.json", "--at", "t12_degC=24"}).status, 0);
  const LinuxcncReader in_mm(Read("x.comp.txt"));
  ASSERT_EQ(
      Linuxcnc({"up.json", "--at", "t12_degC=24", "--units", "in"}).status, 0);
  const LinuxcncReader in_inches(Read("x.comp.txt"));
  EXPECT_NEAR(in_inches.Added(-100.0 / 25.4, true) * 25.4,
              in_mm.Added(-100.0, true),
              1e-6);
}

TEST_F(CliExportTables, TakesTheStateThatASessionLeavesBehind) {
  const Outcome fit = Run({"fit",
                           File("up"),
                           "--model",
                           "poly:ridge:view=history",
                           "--inputs",
                           "position_mm,t12_degC",
                           "-o",
                           "memory.json",
                           "--no-interval",
                           "--quiet"});
  ASSERT_EQ(fit.status, 0) << fit.err;
  ASSERT_EQ(
      Linuxcnc({"memory.json", "--log", File("up"), "--row", "40"}).status, 0);
  const LinuxcncReader table(Read("x.comp.txt"));
  const data::CsvTable rows = data::ReadCsv(Path(File("up")));
  const std::vector<double> predicted = Column(
      data::ParseCsv(Run({"predict", "memory.json", File("up")}).out, ""),
      "predicted");
  EXPECT_NEAR(
      table.Added(Column(rows, "position_mm")[40], true), -predicted[40], 1e-6);
  EXPECT_THAT(
      RefusalOf(Linuxcnc({"memory.json", "--log", File("up"), "--row", "400"}),
                kWrongCommandLine),
      HasSubstr("has 51 rows"));
}

TEST_F(CliExportTables, WritesAGridThatReducesTheError) {
  const Outcome outcome = Run({"export", "up.json", "--table", "-o", "."});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(Read("up.csv"),
              ::testing::StartsWith("# compensation = -error in mm"));
  EXPECT_THAT(outcome.err, HasSubstr("between its points it is off by up to"));
  const data::CsvTable grid = data::ReadCsv(Path("up.csv"));
  ASSERT_EQ(grid.num_rows, 33);
  ASSERT_EQ(grid.columns.size(), 10);
  EXPECT_EQ(grid.columns[0].name, "position_mm");
  const std::string name = grid.columns[4].name;
  ASSERT_TRUE(name.starts_with("t12_degC=")) << name;
  const double t12 = std::stod(name.substr(name.find('=') + 1));
  const std::vector<double> errors =
      Predicted("up.json", grid.columns[0].values, t12);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    EXPECT_NEAR(grid.columns[4].values[i], -errors[i], 1e-15);
  }
}

TEST_F(CliExportTables, RefusesWhatIsNoTable) {
  ASSERT_EQ(Run({"fit",
                 File("up"),
                 "--model",
                 "mean",
                 "-o",
                 "mean.json",
                 "--no-interval",
                 "--quiet"})
                .status,
            0);
  EXPECT_THAT(RefusalOf(Linuxcnc({"mean.json"}), kUnusable),
              HasSubstr("mean.json: it reads no position"));
  EXPECT_THAT(
      RefusalOf(Linuxcnc({"up.json", "--at", "t13_degC=3"}), kWrongCommandLine),
      HasSubstr("no input 't13_degC' beside the position; is it t12_degC?"));
  EXPECT_THAT(
      RefusalOf(Linuxcnc({"up.json", "--at", "t12_degC"}), kWrongCommandLine),
      HasSubstr("is not NAME=VALUE"));
  EXPECT_THAT(RefusalOf(Linuxcnc({}), kWrongCommandLine),
              HasSubstr("--increasing FILE.json and --decreasing"));
  EXPECT_THAT(
      RefusalOf(Run({"export", "--linuxcnc", "up.json", "-o", "no/x.txt"}),
                kFailure),
      HasSubstr("no/x.txt"));
  for (const char* grid : {"9", "1x9", "3x4abc", "33x123456"}) {
    EXPECT_THAT(
        RefusalOf(
            Run({"export", "up.json", "--table", "-o", ".", "--grid", grid}),
            kWrongCommandLine),
        HasSubstr("--grid takes ROWSxCOLUMNS"));
  }
  Json angle = Json::parse(Read("up.json"));
  angle["target"] = {{"name", "error_urad"}, {"unit", "urad"}};
  WriteMapFile("angle.json", angle);
  EXPECT_THAT(
      RefusalOf(Linuxcnc({"angle.json"}), kUnusable),
      HasSubstr("'error_urad' is not a length that can be written in mm"));
}

}  // namespace
}  // namespace errmap
