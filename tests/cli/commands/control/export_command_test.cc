// Exported maps, compiled or run by others, against `errmap predict`.

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "tests/cli/cli_fixture.h"

namespace errmap {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

// Rounding in another order, over the target's range; what is promised.
constexpr double kDouble = 1e-12;
constexpr double kSingle = 1e-5;

constexpr const char* kStrict =
    "-std=c99 -O2 -Wall -Wextra -Wconversion -pedantic -Werror";

// Reads `start dt inputs...`, start 1 where a session begins and 2 where the
// zero is taken anew, and prints the error and the status. A session begins
// after so long a pause that no rate limits its first error.
constexpr const char* kDriver = R"(
#include <stdio.h>
{1}
int main(void) {{
  double start, dt, value;
  {0}_real inputs[{0}_INPUTS + 1];
  {0}_real error = 0;
  {0}_state state;
  {0}_init(&state);
  while (scanf("%lf %lf", &start, &dt) == 2) {{
    int i, status;
    for (i = 0; i < {0}_INPUTS; ++i) {{
      if (scanf("%lf", &value) != 1) return 1;
      inputs[i] = ({0}_real)value;
    }}
    if (start == 1.0) {{
      {0}_begin(&state);
      dt = 1e6;
    }}
    if (start == 2.0) {0}_zero(&state);
    status = {0}_step(&state, dt, inputs, &error);
    printf("%.17g %d\n", (double)error, status);
  }}
  return 0;
}}
)";

constexpr const char* kPythonDriver = R"(
import sys
import {0} as m
session = m.Map()
for row in sys.stdin:
    start, dt, *inputs = map(float, row.split())
    if start == 1:
        session.begin()
        dt = 1e6
    if start == 2:
        session.zero()
    error, status = session.step(dt, inputs)
    print(repr(error), status)
)";

class CliExport : public Cli {
 protected:
  static void SetUpTestSuite() {
    simulated_ = new ScratchFolder;
    EXPECT_EQ(Process(simulated_->path(),
                      {"simulate",
                       "turning-centre",
                       "-o",
                       "sim",
                       "--days",
                       "3",
                       "--cycles",
                       "4",
                       "--seed",
                       "3",
                       "--quiet"})
                  .Wait()
                  .status,
              0);
  }
  static void TearDownTestSuite() { delete simulated_; }

  static std::string Simulated(const std::string& name) {
    return (*simulated_ / ("sim/" + name)).string();
  }

  // Runs a line of the shell in the scratch folder.
  Outcome Shell(const std::string& line) const {
    const std::string command =
        fmt::format("cd '{}' && ({}) >.shell_out 2>.shell_err </dev/null",
                    scratch_.path().string(),
                    line);
    const int status = std::system(command.c_str());
    return {WEXITSTATUS(status), Read(".shell_out"), Read(".shell_err")};
  }

  Outcome Good(const std::string& line) const {
    Outcome outcome = Shell(line);
    EXPECT_EQ(outcome.status, 0) << line << "\n" << outcome.err;
    return outcome;
  }

  void FitMap(const std::string& csv,
              const std::string& spec,
              const std::string& model) const {
    std::vector<std::string> words{
        "fit", csv, "--model", spec, "-o", model, "--quiet", "--no-interval"};
    if (csv != kDown) {
      words.insert(words.end(),
                   {"--inputs", "position_mm,t03_degC,t12_degC,t15_degC"});
    }
    const Outcome outcome = Run(words);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }

