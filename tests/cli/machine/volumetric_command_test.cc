// errmap volumetric, as a user runs it.

#include <cmath>
#include <map>
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
using ::testing::Not;

// Rounding of sums near 0.1 mm.
constexpr double kRounding = 1e-12;

using Record = std::map<std::string, std::string>;

class VolumetricCommand : public CliTest {
 protected:
  Outcome Volumetric(const std::string& machine,
                     const std::string& points,
                     const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"volumetric", machine, "--at", points};
    words.insert(words.end(), more.begin(), more.end());
    return Run(words);
  }

  std::vector<Record> Points(const std::string& machine,
                             const std::string& points,
                             const std::vector<std::string>& more = {}) const {
    const Outcome outcome = Volumetric(machine, points, more);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return Records(outcome.out);
  }

  /// A map target = intercept + slope input, in the columns' own units.
  void WriteMap(const std::string& name,
                const std::string& target,
                const std::string& target_unit,
                double intercept,
                const std::string& input,
                const std::string& input_unit,
                double slope) const {
    Write(name,
          fmt::format(
              R"({{"schema": "errmap-model-1", "version": "0.1.0",
 "name": "poly:formula", "kind": "polynomial",
 "target": {{"name": "{}", "unit": "{}"}},
 "inputs": [{{"name": "{}", "unit": "{}", "min": -300, "max": 300,
             "mean": 0, "sd": 100}}],
 "parameters": 2,
 "polynomial": {{"input_offset": [0], "input_scale": [1], "intercept": {},
  "terms": [{{"powers": [1], "coefficient": {}}}], "equation": ""}},
 "history": null, "guards": null,
 "interval": {{"holdout": "sessions:5", "unit": "day", "groups": 20,
               "90": {}, "95": {}, "at_least": []}},
 "provenance": {{}}}})",
              target,
              target_unit,
              input,
              input_unit,
              intercept,
              slope,
              0.1 * std::abs(intercept),
              0.2 * std::abs(intercept)));
  }

  // One slide along X with an error file.
  std::string OneSlide(const std::string& errors) const {
    return "[[link]]\nname = \"X\"\nbranch = \"tool\"\njoint = \"linear\"\n"
           "axis = [1, 0, 0]\ncoordinate = \"x_mm\"\nerrors = { " +
           errors +
           " }\n[[link]]\nname = \"tool\"\nbranch = \"tool\"\n"
           "joint = \"fixed\"\noffset = [0, 0, -100]\n";
  }
};

double Number(const Record& record, const std::string& name) {
  const auto found = record.find(name);
  if (found == record.end()) throw std::runtime_error("no column " + name);
  return std::stod(found->second);
}

// Products of 4 x 4 matrices in numpy 1.24, rotations by the power series of
// their twist.
TEST_F(VolumetricCommand, ThreeAxesAgreeWithTheProductOfTheMatrices) {
  const std::vector<Record> points =
      Points(SetPath("machines/three_axis.toml"),
             SetPath("machines/three_axis_points.csv"));
  ASSERT_EQ(points.size(), 27U);
  struct Case {
    std::size_t row;
    double x, y, z;  // mm
  };
  // At (-250, -150, -300), (250, -150, 0) and (0, 150, -150).
  for (const Case& c : {Case{0, 0.00485465, -0.00624857, 0.00437885},
                        Case{20, 0.00092771, -0.00862419, 0.00753014},
                        Case{16, 0.00667273, -0.00743635, 0.00464548}}) {
    EXPECT_NEAR(Number(points[c.row], "error_x_mm"), c.x, 5e-9);
    EXPECT_NEAR(Number(points[c.row], "error_y_mm"), c.y, 5e-9);
    EXPECT_NEAR(Number(points[c.row], "error_z_mm"), c.z, 5e-9);
    EXPECT_NEAR(Number(points[c.row], "error_sensitive_mm"),
                std::hypot(c.x, c.y, c.z),
                1e-8);
    EXPECT_EQ(points[c.row].at("inside"), "1");
    // Constants state no uncertainty.
    for (const char* column :
         {"half_width_90_x_mm", "lower_90_x_mm", "upper_90_x_mm"}) {
      EXPECT_EQ(points[c.row].at(column), "");
    }
  }
}

