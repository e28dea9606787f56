#include "cli/turning_centre/simulation_files.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "data/files/atomic_file.h"
#include "data/measurements/dataset.h"
#include "tests/places.h"

namespace errmap::turning_centre {
namespace {

using data::CsvTable;
using data::MakeDataset;
using data::ParseCsv;
using data::PreparedDataset;
using data::ReadFile;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

constexpr int kDays = 2;
constexpr int kCycles = 4;

const Simulation& Small() {
  static const Simulation simulation =
      Simulate({.days = kDays, .cycles = kCycles, .dead = {3, 4, 16, 19}});
  return simulation;
}

CsvTable Table(const std::string& name, const FileOptions& options = {}) {
  return ParseCsv(SimulationFile(Small(), options, name), name);
}

std::vector<double> ColumnInSimulationFiles(const CsvTable& table,
                                            const std::string& name) {
  const auto index = table.Find(name);
  if (index < 0) throw std::runtime_error(table.file + ": no " + name);
  return table.columns[static_cast<std::size_t>(index)].values;
}

TEST(SimulationFiles, AreOnePerComponentAndDirection) {
  EXPECT_THAT(SimulationFileNames(),
              ElementsAre("x_displacement_down.csv",
                          "x_displacement_up.csv",
                          "x_straightness.csv",
                          "x_yaw.csv",
                          "z_displacement_forward.csv",
                          "z_displacement_reverse.csv",
                          "z_straightness.csv",
                          "z_yaw.csv",
                          "parallelism.csv",
                          "orthogonality.csv",
                          "spindle_axial.csv",
                          "spindle_radial_x.csv",
                          "spindle_radial_y.csv",
                          "spindle_tilt_xz.csv",
                          "spindle_tilt_yz.csv",
                          "tool_tip.csv",
                          "diagonals.csv",
                          "temperatures.csv",
                          "machine.toml",
                          "README.md"));
}

TEST(SimulationFiles, HaveTheColumnsOfTheirComponent) {
  struct Case {
    const char* name;
    bool has_position;
    const char* unit;
    std::size_t rows_per_cycle;
  };
  for (const Case& c : {Case{"x_displacement_up.csv", true, "mm", 17},
                        Case{"x_yaw.csv", true, "urad", 17},
                        Case{"z_straightness.csv", true, "mm", 17},
                        Case{"orthogonality.csv", false, "urad", 4},
                        Case{"spindle_axial.csv", false, "mm", 4},
                        Case{"spindle_tilt_xz.csv", false, "urad", 4}}) {
    const CsvTable table = Table(c.name, {.truth = true});
    EXPECT_EQ(table.num_rows, kDays * kCycles * c.rows_per_cycle) << c.name;
    std::vector<std::string> names = {"record", "day", "cycle", "time_s"};
    if (c.has_position) names.emplace_back("position_mm");
    for (int i = 0; i < 40; ++i) {
      names.push_back((i < 10 ? "t0" : "t") + std::to_string(i) + "_degC");
    }
    names.push_back(std::string("error_") + c.unit);
    names.push_back(std::string("truth_") + c.unit);
    ASSERT_EQ(table.columns.size(), names.size()) << c.name;
    for (std::size_t i = 0; i < names.size(); ++i) {
      EXPECT_EQ(table.columns[i].name, names[i]) << c.name;
    }
    EXPECT_EQ(ColumnInSimulationFiles(table, "cycle").back(), kDays * kCycles);
    EXPECT_EQ(ColumnInSimulationFiles(table, "day").back(), kDays);
  }
}

TEST(SimulationFiles, ErrorIsTheTruthWithReadingNoise) {
  const CsvTable table = Table("x_displacement_down.csv", {.truth = true});
  const std::vector<double> error = ColumnInSimulationFiles(table, "error_mm");
  const std::vector<double> truth = ColumnInSimulationFiles(table, "truth_mm");
  double sum_of_squares = 0.0;
  for (std::size_t i = 0; i < error.size(); ++i) {
    sum_of_squares += (error[i] - truth[i]) * (error[i] - truth[i]);
  }
  const double sd =
      std::sqrt(sum_of_squares / static_cast<double>(error.size()));
  // 136 readings fix a standard deviation to 6 %; four of these.
  EXPECT_NEAR(sd, 0.15e-3, 0.25 * 0.15e-3);
}

TEST(SimulationFiles, TruthIsOptionalAndChangesNothingElse) {
  const CsvTable with = Table("x_displacement_down.csv", {.truth = true});
  const CsvTable without = Table("x_displacement_down.csv");
  EXPECT_EQ(without.Find("truth_mm"), -1);
  EXPECT_EQ(ColumnInSimulationFiles(with, "error_mm"),
            ColumnInSimulationFiles(without, "error_mm"));
}

TEST(SimulationFiles, TellTheTrueTimeOfEveryDay) {
  const CsvTable table = Table("x_displacement_down.csv");
  const std::vector<double> time = ColumnInSimulationFiles(table, "time_s");
  const std::vector<double> day = ColumnInSimulationFiles(table, "day");
  EXPECT_EQ(time[1] - time[0], kSecondsPerStop);
  for (std::size_t i = 1; i < time.size(); ++i) {
    EXPECT_GT(time[i], time[i - 1]);
    EXPECT_EQ(std::floor(time[i] / 86400.0), day[i] - 1.0);
  }
  const PreparedDataset prepared = MakeDataset(table, {});
  EXPECT_EQ(prepared.dataset.log()->sessions.column, "day");
  EXPECT_EQ(prepared.time_column, "time_s");
  EXPECT_EQ(prepared.dataset.num_sessions(), kDays);
}

TEST(SimulationFiles, AreDataSetsOfFortyOneInputsLessTheDead) {
  const PreparedDataset prepared =
      MakeDataset(Table("x_displacement_up.csv", {.truth = true}), {});
  EXPECT_EQ(prepared.dataset.num_inputs(), 37);
  EXPECT_EQ(prepared.dropped.size(), 4U);
  EXPECT_EQ(prepared.dataset.target().name, "error_mm");
  EXPECT_EQ(prepared.dataset.groups().column, "cycle");
}

TEST(SimulationFiles, TheToolTipTableRepeatsTheModel) {
  const CsvTable table = Table("tool_tip.csv");
  const std::vector<double> x = ColumnInSimulationFiles(table, "x_mm");
  const std::vector<double> z = ColumnInSimulationFiles(table, "z_mm");
  const std::vector<double> error_z =
      ColumnInSimulationFiles(table, "error_z_mm");
  ASSERT_EQ(table.num_rows, Small().points.size());
  for (std::size_t i = 0; i < table.num_rows; ++i) {
    const ToolTipPoint& point = Small().points[i];
    EXPECT_NEAR(x[i], point.x, 1e-9);
    EXPECT_NEAR(z[i], point.z, 1e-9);
    const ToolTipError error = ToolTipErrorAt(point.x,
                                              point.x_direction,
                                              point.z,
                                              point.z_direction,
                                              Small().stops[point.stop].rise);
    EXPECT_NEAR(error_z[i], error.z, 5e-7 * std::abs(error.z));
  }
}

TEST(SimulationFiles, DiagonalsGoFromCornerToCornerForthAndBack) {
  const CsvTable table = Table("diagonals.csv");
  const std::vector<double> x = ColumnInSimulationFiles(table, "x_mm");
  const std::vector<double> z = ColumnInSimulationFiles(table, "z_mm");
  const std::vector<double> error_x =
      ColumnInSimulationFiles(table, "error_x_mm");
  const auto text = [&](std::size_t row, const char* name) {
    const auto index = static_cast<std::size_t>(table.Find(name));
    return table.CellText(table.columns[index], row);
  };
  constexpr std::size_t kPoints = 9;
  const auto runs = static_cast<std::size_t>(kDays) * std::min(5, kCycles);
  ASSERT_EQ(table.num_rows, runs * 4 * kPoints);
  struct Run {
    std::size_t row;
    const char* diagonal;
    const char* direction;
    double first_x, first_z;  // in steps
    const char* x_direction;
    const char* z_direction;
  };
  for (const Run& run :
       {Run{0, "p0p", "forward", -17, -17, "reverse", "reverse"},
        Run{9, "p0p", "reverse", -1, -1, "forward", "forward"},
        Run{18, "p0n", "forward", -17, -1, "reverse", "forward"},
        Run{27, "p0n", "reverse", -1, -17, "forward", "reverse"}}) {
    const std::size_t last = run.row + kPoints - 1;
    EXPECT_EQ(text(run.row, "diagonal"), run.diagonal);
    EXPECT_EQ(text(run.row, "diagonal_direction"), run.direction);
    EXPECT_EQ(text(run.row, "x_direction"), run.x_direction);
    EXPECT_EQ(text(run.row, "z_direction"), run.z_direction);
    EXPECT_NEAR(x[run.row], kXStep * run.first_x, 1e-9);
    EXPECT_NEAR(z[run.row], kZStep * run.first_z, 1e-9);
    // To the opposite corner.
    EXPECT_NEAR(x[last], -kXStep * (18.0 + run.first_x), 1e-9);
    EXPECT_NEAR(z[last], -kZStep * (18.0 + run.first_z), 1e-9);
  }
  const Stop& stop = Small().stops.back();
  const ToolTipError error = ToolTipErrorAt(
      x.back(), Direction::kForward, z.back(), Direction::kReverse, stop.rise);
  EXPECT_NEAR(error_x.back(), error.x, 5e-7 * std::abs(error.x));
}

TEST(SimulationFiles, TheLogHasAllChannelsEveryMinuteFromSwitchOn) {
  const CsvTable table = Table("temperatures.csv");
  const std::vector<double> day = ColumnInSimulationFiles(table, "day");
  const std::vector<double> time = ColumnInSimulationFiles(table, "time_s");
  ASSERT_EQ(table.num_rows, Small().log.size());
  EXPECT_EQ(table.columns.size(), 3U + kNumThermocouples);
  for (std::size_t i = 0; i < table.num_rows; ++i) {
    if (i > 0 && day[i] == day[i - 1]) {
      EXPECT_EQ(time[i] - time[i - 1], 60.0);
    } else {
      const auto index = static_cast<std::size_t>(day[i]) - 1;
      EXPECT_EQ(time[i],
                86400.0 * (day[i] - 1.0) + Small().programmes[index].start_s);
    }
  }
  // To the last minute before the last stop.
  EXPECT_EQ(day.back(), kDays);
  EXPECT_GT(time.back(),
            static_cast<double>(Small().stops.back().time_s()) - 60.0);
}

TEST(SimulationFiles, TheLogReadsWhatTheStopsRead) {
  // A minute apart at most, three noises of 0.02 degC and two roundings.
  constexpr double kApart = 0.2;
  std::size_t compared = 0;
  for (const LogEntry& entry : Small().log) {
    for (const Stop& stop : Small().stops) {
      if (stop.time_s() != entry.time_s) continue;
      ++compared;
      for (std::size_t i = 0; i < kNumThermocouples; ++i) {
        EXPECT_NEAR(entry.readings[i], stop.readings[i], kApart) << i;
      }
    }
  }
  EXPECT_GT(compared, 0U);
}

TEST(SimulationFiles, MachineNamesAMapForEveryComponentFile) {
  const std::string toml = SimulationFile(Small(), {}, "machine.toml");
  for (const std::string& name : SimulationFileNames()) {
    if (!name.ends_with(".csv") || name == "tool_tip.csv" ||
        name == "diagonals.csv" || name == "temperatures.csv") {
      continue;
    }
    const std::string map = name.substr(0, name.size() - 4) + ".json";
    EXPECT_THAT(toml, HasSubstr("\"" + map + "\""));
  }
  EXPECT_THAT(
      toml,
      HasSubstr("EZZ = { forward = \"z_displacement_forward.json\", reverse = "
                "\"z_displacement_reverse.json\" }, EXZ = "
                "\"z_straightness.json\", EBZ = \"z_yaw.json\" }"));
}

TEST(SimulationFiles, ReadmeStatesOptionsAndDays) {
  const std::string text = SimulationFile(Small(), {}, "README.md");
  EXPECT_THAT(text, HasSubstr("| `dead` | 3, 4, 16, 19 |"));
  EXPECT_THAT(text, HasSubstr("| 1 | 08:00 |"));
  EXPECT_THAT(text, HasSubstr("the compensation is -error"));
}

TEST(SimulationFiles, NumbersHaveSevenDigits) {
  EXPECT_EQ(SevenDigits(-0.0), "0");
  EXPECT_EQ(SevenDigits(22.5), "22.5");
  EXPECT_EQ(SevenDigits(-0.012345678), "-0.01234568");
  EXPECT_EQ(SevenDigits(123456789.0), "1.234568e+08");
}

TEST(SimulationFiles, RefusesANameThatIsNotItsOwn) {
  EXPECT_THAT([] { SimulationFile(Small(), {}, "y_yaw.csv"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("y_yaw.csv")));
}

// The same bytes on every x86-64 machine: those that were shipped.
TEST(SimulationFiles, ShippedSetIsReproducedByteForByte) {
  const Simulation simulation = Simulate({.dead = {3, 4, 16, 19}});
  for (const char* name :
       {"x_displacement_down.csv", "x_displacement_up.csv"}) {
    const std::string shipped =
        ReadFile(tests::SourceDir() + "/data/sets/turning_centre/" + name);
    // A diff of 300 kB helps nobody.
    EXPECT_TRUE(SimulationFile(simulation, {.truth = true}, name) == shipped)
        << name;
  }
}

}  // namespace
}  // namespace errmap::turning_centre
