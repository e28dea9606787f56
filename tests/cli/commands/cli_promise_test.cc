// What a map promises, and how it is held to it: predict's flags, evaluate's
// words, check, and predict --probes.

#include <algorithm>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/commands/promise_days.h"
#include "tests/cli/one_line.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(CliPromise, PredictNamesWhatPutsARowOutside) {
  Write("well.csv", DaysInCliPromise(3, 3));
  Write("raised.csv", DaysInCliPromise(3, 3, 0.0, 3.0));
  const Outcome well = Run({"predict", "map.json", "well.csv"});
  for (const auto& row : Records(well.out)) {
    EXPECT_EQ(row.at("inside"), "1");
    EXPECT_EQ(row.at("why"), "");
    EXPECT_EQ(row.at("offender"), "");
  }
  EXPECT_THAT(well.err, Not(HasSubstr("warning")));
  const Outcome raised = Run({"predict", "map.json", "raised.csv"});
  int named = 0;
  for (const auto& row : Records(raised.out)) {
    EXPECT_EQ(row.at("inside"), "0");
    named += row.at("offender") == "t2_degC" ? 1 : 0;
  }
  EXPECT_GE(named, kCliPromiseRowsPerDay / 2);
  EXPECT_THAT(raised.err,
              HasSubstr("unlike those in training, the worst is data row"));
}

// No held-out row tells how the map errs where it is clipped.
TEST_F(CliPromise, PredictStatesNoIntervalFarBeyondTheTraining) {
  Write("dead.csv", DaysInCliPromise(3, 3, 0.0, -500.0));
  const Outcome dead = Run({"predict", "map.json", "dead.csv"});
  for (const auto& row : Records(dead.out)) {
    EXPECT_NE(row.at("predicted"), "");
    EXPECT_EQ(row.at("lower_90"), "");
    EXPECT_EQ(row.at("upper_95"), "");
  }
  EXPECT_THAT(dead.err, HasSubstr("trained range; no interval there"));
  EXPECT_LT(dead.err.find(" first: "), dead.err.find(" predicted as "));
}

// What held-out rows showed of rows unlike their training, predict says of such
// rows alone, and evaluate counts by it.
TEST_F(CliPromise, TheIntervalIsWiderWhereTheMapWasNotTrained) {
  Write("few.csv", DaysInCliPromise(1, 5));
  FitPlane("few.csv");
  const Json interval = Json::parse(Read("plane.json"))["interval"];
  const double inside = interval["inside"]["90"];
  const double outside = interval["outside"]["90"];
  EXPECT_LT(inside, interval["90"].get<double>());
  EXPECT_GT(outside, interval["90"].get<double>());
  // On one of the days a thermometer has moved.
  const std::string moved = DaysInCliPromise(12, 12, 0.0, 3.0);
  Write("day.csv",
        DaysInCliPromise(11, 11) + moved.substr(moved.find('\n') + 1));
  const Outcome outcome = Run({"predict", "plane.json", "day.csv"});
  EXPECT_THAT(outcome.err, HasSubstr("where inside = 1"));
  const std::vector<std::string> days = SplitLines(Read("day.csv"));
  int rows = 0;
  int outside_rows = 0;
  int within = 0;
  for (const auto& row : Records(outcome.out)) {
    const double lower = std::stod(row.at("lower_90"));
    const double upper = std::stod(row.at("upper_90"));
    const bool is_inside = row.at("inside") == "1";
    EXPECT_NEAR(upper - lower, 2.0 * (is_inside ? inside : outside), 1e-9);
    const std::string& line = days[static_cast<std::size_t>(++rows)];
    const double error = std::stod(line.substr(line.rfind(',') + 1));
    within += lower <= error && error <= upper ? 1 : 0;
    outside_rows += is_inside ? 0 : 1;
  }
  EXPECT_GT(outside_rows, 0);
  EXPECT_LT(outside_rows, rows);
  EXPECT_NEAR(RunJson({"evaluate",
                       "plane.json",
                       "day.csv",
                       "--format",
                       "json"})["promise"]["within_90"]
                  .get<double>(),
              static_cast<double>(within) / rows,
              1e-12);
}