  std::string Export(const std::string& model,
                     const std::vector<std::string>& more) const {
    std::vector<std::string> words{"export", model, "-o", "."};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = Run(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.err;
  }

  // What `errmap predict` says, and the rows that drivers read.
  struct Session {
    std::vector<double> predicted;
    std::string rows;
    double range = 0.0;
  };

  Session Predict(const std::string& model, const std::string& csv) const {
    const Outcome outcome = Run({"predict", model, csv});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const data::CsvTable found = data::ParseCsv(outcome.out, "stdout");
    Session session;
    session.predicted = Column(found, "predicted");
    const data::CsvTable table = data::ReadCsv(csv);
    const Json document = Json::parse(Read(model));
    const bool has_memory = !document["history"].is_null();
    const std::vector<double> time =
        has_memory ? Column(table, "time_s") : std::vector<double>{};
    const std::vector<double> day =
        has_memory ? Column(table, "day") : std::vector<double>{};
    for (std::size_t row = 0; row < table.num_rows; ++row) {
      const bool starts = row == 0 || (has_memory && day[row] != day[row - 1]);
      session.rows += fmt::format("{} {}",
                                  starts ? 1 : 0,
                                  starts       ? 0.0
                                  : has_memory ? time[row] - time[row - 1]
                                               : 60.0);
      for (const Json& input : document["inputs"]) {
        session.rows += fmt::format(
            " {}", Column(table, input["name"].get<std::string>())[row]);
      }
      session.rows += "\n";
    }
    const std::vector<double> target =
        Column(table, document["target"]["name"].get<std::string>());
    session.range =
        *std::ranges::max_element(target) - *std::ranges::min_element(target);
    return session;
  }

  static std::vector<double> Column(const data::CsvTable& table,
                                    const std::string& name) {
    const std::ptrdiff_t index = table.Find(name);
    EXPECT_GE(index, 0) << name;
    return table.columns[static_cast<std::size_t>(index)].values;
  }

  void WriteCDriver(const std::string& name) const {
    Write("driver.c",
          fmt::format(kDriver, name, "#include \"" + name + ".h\""));
  }

  // The first number of each line of `printed` against the predictions.
  static void ExpectAgreement(const std::string& printed,
                              const Session& session,
                              double tolerance) {
    const std::vector<std::string> lines = SplitLines(printed);
    ASSERT_EQ(lines.size(), session.predicted.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const double error = std::strtod(lines[i].c_str(), nullptr);
      worst = std::max(worst, std::fabs(error - session.predicted[i]));
    }
    EXPECT_LE(worst, tolerance * session.range);
  }

  void ExpectCAgrees(const std::string& name,
                     const Session& session,
                     double tolerance) const {
    WriteCDriver(name);
    Write("rows", session.rows);
    for (const char* compiler : {"gcc", "clang"}) {
      if (Shell(fmt::format("command -v {}", compiler)).status != 0) continue;
      Good(fmt::format("{} {} -D{}_SELF_TEST {}.c -o self -lm && ./self",
                       compiler,
                       kStrict,
                       name,
                       name));
      Good(fmt::format(
          "{} {} driver.c {}.c -o driver -lm", compiler, kStrict, name));
      ExpectAgreement(Good("./driver <rows").out, session, tolerance);
    }
  }

  void ExpectAllAgree(const std::string& csv, const std::string& spec) const {
    SCOPED_TRACE(spec);
    FitMap(csv, spec, "map.json");
    ExpectExportsAgree(csv);
  }

  // Of map.json, in every language.
  void ExpectExportsAgree(const std::string& csv) const {
    const Session session = Predict("map.json", csv);
    Export("map.json", {"--c", "--python", "--st"});
    ExpectCAgrees("map", session, kDouble);
    Write("driver.py", fmt::format(kPythonDriver, "map"));
    Good("python3 map.py");
    ExpectAgreement(Good("python3 driver.py <rows").out, session, kDouble);
    ExpectAgreement(
        Good(fmt::format("python3 -B {}/cli/commands/read_structured_text.py "
                         "map.st <rows",
                         tests::TestDir()))
            .out,
        session,
        kDouble);
    Export("map.json", {"--c", "--float"});
    ExpectCAgrees("map", session, kSingle);
  }

  // A program that has two maps, and what it asks of other libraries.
  static ScratchFolder* simulated_;
};

ScratchFolder* CliExport::simulated_ = nullptr;

TEST_F(CliExport, ReproducesMapsWithoutMemory) {
  for (const char* spec : {"zero",
                           "mean",
                           "poly:eq8",
                           "poly:full:degree=6",
                           "net:scg:iterations=200"}) {
    ExpectAllAgree(kDown, spec);
  }
}

TEST_F(CliExport, ReproducesMapsWithAMemory) {
  for (const char* spec : {"poly:ridge:view=history+zero",
                           "net:scg:view=history:hidden=5:iterations=100",
                           "poly:stepwise:view=zero",
                           "blend"}) {
    ExpectAllAgree(Simulated("x_displacement_up.csv"), spec);
  }
}

TEST_F(CliExport, ReproducesEveryKindOfDerivedInput) {
  const auto derived = [](const std::string& name,
                          const std::string& of,
                          const std::string& filter) {
    Json entry = {{"name", name}, {"unit", ""}, {"of", of}, {"filter", filter}};
    if (filter == "ema") entry["tau"] = 300.0;
    return entry;
  };
  const auto input = [](const std::string& name, double min, double max) {
    return Json{{"name", name},
                {"unit", name.substr(name.find('_') + 1)},
                {"min", min},
                {"max", max},
                {"mean", 0.5 * (min + max)},
                {"sd", 1.0}};
  };
  Json terms = Json::array();
  for (int i = 0; i < 5; ++i) {
    std::vector<int> powers(5, 0);
    powers[static_cast<std::size_t>(i)] = i % 2 + 1;
    terms.push_back({{"powers", powers}, {"coefficient", 0.1 * (i - 2.5)}});
  }
  const std::vector<double> ones(5, 1.0);
  const std::vector<double> zeros(5, 0.0);
  Write("map.json",
        Json{{"schema", "errmap-model-1"},
             {"version", "0"},
             {"name", "made"},
             {"kind", "polynomial"},
             {"target", {{"name", "error_um"}, {"unit", "um"}}},
             {"inputs", {input("t1_degC", 18.0, 30.0), input("c_deg", 0, 360)}},
             {"parameters", 6},
             {"polynomial",
              {{"input_offset", zeros},
               {"input_scale", ones},
               {"intercept", 0.5},
               {"terms", terms},
               {"equation", ""}}},
             {"history",
              {{"time_unit", "s"},
               {"session", "day"},
               {"latest_start", nullptr},
               {"derived",
                {derived("lag", "t1_degC", "ema"),
                 derived("zeroed lag", "lag", "zero"),
                 derived("zeroed", "t1_degC", "zero"),
                 derived("lag of zeroed", "zeroed", "ema"),
                 derived("sin", "c_deg", "sine"),
                 derived("cos", "c_deg", "cosine")}},
               {"form_inputs",
                {"lag", "zeroed lag", "lag of zeroed", "sin", "cos"}}}},
             {"guards", nullptr},
             {"interval", nullptr}}
            .dump());
  std::string csv = "day,time_s,t1_degC,c_deg,error_um\n";
  for (int row = 0; row < 60; ++row) {
    csv += fmt::format("{},{},{},{},{}\n",
                       row / 30,
                       row % 30 * (1 + row % 30),
                       22.0 + 4.0 * std::sin(0.3 * row),
                       (37 * row) % 360,
                       0.01 * row);
  }
  Write("made.csv", csv);
  ExpectExportsAgree((scratch_ / "made.csv").string());
}

TEST_F(CliExport, TakesTheZeroAnewInEveryLanguage) {
  const std::string csv = Simulated("x_displacement_up.csv");
  FitMap(csv, "poly:ridge:view=history+zero", "map.json");
  Session session = Predict("map.json", csv);
  std::vector<std::string> rows = SplitLines(session.rows);
  ASSERT_EQ(rows[20].front(), '0');
  rows[20].front() = '2';
  session.rows.clear();
  for (const std::string& row : rows) session.rows += row + "\n";
  Export("map.json", {"--c", "--python", "--st"});
  Write("rows", session.rows);
  Write("driver.py", fmt::format(kPythonDriver, "map"));
  const std::string python = Good("python3 driver.py <rows").out;
  const std::vector<double> kept = std::move(session.predicted);
  session.predicted.clear();
  for (const std::string& line : SplitLines(python)) {
    session.predicted.push_back(std::strtod(line.c_str(), nullptr));
  }
  EXPECT_NEAR(session.predicted[19], kept[19], kDouble);
  EXPECT_GT(std::fabs(session.predicted[20] - kept[20]), 1e-6);
  ExpectCAgrees("map", session, kDouble);
  ExpectAgreement(
      Good(fmt::format("python3 -B {}/cli/commands/read_structured_text.py "
                       "map.st <rows",
                       tests::TestDir()))
          .out,
      session,
      kDouble);
}

TEST_F(CliExport, LinksTwoMapsIntoOneProgramWithoutAHeap) {
  FitMap(kDown, "net:scg:iterations=50", "a.json");
  FitMap(Simulated("x_displacement_up.csv"), "poly:ridge:view=zero", "b.json");
  Export("a.json", {"--c"});
  Export("b.json", {"--c", "--name", "other"});
  Write("both.c",
        "#include \"a.h\"\n#include \"other.h\"\n"
        "int main(void) {\n"
        "  const double x[other_INPUTS] = {0};\n"
        "  double error;\n  a_state a;\n  other_state other;\n"
        "  a_init(&a);\n  other_init(&other);\n"
        "  if (a_step(&a, 1.0, x, &error) & a_INVALID) return 1;\n"
        "  return (other_step(&other, 1.0, x, &error) & other_NOT_TAKEN) == "
        "0;\n}\n");
  Good(fmt::format("gcc {} both.c a.c other.c -o both -lm && ./both", kStrict));
  const std::string needed =
      Good(fmt::format("gcc {} -c a.c other.c && nm -u a.o other.o", kStrict))
          .out;
  for (const std::string& line : SplitLines(needed)) {
    if (line.find(" U ") == std::string::npos) continue;
    EXPECT_THAT(
        line,
        ::testing::AnyOf(HasSubstr("exp"), HasSubstr("GLOBAL_OFFSET_TABLE")));
  }
}

TEST_F(CliExport, SaysSignUnitsInputsAndAgreement) {
  FitMap(kDown, "poly:eq8", "map.json");
  const std::string said = Export("map.json", {"--c", "--python", "--st"});
  EXPECT_THAT(said, HasSubstr("map.c, map.h, map.py, map.st in ."));
  EXPECT_THAT(said, HasSubstr("compensation = -error"));
  EXPECT_THAT(
      said, ContainsRegex("agrees with errmap predict to (0|[0-9.]+e-1[3-9])"));
  EXPECT_THAT(said, ContainsRegex("at [0-9]+ rows; its self-test runs 21 o"));
  for (const char* file : {"map.h", "map.c", "map.py", "map.st"}) {
    EXPECT_THAT(Read(file), HasSubstr("error = actual - nominal, in mm"));
    EXPECT_THAT(Read(file), HasSubstr("compensation = -error"));
    EXPECT_THAT(Read(file), HasSubstr("position_mm, mm, trained -215.9 to "));
  }
}

TEST_F(CliExport, MakesNamesSafeWhateverTheyAre) {
  Write("hostile.csv",
        "\"*/ #include (* \"\"\"\"\"\" ?\?/\",t\xc3\xa9mp [\xc2\xb0"
        "C],IF,error_mm\n1,2,3,0.1\n2,3,5,0.2\n3,5,4,0.35\n4,1,1,0.4\n"
        "5,2,8,0.5\n6,3,9,0.7\n");
  ASSERT_EQ(Run({"fit",
                 "hostile.csv",
                 "--model",
                 "poly:ridge:degree=1",
                 "-o",
                 "7 & 'x'.json",
                 "--quiet",
                 "--no-interval"})
                .status,
            0);
  Export("7 & 'x'.json", {"--c", "--python", "--st"});
  Good(fmt::format("gcc {} -Dm_7_x_SELF_TEST m_7_x.c -o self -lm && ./self",
                   kStrict));
  Good("python3 m_7_x.py");
  Write("rows", "1 0 1 2 3\n");
  Good(fmt::format(
      "python3 -B {}/cli/commands/read_structured_text.py m_7_x.st <rows",
      tests::TestDir()));
  EXPECT_THAT(
      RefusalOf(
          Run({"export", "7 & 'x'.json", "--c", "-o", ".", "--name", "a-b"}),
          kWrongCommandLine),
      HasSubstr("such as a_b"));
}

TEST_F(CliExport, CountsAndTimesWhatAMapCosts) {
  FitMap(kDown, "poly:eq8", "map.json");  // x, t, x^2 and x t
  const Json cost = RunJson({"cost", "map.json", "--format", "json"});
  EXPECT_EQ(cost["operations"]["exponentials"], 0);
  // Two scaled inputs; nested, a product and a sum for each term but that of
  // the highest power; the largest change, of the time and of the way; where
  // the one sensor stands among 35 trained states, and those itself.
  EXPECT_EQ(cost["operations"]["multiplications"], 8 + 3 + 35);
  // What is kept to hold the last good error, for want of a memory, and the
  // trained state close by.
  EXPECT_EQ(cost["bytes"]["state"], 80 + 24);
  if (Shell("command -v cc").status == 0) {
    EXPECT_GT(cost["bytes"]["code"], 0);
    EXPECT_GT(cost["median_ns"], 0.0);
    EXPECT_GE(cost["p999_ns"], cost["median_ns"].get<double>() / 2.0);
    EXPECT_GE(cost["worst_ns"], cost["p999_ns"]);
  }
  const Outcome table = Run({"cost", "map.json"});
  EXPECT_THAT(table.out, HasSubstr("poly:eq8: one step of the exported C"));
  EXPECT_THAT(table.out, HasSubstr("multiplications         46"));
}

TEST_F(CliExport, CountsWhereNothingCompiles) {
  FitMap(kDown, "poly:eq8", "map.json");
  const Outcome outcome = Good(
      fmt::format("PATH=/nonexistent '{}' cost map.json", tests::Binary()));
  EXPECT_THAT(outcome.out, HasSubstr("multiplications         46"));
  EXPECT_THAT(outcome.out, HasSubstr("nothing measured: `cc -std=c99 -O2`"));
  EXPECT_EQ(outcome.err, "");
}

TEST_F(CliExport, WritesAComponentForLinuxcnc) {
  FitMap(kDown, "poly:eq8", "map.json");
  Export("map.json", {"--hal", "--joint", "1"});
  EXPECT_THAT(Read("errmap_map.comp"),
              HasSubstr("offset = compensation = -err"));
  EXPECT_THAT(Read("errmap_map.hal"), HasSubstr("joint.1.motor-pos-fb"));
  EXPECT_TRUE(Exists("errmap_map_eoffset.hal"));
}

TEST_F(CliExport, RefusesWhatItCannotWrite) {
  FitMap(kDown, "poly:eq8", "map.json");
  Write("file", "");
  EXPECT_THAT(
      RefusalOf(Run({"export", "map.json", "--c", "-o", "file/in"}), kFailure),
      HasSubstr("file/in"));
  EXPECT_THAT(
      RefusalOf(Run({"export", "map.json", "-o", "."}), kWrongCommandLine),
      HasSubstr("say what to write"));
  EXPECT_THAT(
      RefusalOf(Run({"export", "map.json", "--python", "--float", "-o", "."}),
                kWrongCommandLine),
      HasSubstr("--float is only for --c, --st, --scl and --plcopen"));
  Json opaque = Json::parse(Read("map.json"));
  opaque["kind"] = "opaque";
  WriteMapFile("opaque.json", opaque);
  EXPECT_THAT(
      RefusalOf(Run({"export", "opaque.json", "--c", "-o", "."}), kUnusable),
      HasSubstr("unknown kind of model 'opaque'"));
}

TEST_F(CliExport, RefusesAMapThatCountsRows) {
  FitMap(Simulated("x_displacement_up.csv"),
         "poly:ridge:view=history:history=600",
         "map.json");
  Json rows = Json::parse(Read("map.json"));
  rows["history"]["time_unit"] = "rows";
  WriteMapFile("rows.json", rows);
  EXPECT_THAT(
      RefusalOf(Run({"export", "rows.json", "--c", "-o", "."}), kUnusable),
      HasSubstr("rows.json: its memory counts rows, and a controller seconds; "
                "say how often a row came (--every 30s)"));
  EXPECT_THAT(
      RefusalOf(
          Run({"export", "rows.json", "--c", "-o", ".", "--every", "soon"}),
          kWrongCommandLine),
      HasSubstr("--every must be a time such as 30s"));
  EXPECT_THAT(
      RefusalOf(Run({"export", "map.json", "--c", "-o", ".", "--every", "30s"}),
                kWrongCommandLine),
      HasSubstr("that of map.json does not"));
}

// 600 rows of 1 s are 600 s: the very file of the map in seconds, apart from
// what it says that it was made for.
TEST_F(CliExport, TakesAMapThatCountsRowsByHowOftenTheyCame) {
  FitMap(Simulated("x_displacement_up.csv"),
         "poly:ridge:view=history:history=600",
         "map.json");
  const std::string seconds = Read("map.json");
  Json rows = Json::parse(Read("map.json"));
  rows["history"]["time_unit"] = "rows";
  WriteMapFile("map.json", rows);
  ASSERT_EQ(
      Run({"export", "map.json", "--python", "-o", "rows", "--every", "1s"})
          .status,
      0);
  ASSERT_EQ(
      Run({"export", "map.json", "--python", "-o", "slow", "--every", "2min"})
          .status,
      0);
  Write("map.json", seconds);
  ASSERT_EQ(Run({"export", "map.json", "--python", "-o", "seconds"}).status, 0);
  const std::string said = " with a row every 1s";
  std::string of_rows = Read("rows/map.py");
  ASSERT_THAT(of_rows, HasSubstr(said));
  of_rows.erase(of_rows.find(said), said.size());
  EXPECT_EQ(of_rows, Read("seconds/map.py"));
  EXPECT_NE(Read("slow/map.py"), Read("seconds/map.py"));
  Good("python3 -B slow/map.py");
}

TEST_F(CliExport, ReducesTheErrorOfTheSimulatedMachine) {
  const std::string csv = Simulated("x_displacement_up.csv");
  FitMap(csv, "poly:ridge:view=history+zero", "map.json");
  const Session session = Predict("map.json", csv);
  Export("map.json", {"--st"});
  Write("rows", session.rows);
  const std::vector<std::string> lines = SplitLines(
      Good(fmt::format(
               "python3 -B {}/cli/commands/read_structured_text.py map.st "
               "<rows",
               tests::TestDir()))
          .out);
  const std::vector<double> error = Column(data::ReadCsv(csv), "error_mm");
  ASSERT_EQ(lines.size(), error.size());
  double before = 0.0;
  double after = 0.0;
  double wrong_sign = 0.0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    char* end = nullptr;
    std::strtod(lines[i].c_str(), &end);
    const double compensation = std::strtod(end, nullptr);
    before += error[i] * error[i];
    after += std::pow(error[i] + compensation, 2.0);
    wrong_sign += std::pow(error[i] - compensation, 2.0);
  }
  EXPECT_LT(after, 0.05 * before);
  EXPECT_GT(wrong_sign, 3.0 * before);
}

}  // namespace
}  // namespace errmap
