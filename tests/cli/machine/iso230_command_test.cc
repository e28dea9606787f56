// Figures of a positioning test, as a user asks for them.

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/cli_fixture.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// The worked example of tests/models/kinematics/iso230_test.cc in um, driven to
// and fro three times.
class Iso230 : public CliTest {
 protected:
  void SetUp() override {
    const std::vector<std::vector<double>> up{{1, 6}, {2, 6}, {3, 9}};
    const std::vector<std::vector<double>> down{{-1, 4}, {-1, 5}, {-1, 6}};
    const auto row = [](int run, int place, const char* way, double error) {
      return std::to_string(run + 1) + "," + std::to_string(100 * place) + "," +
             way + "," + std::to_string(error) + "\n";
    };
    const std::string header = "run,position_mm,direction,error_um\n";
    std::string both = header;
    std::string of_up = header;
    std::string of_down = header;
    for (std::size_t run = 0; run < up.size(); ++run) {
      const int n = static_cast<int>(run);
      both += row(n, 0, "up", up[run][0]) + row(n, 1, "up", up[run][1]) +
              row(n, 1, "down", down[run][1]) + row(n, 0, "down", down[run][0]);
      of_up += row(n, 0, "+", up[run][0]) + row(n, 1, "+", up[run][1]);
      of_down += row(n, 1, "-", down[run][1]) + row(n, 0, "-", down[run][0]);
    }
    Write("both.csv", both);
    Write("up.csv", of_up);
    Write("down.csv", of_down);
  }
};

TEST_F(Iso230, FiguresAreThoseOfTheWorkedExample) {
  const Json both = RunJson({"iso230", "both.csv", "--format", "json"});
  const Json& figures = both["measured"];
  const double s = std::sqrt(3.0);
  constexpr double kRounding = 1e-9;
  EXPECT_NEAR(figures["A"], 8.0 + 2.0 * s, kRounding);
  EXPECT_NEAR(figures["A_up"], 7.0 + 2.0 * s, kRounding);
  EXPECT_NEAR(figures["A_down"], 8.0, kRounding);
  EXPECT_NEAR(figures["R"], 4.0 + 2.0 * s, kRounding);
  EXPECT_NEAR(figures["R_up"], 4.0 * s, kRounding);
  EXPECT_NEAR(figures["R_down"], 4.0, kRounding);
  EXPECT_NEAR(figures["E"], 8.0, kRounding);
  EXPECT_NEAR(figures["M"], 5.5, kRounding);
  EXPECT_NEAR(figures["B"], 3.0, kRounding);
  EXPECT_NEAR(figures["B_mean"], 2.5, kRounding);
  EXPECT_EQ(both["with_map"], nullptr);
  EXPECT_EQ(both["points"]["measured"][1]["up"]["runs"], 3);
  // A file for each direction is the same test.
  EXPECT_EQ(
      RunJson({"iso230", "up.csv", "down.csv", "--format", "json"})["measured"],
      figures);
}

TEST_F(Iso230, TheOrderOfThePositionsTellsTheDirectionToo) {
  std::string text = "position_mm,error_um\n";
  for (int run = 0; run < 2; ++run) {
    for (const int place : {0, 100, 200}) {
      text += std::to_string(place) + "," + std::to_string(place + run) + "\n";
    }
    for (const int place : {200, 100, 0}) {
      text += std::to_string(place) + "," + std::to_string(place - 4) + "\n";
    }
  }
  Write("order.csv", text);
  const Json found = RunJson({"iso230", "order.csv", "--format", "json"});
  EXPECT_EQ(found["points"]["measured"][0]["up"]["runs"], 2);
  EXPECT_EQ(found["points"]["measured"][2]["down"]["runs"], 2);
  EXPECT_NEAR(found["measured"]["B"], 4.5, 1e-9);
}

// A map takes the slope away and leaves the reversal.
TEST_F(Iso230, AMapIsJudgedByTheSameFigures) {
  // Sorted, the rows tell no direction: one map for both.
  std::vector<std::string> lines = SplitLines(Read("both.csv"));
  std::string mixed = "position_mm,error_um\n";
  std::ranges::sort(lines.begin() + 1, lines.end());
  for (const char* way : {",up,", ",down,"}) {
    for (const std::string& line : lines) {
      const std::size_t at = line.find(way);
      if (at == line.npos) continue;
      mixed += line.substr(2, at - 2) + "," +
               line.substr(at + std::string(way).size()) + "\n";
    }
  }
  Write("mixed.csv", mixed);
  ASSERT_EQ(Run({"fit",
                 "mixed.csv",
                 "--model",
                 "poly:full:degree=1",
                 "--inputs",
                 "position_mm",
                 "--no-interval",
                 "-o",
                 "map.json"})
                .status,
            0);
  const Json found =
      RunJson({"iso230", "both.csv", "--map", "map.json", "--format", "json"});
  EXPECT_NEAR(found["with_map"]["M"], 0.0, 1e-6);
  EXPECT_NEAR(found["with_map"]["B"], found["measured"]["B"], 1e-6);
  const Outcome shown =
      Run({"iso230", "both.csv", "--map", "map.json", "--figure", "test.svg"});
  EXPECT_EQ(shown.status, 0);
  EXPECT_THAT(shown.out,
              AllOf(HasSubstr("3 runs upwards and 3 downwards"),
                    HasSubstr("asks for 5 runs"),
                    HasSubstr("with the map"),
                    HasSubstr("bidirectional repeatability")));
  EXPECT_THAT(Read("test.svg"), AllOf(HasSubstr("<svg"), HasSubstr("upwards")));
}

// Positions as an encoder read them, some microns about each target.
TEST_F(Iso230, ReadingsOfOnePositionAreOneTarget) {
  std::string text = "pos [mm],Richtung,Abweichung [um]\n";
  for (int run = 0; run < 5; ++run) {
    for (int step = 0; step < 10; ++step) {
      const int place = step < 5 ? step : 9 - step;
      const double away = 1e-3 * ((7 * run + 3 * step) % 5 - 2);
      text += fmt::format("{:.4f},{},{:.2f}\n",
                          100.0 * place + away,
                          step < 5 ? "+" : "-",
                          place + 0.1 * run + (step < 5 ? 0.0 : 2.0));
    }
  }
  Write("jitter.csv", text);
  const Json test = RunJson({"iso230", "jitter.csv", "--format", "json"});
  ASSERT_EQ(test["points"]["measured"].size(), 5);
  EXPECT_EQ(test["points"]["measured"][4]["down"]["runs"], 5);
  EXPECT_NEAR(test["measured"]["B"], 2.0, 1e-9);
}

TEST_F(Iso230, WhatCannotBeJudgedIsSaid) {
  EXPECT_THAT(Run({"iso230", "up.csv"}).out,
              HasSubstr("all runs are in one direction"));
  Write("none.csv", "t1_degC,error_um\n1,2\n2,3\n");
  EXPECT_THAT(RefusalOf(Run({"iso230", "none.csv"}), kUnusable),
              HasSubstr("--position"));
  Write("words.csv", "position_mm,way,error_um\n0,here,1\n1,there,2\n");
  EXPECT_THAT(
      RefusalOf(Run({"iso230", "words.csv", "--direction", "way"}), kUnusable),
      HasSubstr("'here' is not a direction"));
  RefusalOf(Run({"iso230",
                 "both.csv",
                 "up.csv",
                 "down.csv",
                 "--map",
                 "a.json",
                 "--map",
                 "b.json"}),
            kWrongCommandLine);
}

}  // namespace
}  // namespace errmap