TEST_F(CliPromise, EvaluateHoldsTheMapToItsPromise) {
  Write("well.csv", DaysInCliPromise(11, 12));
  const Json well =
      RunJson({"evaluate", "map.json", "well.csv", "--format", "json"});
  EXPECT_EQ(well["promise"]["shape"], "within");
  EXPECT_GT(well["promise"]["within_90"].get<double>(), 0.7);
  Write("moved.csv", DaysInCliPromise(11, 12, 9.0));
  const Outcome moved = Run({"evaluate", "map.json", "moved.csv"});
  EXPECT_THAT(OneLine(moved.out),
              AllOf(HasSubstr("RMSE, expected "),
                    HasSubstr("no compensation"),
                    HasSubstr("re-zero")));
  Write("raised.csv", DaysInCliPromise(11, 12, 0.0, 3.0));
  // Errors of wrong readings order nothing.
  EXPECT_THAT(OneLine(Run({"evaluate", "map.json", "raised.csv"}).out),
              AllOf(HasSubstr("Check t2_degC first"),
                    Not(HasSubstr("re-zero")),
                    Not(HasSubstr("no compensation"))));
}

// What fit says of a sensor that fails to 0 is what export does.
TEST_F(CliPromise, FitAndExportTellTheSameOfASensorThatFails) {
  const Json fitted = RunJson({"fit",
                               "train.csv",
                               "--model",
                               "poly:full:degree=1",
                               "-o",
                               "plane.json",
                               "--format",
                               "json"});
  const std::string said =
      OneLine(Run({"export", "plane.json", "--c", "-o", "control"}).err);
  std::smatch found;
  ASSERT_TRUE(std::regex_search(
      said,
      found,
      std::regex("a failing (t[123]_degC) could shift the compensation by "
                 "([0-9.]+) um; checks and limits keep it within ([0-9.]+) "
                 "um")))
      << said;
  const Json& sensitivity = fitted["sensitivity"];
  EXPECT_EQ(found[1].str(), sensitivity["jump_of"]);
  const double unchecked = std::stod(found[2]);
  EXPECT_GE(unchecked, 0.97 * sensitivity["largest_jump"].get<double>());
  EXPECT_LT(std::stod(found[3]), unchecked);
}

// Any constant and any offset fits one row.
TEST_F(CliPromise, EvaluateAdvisesNothingByTooFewRows) {
  const std::string day = DaysInCliPromise(11, 11, 9.0);
  const auto first = [&](int rows) {
    std::size_t end = 0;
    for (int line = 0; line <= rows; ++line) end = day.find('\n', end) + 1;
    Write("few.csv", day.substr(0, end));
    return OneLine(Run({"evaluate", "map.json", "few.csv"}).out);
  };
  EXPECT_THAT(first(1),
              AllOf(HasSubstr("1 row cannot show whether an offset explains"),
                    Not(HasSubstr("a constant would be better")),
                    Not(HasSubstr("re-zero, which leaves"))));
  EXPECT_THAT(first(23), Not(HasSubstr("re-zero, which leaves")));
  EXPECT_THAT(first(24), Not(HasSubstr("cannot tell")));
}

TEST_F(CliPromise, CheckTellsWhetherTheMapHolds) {
  Write("well.csv", DaysInCliPromise(11, 11, 0.0, 0.0, 3));
  const Outcome well = Run({"check", "map.json", "well.csv"});
  EXPECT_EQ(well.status, 0) << well.out;
  EXPECT_THAT(OneLine(well.out), HasSubstr("The map holds in this session"));
  Write("moved.csv", DaysInCliPromise(11, 11, 9.0, 0.0, 3));
  const Outcome moved = Run({"check", "map.json", "moved.csv"});
  EXPECT_EQ(moved.status, kEveryFitFailed);
  EXPECT_THAT(OneLine(moved.out),
              AllOf(HasSubstr("does not hold"),
                    HasSubstr("re-zero by"),
                    HasSubstr("0 to 39 min after the session began")));
}