TEST_F(VolumetricCommand, TheLatheOfTheReportCutsTheErrorOfAnotherDay) {
  const std::string file = SetPath("machines/lathe_points.csv");
  const Outcome outcome =
      Volumetric(SetPath("machines/lathe.toml"), file, {"-o", "out.csv"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("tool minus work, in X, Z at most"),
                    HasSubstr("The compensation is minus that")));
  const std::vector<Record> points = Records(Read("out.csv"));
  const std::vector<Record> truth = Records(Process::TextOf(file));
  ASSERT_EQ(points.size(), truth.size());
  double before = 0.0;
  double after = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const char* column : {"error_x_mm", "error_z_mm"}) {
      before += std::pow(Number(truth[i], column), 2);
      after +=
          std::pow(Number(truth[i], column) - Number(points[i], column), 2);
    }
    // To first order the parts add up, and the rest is of second order.
    double sum = 0.0;
    for (const char* name : {"EB0Z",
                             "EXZ",
                             "EBZ",
                             "EB0X",
                             "EXX",
                             "EBX",
                             "EZX",
                             "EZZ",
                             "EX0C",
                             "EZ0C",
                             "EY0C",
                             "EA0C",
                             "EB0C"}) {
      sum += Number(points[i], std::string(name) + "_x_mm");
    }
    EXPECT_NEAR(sum, Number(points[i], "first_order_x_mm"), kRounding);
    EXPECT_NEAR(Number(points[i], "error_x_mm"), sum, 1e-5);
  }
  // 34.4 um before and 8.6 um after, RMS.
  EXPECT_LT(after, before / 10.0);
}

TEST_F(VolumetricCommand, ConvertsUnitsOnEverySide) {
  // EXX in um of a position in um, EBX in urad of degrees Celsius; points in mm
  // and kelvin; the constant in the file's arcsec.
  WriteMap("exx.json", "error_um", "um", 2.0, "position_um", "um", 1e-4);
  WriteMap("ebx.json", "error_urad", "urad", 10.0, "t1_degC", "degC", 0.5);
  Write("m.toml",
        "angle = \"arcsec\"\n" +
            OneSlide("EXX = \"exx.json\", EBX = \"ebx.json\", ECX = 2.0"));
  Write("p.csv", "x_mm,t1 [K]\n0.2,293.15\n0.1,303.15\n");
  const Outcome outcome = Volumetric("m.toml", "p.csv");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("converted from K to degC"));
  const std::vector<Record> points = Records(outcome.out);
  // EXX: 2 + 1e-4 * 200 um; EBX turns the tool, 100 mm below: b * (-100) in X.
  const double ebx = 1e-6 * (10.0 + 0.5 * 20.0);
  EXPECT_NEAR(Number(points[0], "EXX_x_mm"), 1e-3 * 2.02, kRounding);
  EXPECT_NEAR(Number(points[0], "EBX_x_mm"), -100.0 * ebx, kRounding);
  EXPECT_NEAR(Number(points[0], "first_order_x_mm"),
              1e-3 * 2.02 - 100.0 * ebx,
              kRounding);
  EXPECT_NEAR(Number(points[1], "EBX_x_mm"), -100.0 * 25e-6, kRounding);
  // No arm for ECX: second order alone.
  EXPECT_EQ(points[0].at("ECX_x_mm"), "0");
  // Half-widths 0.2 um and 1 urad on 100 mm, as squares.
  EXPECT_NEAR(Number(points[0], "half_width_90_x_mm"),
              std::hypot(0.2e-3, 100.0 * 1e-6),
              kRounding);
}

// The file has the link's coordinate in mm, the points in um: 250 mm.
TEST_F(VolumetricCommand, ReadsACoordinateInAnotherUnitOfLength) {
  WriteMap("exx.json", "error_mm", "mm", 0.001, "position_mm", "mm", 1e-5);
  Write("m.toml", OneSlide("EXX = \"exx.json\""));
  Write("p.csv", "x [um]\n250000\n");
  EXPECT_NEAR(Number(Points("m.toml", "p.csv")[0], "error_x_mm"),
              0.001 + 1e-5 * 250.0,
              kRounding);
  for (const char* header : {"x_degC", "x_rad", "x", "y_mm"}) {
    Write("p.csv", std::string(header) + "\n250\n");
    EXPECT_THAT(RefusalOf(Volumetric("m.toml", "p.csv"), kUnusable),
                HasSubstr("p.csv: no column 'x_mm', which is a link's "
                          "coordinate; the columns are"));
  }
  Write("p.csv", "x_um,X_nm\n1,1\n");
  EXPECT_THAT(RefusalOf(Volumetric("m.toml", "p.csv"), kUnusable),
              HasSubstr("no column 'x_mm'"));
}

// The last of the map's held-out errors says more than its interval: a sum of
// many hardly ever reaches the largest of each.
TEST_F(VolumetricCommand, SpreadsByTheErrorsOfHeldOutSessions) {
  std::string training = "day,time_s,position_mm,error_mm\n";
  for (int day = 1; day <= 5; ++day) {
    for (int i = 0; i < 20; ++i) {
      training += fmt::format("{},{},{},{}\n",
                              day,
                              100000 * day + 60 * i,
                              -10.0 * (1 + i % 10),
                              0.001 * i + 0.002 * ((day * 7) % 5 - 2));
    }
  }
  Write("training.csv", training);
  ASSERT_EQ(Run({"fit",
                 "training.csv",
                 "--model",
                 "poly:position",
                 "-o",
                 "exx.json",
                 "--quiet"})
                .status,
            0);
  const Json map = Json::parse(Read("exx.json"));
  const double rmse = map["held_out"]["rmse"];
  ASSERT_EQ(map["held_out"]["units"].size(), 5U);
  Write("m.toml", OneSlide("EXX = \"exx.json\""));
  Write("p.csv", "x_mm\n-50\n");
  // t of 5 degrees of freedom at 0.95.
  EXPECT_NEAR(Number(Points("m.toml", "p.csv")[0], "half_width_90_x_mm"),
              2.0150483726 * rmse,
              1e-9);
}

// Constants are what a machine has: of the diagonals a tenth is left where it
// is a tenth worse than the file says.
TEST_F(VolumetricCommand, SaysWhatIsLeftAlongTheDiagonals) {
  const Outcome outcome =
      Volumetric(SetPath("machines/three_axis.toml"),
                 SetPath("machines/three_axis_diagonals.csv"),
                 {"-o", "out.csv"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("no intervals: the machine has constants alone"),
                    HasSubstr("systematic deviation E along diagonals, "
                              "predicted by the maps: ppp "),
                    HasSubstr("measured: ppp "),
                    HasSubstr("; minus the maps: ppp "),
                    HasSubstr("measured there 1"),
                    HasSubstr(" after subtracting the maps")));
  EXPECT_EQ(Records(Read("out.csv"))[9].at("diagonal"), "ppp");
  EXPECT_EQ(Records(Read("out.csv"))[9].at("diagonal_direction"), "reverse");
}

TEST_F(VolumetricCommand, RefusesDiagonalsThatAreNone) {
  Write("m.toml", OneSlide("EXX = 0.001"));
  struct Case {
    const char* text;
    const char* says;
  };
  for (const Case& c :
       {Case{"diagonal,x_mm\npp0,1\n",
             "p.csv: no column 'diagonal_direction' of forward or reverse"},
        Case{"diagonal,diagonal_direction,x_mm\npp0,up,1\n",
             "p.csv: line 2 (data row 0), column 'diagonal_direction': 'up' is "
             "neither forward nor reverse"},
        Case{"diagonal,diagonal_direction,x_mm\np00,forward,1\n",
             "'p00' is not a diagonal: give the signs"},
        Case{"diagonal,diagonal_direction,x_mm\npp0,forward,1\n",
             "p.csv: diagonal 'pp0': AlongDiagonal: all points are one"}}) {
    Write("p.csv", c.text);
    EXPECT_THAT(RefusalOf(Volumetric("m.toml", "p.csv"), kUnusable),
                HasSubstr(c.says));
  }
}