// A map of a temperature alone: where a probe was taken still tells a shape.
TEST_F(CliPromise, CheckReadsPositionsThatTheMapDoesNot) {
  const Outcome fit = Run({"fit",
                           "train.csv",
                           "--model",
                           "poly:formula=t1_degC",
                           "-o",
                           "one.json"});
  ASSERT_EQ(fit.status, 0) << fit.err;
  const std::string day = DaysInCliPromise(11, 11, 0.0, 0.0, 3);
  std::string elsewhere = "day,time_s,position_mm,t1_degC,t2_degC,t3_degC,";
  elsewhere += day.substr(day.find("error_um"), 9);
  for (const auto& row : Records(day)) {
    elsewhere += row.at("day") + "," + row.at("time_s") + ",0," +
                 row.at("t1_degC") + "," + row.at("t2_degC") + "," +
                 row.at("t3_degC") + "," + row.at("error_um") + "\n";
  }
  Write("day.csv", day);
  Write("elsewhere.csv", elsewhere);
  const auto forecast = [&](const char* probes) {
    const Outcome found =
        Run({"check", "one.json", probes, "--format", "json", "--quiet"});
    return nlohmann::json::parse(found.out).at("session_rmse_80");
  };
  EXPECT_NE(forecast("day.csv"), forecast("elsewhere.csv"));
}

// The first rows of a day tell nothing of its rest: no all-clear for scripts.
TEST_F(CliPromise, CheckOfTheFirstMinutesIsNoAllClear) {
  const std::string day = DaysInCliPromise(11, 11);
  std::size_t end = 0;
  for (int line = 0; line < 6; ++line) end = day.find('\n', end) + 1;
  Write("first.csv", day.substr(0, end));
  const Outcome found = Run({"check", "map.json", "first.csv"});
  EXPECT_EQ(found.status, kNothingJudged) << found.out;
  EXPECT_THAT(OneLine(found.out),
              Not(HasSubstr("The map holds in this session")));
}

// Days that are over tell nothing of this one.
TEST_F(CliPromise, CheckJudgesTheLastSessionAndSaysSo) {
  const std::string moved = DaysInCliPromise(11, 12, 9.0);
  const std::string well = DaysInCliPromise(13, 13);
  Write("three.csv", moved + well.substr(well.find('\n') + 1));
  Write("last.csv", well);
  const Outcome found = Run({"check", "map.json", "three.csv"});
  EXPECT_EQ(found.status, 0) << found.out;
  EXPECT_THAT(OneLine(found.out),
              AllOf(HasSubstr("This judges the last of 3 sessions, day '13'. "
                              "errmap evaluate judges the others."),
                    HasSubstr("on 40 probes of three.csv")));
  const Json of_three =
      RunJson({"check", "map.json", "three.csv", "--format", "json"});
  const Json alone =
      RunJson({"check", "map.json", "last.csv", "--format", "json"});
  EXPECT_EQ(of_three["session"], "13");
  EXPECT_EQ(of_three["other_sessions"], 2);
  EXPECT_EQ(alone["other_sessions"], 0);
  EXPECT_EQ(of_three["probes"], alone["probes"]);
  EXPECT_EQ(of_three["session_rmse_80"], alone["session_rmse_80"]);
}

// Of one probe there is one time, and the next one lies after it.
TEST_F(CliPromise, CheckOfOneProbeAsksForMoreOfThem) {
  const std::string days = SetPath("turning_centre/six_days.csv");
  const std::string later =
      Process::TextOf(SetPath("turning_centre/later_days.csv"));
  ASSERT_EQ(Run({"fit", days, "--model", "poly:eq8", "-o", "days.json"}).status,
            0);
  Write("one.csv", later.substr(0, later.find('\n', later.find('\n') + 1) + 1));
  const std::string text = OneLine(Run({"check", "days.json", "one.csv"}).out);
  EXPECT_THAT(text,
              AllOf(HasSubstr("1 probe of one.csv, 0 s after the session"),
                    HasSubstr("Take more probes, at other positions"),
                    Not(HasSubstr("Probe again"))));
}