// A machine in um and arcsec, points in mm and degrees. A quarter turn of C
// puts the tip, 100 mm out on X, at (0, 100): EXC stays along X, ECC moves it
// by -X, EXX turns with the axis.
TEST_F(VolumetricCommand, TurnsRotaryAxesInTheUnitOfTheirColumn) {
  Write("m.toml",
        "length = \"um\"\nangle = \"arcsec\"\n"
        "[[link]]\nname = \"C\"\nbranch = \"tool\"\njoint = \"rotary\"\n"
        "axis = [0, 0, 1]\ncoordinate = \"c_deg\"\n"
        "errors = { EXC = 1.0, ECC = 2.0 }\n"
        "[[link]]\nname = \"X\"\nbranch = \"tool\"\njoint = \"linear\"\n"
        "axis = [1, 0, 0]\ncoordinate = \"x_mm\"\nerrors = { EXX = 3.0 }\n");
  Write("p.csv", "c_deg,x_mm\n90,100\n0,100\n");
  const std::vector<Record> points = Points("m.toml", "p.csv");
  const double turned = 2.0 * std::acos(-1.0) / 648000.0 * 1e5;  // um
  EXPECT_NEAR(Number(points[0], "first_order_x_um"), 1.0 - turned, 1e-9);
  EXPECT_NEAR(Number(points[0], "first_order_y_um"), 3.0, 1e-9);
  EXPECT_NEAR(Number(points[1], "first_order_x_um"), 4.0, 1e-9);
  EXPECT_NEAR(Number(points[1], "first_order_y_um"), turned, 1e-9);
  EXPECT_NEAR(Number(points[1], "error_y_um"), turned, 1e-4);
}

TEST_F(VolumetricCommand, APairTakesTheDirectionOfItsCoordinate) {
  WriteMap("down.json", "error_mm", "mm", 0.001, "position_mm", "mm", 1e-5);
  WriteMap("up.json", "error_mm", "mm", -0.002, "position_mm", "mm", 1e-5);
  Write("m.toml",
        OneSlide("EXX = { forward = \"down.json\", reverse = \"up.json\" }"));
  Write("p.csv", "x_mm,x_direction\n-100,forward\n-100,reverse\n");
  const std::vector<Record> points = Points("m.toml", "p.csv");
  EXPECT_NEAR(Number(points[0], "error_x_mm"), 0.0, kRounding);
  EXPECT_NEAR(Number(points[1], "error_x_mm"), -0.003, kRounding);
  Write("q.csv", "x_mm,x_direction\n-100,forward\n-100,down\n");
  EXPECT_THAT(RefusalOf(Volumetric("m.toml", "q.csv"), kUnusable),
              HasSubstr("q.csv: line 3 (data row 1), column 'x_direction': "
                        "'down' is neither forward nor reverse"));
  Write("r.csv", "x_mm\n-100\n");
  EXPECT_THAT(RefusalOf(Volumetric("m.toml", "r.csv"), kUnusable),
              AllOf(HasSubstr("r.csv: no column 'x_direction'"),
                    HasSubstr("(EXX of down.json, up.json)")));
}

TEST_F(VolumetricCommand, FlagsPointsWhereAMapExtrapolates) {
  WriteMap("exx.json", "error_mm", "mm", 0.001, "position_mm", "mm", 1e-5);
  Write("m.toml", OneSlide("EXX = \"exx.json\""));
  Write("p.csv", "x_mm\n-300\n-330\n");
  const Outcome outcome = Volumetric("m.toml", "p.csv");
  const std::vector<Record> points = Records(outcome.out);
  EXPECT_EQ(points[0].at("inside"), "1");
  EXPECT_EQ(points[0].at("outside"), "");
  EXPECT_EQ(points[1].at("inside"), "0");
  EXPECT_EQ(points[1].at("outside"), "EXX");
  EXPECT_THAT(outcome.err,
              HasSubstr("warning: maps extrapolate (inside = 0): EXX at 1 "
                        "point: outside a trained range"));
}

// What volumetric says of a machine of one error is what predict says.
TEST_F(VolumetricCommand, RunsMapsWithAMemoryThroughTheLog) {
  std::string training = "day,time_s,position_mm,t1_degC,error_mm\n";
  std::string log = "day,time_s,t1_degC\n";
  std::string earlier = "day,time_s,position_mm,t1_degC\n";
  std::string points = "day,time_s,x_mm,t1_degC\n";
  std::string rows = "day,time_s,position_mm,t1_degC\n";
  for (int day = 1; day <= 7; ++day) {
    // Within what was trained, so that no guard clips.
    const double warmth = day < 7 ? day : 3.5;
    double slow = 20.0;
    for (int i = 0; i < 80; ++i) {
      const double t1 = 20.0 + warmth * (1.0 - std::exp(-i / 10.0)) +
                        0.3 * std::sin(0.7 * i * day);
      slow += 0.1 * (t1 - slow);
      const double x = -10.0 * (1 + (i * 7) % 17);
      const std::string at = fmt::format("{},{}", day, 100000 * day + 60 * i);
      if (day < 7) {
        training +=
            fmt::format("{},{},{},{}\n", at, x, t1, 0.004 * (slow - 20.0));
      } else if (i < 50) {
        log += fmt::format("{},{}\n", at, t1);
        earlier += fmt::format("{},{},{}\n", at, x, t1);
      } else if (i % 10 == 0) {
        points += fmt::format("{},{},{}\n", at, x, t1);
        rows += fmt::format("{},{},{}\n", at, x, t1);
      }
    }
  }
  Write("training.csv", training);
  Write("log.csv", log);
  Write("earlier.csv", earlier);
  Write("points.csv", points);
  Write("rows.csv", rows);
  ASSERT_EQ(Run({"fit",
                 "training.csv",
                 "--model",
                 "poly:ridge:view=history:history=600",
                 "-o",
                 "exx.json",
                 "--quiet"})
                .status,
            0);
  Write("m.toml", OneSlide("EXX = \"exx.json\""));
  const std::vector<Record> ran =
      Points("m.toml", "points.csv", {"--after", "log.csv"});
  const Outcome predicted =
      Run({"predict", "exx.json", "rows.csv", "--after", "earlier.csv"});
  ASSERT_EQ(predicted.status, 0) << predicted.err;
  const std::vector<Record> expected = Records(predicted.out);
  ASSERT_EQ(ran.size(), expected.size());
  for (std::size_t i = 0; i < ran.size(); ++i) {
    EXPECT_NEAR(Number(ran[i], "error_x_mm"),
                Number(expected[i], "predicted"),
                kRounding);
  }
  // Rows of the log after a point and of other days leave it as it was.
  Write("log.csv", log + "7,799999,99\n8,800000,50\n");
  const std::vector<Record> later =
      Points("m.toml", "points.csv", {"--after", "log.csv"});
  EXPECT_EQ(later[0].at("error_x_mm"), ran[0].at("error_x_mm"));
  // Without the log the filters begin at the points.
  const Outcome alone = Volumetric("m.toml", "points.csv");
  EXPECT_THAT(alone.err,
              HasSubstr("1 map with a memory ran through the points alone"));
  EXPECT_NE(Records(alone.out)[1].at("error_x_mm"), ran[1].at("error_x_mm"));
}

TEST_F(VolumetricCommand, SameSeedSameBoundsAnotherSeedAnother) {
  const std::string machine = SetPath("machines/lathe.toml");
  const std::string points = SetPath("machines/lathe_points.csv");
  const auto bound = [&](const char* seed) {
    return Points(machine, points, {"--seed", seed, "--draws", "50"})[0].at(
        "lower_90_x_mm");
  };
  EXPECT_EQ(bound("1"), bound("1"));
  EXPECT_NE(bound("1"), bound("2"));
  const Record none = Points(machine, points, {"--draws", "0"})[0];
  EXPECT_EQ(none.at("lower_90_x_mm"), "");
  EXPECT_NE(none.at("half_width_90_x_mm"), "");
}