// A broken thermometer explains what the map errs by: no order is given.
TEST_F(CliPromise, CheckNamesASensorBeforeItOrdersAnything) {
  Write("raised.csv", DaysInCliPromise(11, 11, 0.0, 10.0, 3));
  const Outcome text = Run({"check", "map.json", "raised.csv"});
  EXPECT_EQ(text.status, kEveryFitFailed);
  EXPECT_THAT(
      OneLine(text.out),
      AllOf(HasSubstr("Check t2_degC first"), Not(HasSubstr("re-zero"))));
  const Json found = Json::parse(
      Run({"check", "map.json", "raised.csv", "--format", "json"}).out);
  EXPECT_EQ(found["status"], "sensor");
  EXPECT_EQ(found["sensors"], Json::array({"t2_degC"}));
}

// What a bus returns for no answer, once: neither an offset nor a wrong scale,
// and no harm to the rows after it.
TEST_F(CliPromise, CheckAndPredictNameOneReadingThatIsNone) {
  const std::string day = DaysInCliPromise(11, 11);
  std::vector<std::string> lines = SplitLines(day);
  std::vector<std::string> cells;
  std::istringstream row(lines[8]);
  for (std::string text; std::getline(row, text, ',');) cells.push_back(text);
  cells[4] = "-127";  // t2_degC
  lines[8] = fmt::format("{}", fmt::join(cells, ","));
  Write("once.csv", fmt::format("{}\n", fmt::join(lines, "\n")));
  const Outcome check = Run({"check", "map.json", "once.csv"});
  EXPECT_EQ(check.status, kEveryFitFailed);
  EXPECT_THAT(
      OneLine(check.out),
      HasSubstr("Check t2_degC first: it reads -127 degC in data row 7"));
  const Outcome without =
      Run({"check", "map.json", "once.csv", "--faults", "drop-rows"});
  EXPECT_THAT(OneLine(without.out), HasSubstr("The map holds"));
  // A memory forgets it at once.
  ASSERT_EQ(Run({"fit",
                 "train.csv",
                 "--model",
                 "poly:ridge:view=history:history=1200",
                 "-o",
                 "lag.json"})
                .status,
            0);
  Write("day.csv", day);
  const auto last = [&](const char* file) {
    const auto rows = Records(Run({"predict", "lag.json", file}).out);
    return std::stod(rows.back().at("predicted"));
  };
  EXPECT_NEAR(last("once.csv"), last("day.csv"), 0.1);
}

// The file with errors in these rows alone; the others go, or stay without.
std::string ProbesOf(const std::string& text,
                     const std::vector<std::size_t>& rows,
                     bool with_others) {
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  std::string probes = line + "\n";
  for (std::size_t row = 0; std::getline(lines, line); ++row) {
    const bool is_probe = std::ranges::find(rows, row) != rows.end();
    if (is_probe) {
      probes += line + "\n";
    } else if (with_others) {
      probes += line.substr(0, line.rfind(',')) + ",\n";
    }
  }
  return probes;
}

// The zero of a session is taken at its first row, not at its first probe.
TEST_F(CliPromise, CheckAndProbesKnowWhereTheSessionBegan) {
  const std::string memory = "poly:ridge:degree=2:view=zero";
  ASSERT_EQ(
      Run({"fit", "train.csv", "--model", memory, "-o", "zero.json"}).status,
      0);
  const std::string day = DaysInCliPromise(11, 11);
  const std::vector<std::size_t> rows = {12, 20, 26, 33};
  Write("day.csv", day);
  Write("all.csv", ProbesOf(day, rows, true));
  Write("only.csv", ProbesOf(day, rows, false));
  const auto predicted = Records(Run({"predict", "zero.json", "day.csv"}).out);
  const auto measured = Records(day);
  double mean = 0.0;
  for (const std::size_t row : rows) {
    mean += (std::stod(measured[row].at("error_um")) -
             std::stod(predicted[row].at("predicted"))) /
            static_cast<double>(rows.size());
  }
  const Json check =
      RunJson({"check", "zero.json", "all.csv", "--format", "json"});
  EXPECT_NEAR(check["probes"]["mean"].get<double>(), mean, 1e-9);
  EXPECT_FALSE(check["begins_inside"].get<bool>());

  const Outcome only = Run({"check", "zero.json", "only.csv"});
  EXPECT_EQ(only.status, 5);
  EXPECT_THAT(only.out, HasSubstr("Not known whether the map holds"));
  EXPECT_THAT(only.out, Not(HasSubstr("re-zero by")));
  EXPECT_THAT(only.err, HasSubstr("session '11' seems to have begun before"));

  const Outcome by_all =
      Run({"predict", "zero.json", "day.csv", "--probes", "all.csv"});
  const Outcome by_only =
      Run({"predict", "zero.json", "day.csv", "--probes", "only.csv"});
  EXPECT_EQ(by_all.status, 0) << by_all.err;
  EXPECT_EQ(by_only.out, by_all.out);
  EXPECT_THAT(by_only.err, Not(HasSubstr("seems to have begun before")));
}