TEST_F(VolumetricCommand, RefusesMachinesByLineAndName) {
  WriteMap("length.json", "error_mm", "mm", 0.001, "position_mm", "mm", 1e-5);
  WriteMap("angle.json", "error_urad", "urad", 1.0, "position_mm", "mm", 1.0);
  WriteMap("bare.json", "error", "", 1.0, "position_mm", "mm", 1.0);
  WriteMap("warm.json", "error_mm", "mm", 0.001, "t9_degC", "degC", 1e-5);
  Write("p.csv", "x_mm\n-100\n");
  const std::string tool = "[[link]]\nname = \"T\"\nbranch = \"tool\"\n";
  const auto fixed = [&](const std::string& errors) {
    return tool + "joint = \"fixed\"\nerrors = { " + errors + " }\n";
  };
  struct Case {
    std::string text;
    const char* says;
  };
  const std::vector<Case> cases = {
      {"name = ", "m.toml:1:"},
      {"", "needs a [[link]] with branch = \"tool\""},
      {"nome = \"x\"\n", "m.toml:1:1: unknown key 'nome' in the machine"},
      {"length = \"rad\"\n", "'length' in the machine must be one of"},
      {"sensitive = [\"A\"]\n", "'sensitive' lists X, Y or Z, found 'A'"},
      {"[[link]]\nbranch = \"tool\"\n", "m.toml:1:1: [[link]]: needs name"},
      {"[[link]]\nname = \"X\"\nbranch = \"tail\"\njoint = \"fixed\"\n",
       "m.toml:3:10: 'branch' in link 'X' must be \"tool\" or \"work\", found "
       "text ('tail')"},
      {tool, "m.toml:1:1: link 'T': needs joint = "},
      {tool + "joint = \"linear\"\naxis = [0, 0, 1]\n",
       "moves and needs coordinate"},
      {tool + "joint = \"linear\"\ncoordinate = \"x_mm\"\n",
       "moves and needs an axis"},
      {tool + "joint = \"fixed\"\naxis = [0, 0, 1]\n", "is fixed: 'axis'"},
      {tool + "joint = \"fixed\"\noffset = [0, 1]\n",
       "m.toml:5:10: 'offset' in link 'T' must be three finite numbers"},
      {fixed("") + fixed(""),
       "m.toml:7:8: two links are named 'T'; a chain goes from the base "
       "outwards and has no loops"},
      {fixed("EXX = 0.0"), "m.toml:5:12: unknown key 'EXX' in errors of link"},
      {fixed("EXT = true"), "'EXT' in errors of link 'T' must be a model file"},
      {fixed("EXT = \"none.json\""), "m.toml:5:18: EXT: none.json: "},
      {fixed("EXT = \"angle.json\""),
       "EXT is a length, and angle.json predicts 'error_urad' in urad"},
      {fixed("EAT = \"length.json\""),
       "EAT is an angle, and length.json predicts 'error_mm' in mm"},
      {fixed("EXT = \"bare.json\""), "predicts 'error' in no unit"},
      {fixed("EXT = { forward = 0.0, reverse = 0.1 }"),
       "EXT: link 'T' is fixed and has no direction of motion"},
      {OneSlide("EXX = { forward = 0.0 }"), "needs 'reverse', too"},
      {OneSlide("EXX = { forward = 0.0, down = 0.1 }"), "unknown key 'down'"},
      {fixed("EXT = \"length.json\""),
       "p.csv: the map reads 'position_mm', and its link is fixed and has no "
       "position (EXT of length.json)"},
      {OneSlide("EXX = \"warm.json\""),
       "p.csv: no column 't9_degC', which the map reads"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    Write("m.toml", c.text);
    EXPECT_THAT(RefusalOf(Volumetric("m.toml", "p.csv"), kUnusable),
                HasSubstr(c.says));
  }
}

TEST_F(VolumetricCommand, SaysOnceThatMapsHaveNoChecksum) {
  for (const char* file : {"x.json", "y.json", "z.json"}) {
    WriteMap(file, "error_mm", "mm", 0.001, "position_mm", "mm", 1e-5);
  }
  Write("m.toml",
        OneSlide("EXX = \"x.json\", EYX = \"y.json\", EZX = \"z.json\""));
  Write("p.csv", "x_mm\n-100\n");
  const std::string err = Volumetric("m.toml", "p.csv").err;
  EXPECT_THAT(err,
              HasSubstr("x.json has no checksum: a changed number would go "
                        "unnoticed; the same holds for 2 more of its maps\n"));
  EXPECT_THAT(err, Not(HasSubstr("z.json")));
}

TEST_F(VolumetricCommand, RefusesPointsByFileAndName) {
  Write("m.toml", OneSlide("EXX = 0.001"));
  struct Case {
    const char* text;
    const char* says;
  };
  for (const Case& c : {Case{"y_mm\n1\n", "p.csv: no column 'x_mm'"},
                        Case{"x_mm\n1\nup\n", "p.csv: line 3 (data row 1)"}}) {
    Write("p.csv", c.text);
    EXPECT_THAT(RefusalOf(Volumetric("m.toml", "p.csv"), kUnusable),
                HasSubstr(c.says));
  }
  EXPECT_THAT(RefusalOf(Volumetric("m.toml", "no.csv"), kUnusable),
              HasSubstr("no.csv"));
  EXPECT_THAT(RefusalOf(Volumetric("no.toml", "p.csv"), kUnusable),
              HasSubstr("no.toml"));
  WriteMap("map.json", "error_mm", "mm", 0.001, "position_mm", "mm", 1e-5);
  EXPECT_THAT(RefusalOf(Volumetric("map.json", "p.csv"), kUnusable),
              HasSubstr("map.json: is JSON, and a machine is a TOML file"));
  EXPECT_THAT(RefusalOf(Volumetric("m.toml", "p.csv", {"--draws", "-1"}),
                        kWrongCommandLine),
              HasSubstr("draws"));
  EXPECT_THAT(RefusalOf(Run({"volumetric", "m.toml"}), kWrongCommandLine),
              HasSubstr("--at"));
}

TEST_F(VolumetricCommand, SuspectsConstantsInAnotherUnit) {
  Write("m.toml", OneSlide("EXX = 3.5, EBX = 12"));
  Write("p.csv", "x_mm\n1\n");
  const Outcome outcome = Volumetric("m.toml", "p.csv");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(
      outcome.err,
      AllOf(HasSubstr("m.toml:7:18: warning: EXX = 3.5 mm is not an error"),
            HasSubstr("EBX = 12 rad is not an error of a machine tool; the "
                      "file's angles are in rad")));
  Write("m.toml",
        "length = \"um\"\nangle = \"arcsec\"\n" +
            OneSlide("EXX = 3.5, EBX = 12"));
  EXPECT_THAT(Volumetric("m.toml", "p.csv").err, Not(HasSubstr("no error")));
}

// A machine drawn in mm whose file says um, or the other way round.
TEST_F(VolumetricCommand, SuspectsOffsetsInAnotherUnit) {
  Write("p.csv", "x_mm\n1\n");
  const std::string slide = OneSlide("EBX = 1e-5");  // the tool 100 below
  Write("m.toml", slide);
  EXPECT_THAT(Volumetric("m.toml", "p.csv").err, Not(HasSubstr("away from")));
  Write("m.toml", "length = \"um\"\n" + slide);
  EXPECT_THAT(
      Volumetric("m.toml", "p.csv").err,
      HasSubstr("m.toml:13:10: warning: link 'tool' is 100 um away from "
                "the one before; the file's lengths are in um"));
  Write("m.toml", "length = \"m\"\n" + slide);
  EXPECT_THAT(Volumetric("m.toml", "p.csv").err,
              HasSubstr("'tool' is 100 m away from the one before"));
}

}  // namespace
}  // namespace errmap