// A filter that has seen nothing between two probes says something else than in
// use: no alarm, and no all-clear, comes of it.
// A pause that the user named parts the sessions of later files, too.
TEST_F(CliPromise, TheMapKeepsThePauseThatPartsSessions) {
  const std::string days = SetPath("turning_centre/six_days.csv");
  ASSERT_EQ(Run({"fit",
                 days,
                 "--session",
                 "none",
                 "--gap",
                 "2h",
                 "--model",
                 "poly:ridge:view=history",
                 "--no-interval",
                 "-o",
                 "gap.json"})
                .status,
            0);
  EXPECT_EQ(Json::parse(Read("gap.json"))["history"]["gap"], 7200.0);
}

TEST_F(CliPromise, CheckKnowsNothingWhereReadingsBetweenProbesAreMissing) {
  ASSERT_EQ(Run({"fit",
                 "train.csv",
                 "--model",
                 "poly:ridge:view=history:history=120",
                 "-o",
                 "lag.json"})
                .status,
            0);
  const std::string day = DaysInCliPromise(11, 11);
  const std::vector<std::size_t> rows = {0, 12, 20, 33};
  Write("all.csv", ProbesOf(day, rows, true));
  Write("only.csv", ProbesOf(day, rows, false));
  const Json all =
      RunJson({"check", "lag.json", "all.csv", "--format", "json"});
  EXPECT_FALSE(all["readings_missing"].get<bool>());
  const Json only = Json::parse(
      Run({"check", "lag.json", "only.csv", "--format", "json"}).out);
  EXPECT_TRUE(only["readings_missing"].get<bool>());
  EXPECT_EQ(only["status"], "unknown");
  const Outcome text = Run({"check", "lag.json", "only.csv"});
  EXPECT_EQ(text.status, kNothingJudged);
  EXPECT_THAT(OneLine(text.out), HasSubstr("the readings between the probes"));
  EXPECT_THAT(
      text.err,
      HasSubstr("warning: 3 of 4 rows come after a gap in the readings"));
  std::vector<std::string> why;
  for (const auto& row :
       Records(Run({"predict", "lag.json", "only.csv"}).out)) {
    why.push_back(row.at("why"));
  }
  EXPECT_THAT(why, ElementsAre("", "gap", "gap", "gap"));
}

TEST_F(CliPromise, CheckSaysWhichProbesTheMapLearntFrom) {
  Write("known.csv", DaysInCliPromise(10, 11, 0.0, 0.0, 13));
  EXPECT_THAT(OneLine(Run({"check", "map.json", "known.csv"}).out),
              HasSubstr("The map was fitted to 4 of 8 rows"));
  Write("new.csv", DaysInCliPromise(11, 11, 0.0, 0.0, 13));
  EXPECT_THAT(Run({"check", "map.json", "new.csv"}).out,
              Not(HasSubstr("trained on")));
}

// Between measurements no axis has a position worth logging.
TEST_F(CliPromise, TheLogOfTemperaturesNeedsNoPositions) {
  ASSERT_EQ(Run({"fit",
                 "train.csv",
                 "--model",
                 "poly:ridge:view=history+zero:history=120",
                 "-o",
                 "lag.json"})
                .status,
            0);
  const std::vector<std::string> lines = SplitLines(DaysInCliPromise(11, 11));
  std::string log;
  std::string earlier = lines[0] + "\n";
  std::string probes = lines[0] + "\n";
  constexpr std::size_t kLogged = 20;
  for (std::size_t row = 0; row < lines.size(); ++row) {
    if (row > kLogged) {
      probes += lines[row] + "\n";
      continue;
    }
    if (row > 0) earlier += lines[row] + "\n";
    // day,time_s,position_mm,...
    const std::size_t position = lines[row].find(',', lines[row].find(',') + 1);
    log += lines[row].substr(0, position) +
           lines[row].substr(lines[row].find(',', position + 1)) + "\n";
  }
  Write("log.csv", log);
  Write("earlier.csv", earlier);
  Write("probes.csv", probes);
  const Outcome with =
      Run({"check", "lag.json", "probes.csv", "--after", "earlier.csv"});
  const Outcome without =
      Run({"check", "lag.json", "probes.csv", "--after", "log.csv"});
  EXPECT_THAT(with.out, HasSubstr("20 probes")) << with.err;
  EXPECT_EQ(without.status, with.status) << without.err;
  EXPECT_EQ(without.out, with.out);
}

TEST_F(CliPromise, CheckNeedsHeldOutErrors) {
  ASSERT_EQ(Run({"fit",
                 "train.csv",
                 "--model",
                 "mean",
                 "-o",
                 "bare.json",
                 "--no-interval"})
                .status,
            0);
  Write("probes.csv", DaysInCliPromise(11, 11, 0.0, 0.0, 13));
  EXPECT_THAT(RefusalOf(Run({"check", "bare.json", "probes.csv", "--quiet"}),
                        kUnusable),
              HasSubstr("has no held-out errors to judge probes by"));
}

TEST_F(CliPromise, ProbesMoveLaterRowsAndNarrowTheInterval) {
  const std::string all = DaysInCliPromise(11, 11, 9.0);
  const std::vector<std::string> lines = SplitLines(all);
  std::string probes = lines[0] + "\n";
  std::string later = lines[0] + "\n";
  for (int row = 0; row < kCliPromiseRowsPerDay; ++row) {
    (row < 8 ? probes : later) +=
        lines[static_cast<std::size_t>(row) + 1] + "\n";
  }
  Write("probes.csv", probes);
  Write("later.csv", later);
  const auto before = Records(Run({"predict", "map.json", "later.csv"}).out);
  const Outcome outcome =
      Run({"predict", "map.json", "later.csv", "--probes", "probes.csv"});
  EXPECT_THAT(outcome.err, HasSubstr("8 probes move 32 of 32 rows"));
  const auto after = Records(outcome.out);
  const double moved = std::stod(after[0].at("predicted")) -
                       std::stod(before[0].at("predicted"));
  EXPECT_GT(moved, 5.0);
  EXPECT_LT(moved, 12.0);
  const auto width = [](const auto& row) {
    return std::stod(row.at("upper_90")) - std::stod(row.at("lower_90"));
  };
  EXPECT_LT(width(after[0]), width(before[0]));
}

// A single row of each day does not show that its column names days.
TEST_F(CliPromise, OneProbeOfEachOfSeveralDaysMovesTheDay) {
  std::string probes;
  std::string later;
  for (const int day : {11, 12}) {
    const std::vector<std::string> lines =
        SplitLines(DaysInCliPromise(day, day, 9.0));
    if (later.empty()) probes = later = lines[0] + "\n";
    for (std::size_t row = 1; row < lines.size(); ++row) {
      (row == 1 ? probes : later) += lines[row] + "\n";
    }
  }
  Write("probes.csv", probes);
  Write("later.csv", later);
  // Without a memory the map knows no column of sessions.
  FitPlane("train.csv");
  const Outcome outcome =
      Run({"predict", "plane.json", "later.csv", "--probes", "probes.csv"});
  EXPECT_THAT(outcome.err, HasSubstr("2 probes move 78 of 78 rows"));
  Write("probes.csv",
        probes.substr(0, probes.rfind('\n', probes.size() - 2) + 1));
  EXPECT_THAT(
      Run({"predict", "plane.json", "later.csv", "--probes", "probes.csv"}).err,
      HasSubstr("1 probe moves 39 of 78 rows"));
}

}  // namespace
}  // namespace errmap
