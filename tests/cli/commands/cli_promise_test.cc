// What a map promises, and how it is held to it: predict's flags, evaluate's
// words, check, and predict --probes.

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "tests/cli/cli_fixture.h"
#include "tests/cli/one_line.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kCliPromiseRowsPerDay = 40;

// DaysInCliPromise of three thermometers that warm together, each day in its
// own way, and an error that is theirs and the position's and a little more;
// `offset` (um) moves the errors, `raise` (degC) the second thermometer.
std::string DaysInCliPromise(int first,
                             int last,
                             double offset = 0.0,
                             double raise = 0.0,
                             int step = 1) {
  std::string text =
      "day,time_s,position_mm,t1_degC,t2_degC,t3_degC,error_um\n";
  for (int day = first; day <= last; ++day) {
    const double pace = 8.0 + 3.0 * std::sin(2.3 * day);
    for (int row = 0; row < kCliPromiseRowsPerDay; row += step) {
      const double warm = 1.0 - std::exp(-row / pace);
      const double slow = 1.0 - std::exp(-row / (3.0 * pace));
      const double air = 20.0 + std::sin(1.7 * day);
      const double x = 40.0 * (row % 5);
      const double t1 = air + 8.0 * warm + 0.05 * std::sin(7.1 * row + day);
      const double t2 = air + 5.0 * warm + 0.05 * std::sin(5.3 * row + day);
      const double t3 = air + 4.0 * slow + 0.05 * std::sin(3.7 * row + day);
      const double rest =
          0.5 * std::sin(0.8 * day) + 0.3 * std::sin(12.7 * row + 3.1 * day);
      const double error = 2.0 * (t1 - 20.0) + 0.02 * x * (t3 - 20.0) + rest;
      text += std::to_string(day) + "," + std::to_string(60 * row);
      for (const double value : {x, t1, t2 + raise, t3, error + offset}) {
        text += "," + data::CsvNumber(value);
      }
      text += "\n";
    }
  }
  return text;
}

class CliPromise : public Cli {
 protected:
  void SetUp() override {
    Write("train.csv", DaysInCliPromise(1, 10));
    const Outcome outcome = Run({"fit",
                                 "train.csv",
                                 "--model",
                                 "poly:ridge:degree=2",
                                 "-o",
                                 "map.json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
};

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
  EXPECT_THAT(raised.err, HasSubstr("warning: farthest outside is data row"));
}

// What held-out rows showed of rows unlike their training, predict says of such
// rows alone, and evaluate counts by it.
TEST_F(CliPromise, TheIntervalIsWiderWhereTheMapWasNotTrained) {
  Write("few.csv", DaysInCliPromise(1, 5));
  ASSERT_EQ(Run({"fit",
                 "few.csv",
                 "--model",
                 "poly:full:degree=1",
                 "-o",
                 "plane.json"})
                .status,
            0);
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
  EXPECT_TRUE(well["changed_relation"].is_null());
  Write("moved.csv", DaysInCliPromise(11, 12, 9.0));
  const Outcome moved = Run({"evaluate", "map.json", "moved.csv"});
  EXPECT_THAT(OneLine(moved.out),
              AllOf(HasSubstr("promised"),
                    HasSubstr("no compensation"),
                    HasSubstr("re-zero")));
  Write("raised.csv", DaysInCliPromise(11, 12, 0.0, 3.0));
  EXPECT_THAT(Run({"evaluate", "map.json", "raised.csv"}).out,
              HasSubstr("what the other inputs tell"));
}

TEST_F(CliPromise, CheckTellsWhetherTheMapHolds) {
  Write("well.csv", DaysInCliPromise(11, 11, 0.0, 0.0, 13));
  const Outcome well = Run({"check", "map.json", "well.csv"});
  EXPECT_EQ(well.status, 0) << well.out;
  EXPECT_THAT(OneLine(well.out),
              AllOf(HasSubstr("The map holds in this session"),
                    HasSubstr("with a probability of less than 1 %.")));
  Write("moved.csv", DaysInCliPromise(11, 11, 9.0, 0.0, 13));
  const Outcome moved = Run({"check", "map.json", "moved.csv"});
  EXPECT_EQ(moved.status, kEveryFitFailed);
  EXPECT_THAT(OneLine(moved.out),
              AllOf(HasSubstr("does not hold"),
                    HasSubstr("with a probability of more than 99 %."),
                    HasSubstr("re-zero by"),
                    HasSubstr("0 to 39 min after the session began")));
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
  const std::vector<std::size_t> rows = {12, 20, 33};
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
  EXPECT_EQ(only.status, kNothingJudged);
  EXPECT_THAT(only.out, HasSubstr("Not known whether the map holds"));
  EXPECT_THAT(only.err, HasSubstr("warning: session '11' begins inside"));

  const Outcome by_all =
      Run({"predict", "zero.json", "day.csv", "--probes", "all.csv"});
  const Outcome by_only =
      Run({"predict", "zero.json", "day.csv", "--probes", "only.csv"});
  EXPECT_EQ(by_all.status, 0) << by_all.err;
  EXPECT_EQ(by_only.out, by_all.out);
  EXPECT_THAT(by_only.err, Not(HasSubstr("begins inside")));
}

// A filter that has seen nothing between two probes says something else than in
// use: no alarm, and no all-clear, comes of it.
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
              HasSubstr("4 of 8 rows are ones that the map was trained on"));
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
              HasSubstr("without --no-interval"));
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
  ASSERT_EQ(Run({"fit",
                 "train.csv",
                 "--model",
                 "poly:full:degree=1",
                 "-o",
                 "plane.json"})
                .status,
            0);
  const Outcome outcome =
      Run({"predict", "plane.json", "later.csv", "--probes", "probes.csv"});
  EXPECT_THAT(outcome.err, HasSubstr("2 probes move 78 of 78 rows"));
  Write("probes.csv",
        probes.substr(0, probes.rfind('\n', probes.size() - 2) + 1));
  EXPECT_THAT(
      Run({"predict", "plane.json", "later.csv", "--probes", "probes.csv"}).err,
      HasSubstr("1 probe moves 39 of 78 rows"));
}

TEST_F(CliPromise, LearnsFromDaysOneAfterAnother) {
  const std::vector<std::string> learn = {"learn",
                                          "train.csv",
                                          "--by",
                                          "sessions",
                                          "--models",
                                          "mean,poly:full:degree=1",
                                          "--goal",
                                          "0.001",
                                          "--out",
                                          "study"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = learn;
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const Json found = RunJson(with({"--format", "json"}));
  const Json& curves = found["curves"];
  EXPECT_EQ(curves["unit"], "day");
  EXPECT_EQ(curves["units"], 10);
  ASSERT_EQ(curves["models"].size(), 2U);
  const Json& linear = curves["models"][1];
  EXPECT_LT(linear["points"].back()["rmse"], linear["points"][0]["rmse"]);
  EXPECT_GT(linear["law"]["never_reaches_goal"].get<double>(), 0.5);
  EXPECT_TRUE(Exists("study/learn-sessions.json"));
  EXPECT_THAT(Read("study/learn-sessions.svg"), HasSubstr("<svg"));
  // The same again from the fits that were kept.
  const Outcome again = Run(with({"--resume"}));
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_THAT(again.out,
              AllOf(HasSubstr("on an unseen day"), HasSubstr("expected")));
}

TEST_F(CliPromise, LearnsWhichSensorsDoIt) {
  const Outcome outcome = Run({"learn", "train.csv", "--by", "sensors"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("of 3 sensors do it"), HasSubstr("t1_degC")));
  const std::string begin = "With these alone:\n  errmap ";
  const std::size_t at = outcome.out.find(begin);
  ASSERT_NE(at, std::string::npos) << outcome.out;
  std::istringstream line(outcome.out.substr(at + begin.size()));
  std::vector<std::string> words;
  for (std::string word; line >> word;) words.push_back(word);
  EXPECT_THAT(words.at(0) + " " + words.at(1), "compare train.csv");
  EXPECT_THAT(words.back(),
              AllOf(HasSubstr("position_mm"), HasSubstr("t1_degC")));
  words.insert(words.end(), {"--models", "poly:full:degree=1", "--quiet"});
  EXPECT_EQ(Run(words).status, 0);
}

TEST_F(CliPromise, PutsWhatWasLearntOnThePageOfTheStudy) {
  const std::vector<std::string> compare{"compare",
                                         "train.csv",
                                         "--models",
                                         "mean,poly:full:degree=1",
                                         "--out",
                                         "study",
                                         "--quiet"};
  ASSERT_EQ(Run(compare).status, 0);
  const std::string before = Read("study/report.html");
  EXPECT_THAT(before, HasSubstr("What the error would be without a sensor"));
  EXPECT_THAT(before, Not(HasSubstr("What fewer sensors would do")));
  for (const char* by : {"sensors", "sessions"}) {
    ASSERT_EQ(Run({"learn",
                   "train.csv",
                   "--by",
                   by,
                   "--models",
                   "mean,poly:full:degree=1",
                   "--out",
                   "study",
                   "--quiet"})
                  .status,
              0);
  }
  EXPECT_EQ(Run({"report", "study"}).status, 0);
  const std::string page = Read("study/report.html");
  EXPECT_THAT(page,
              AllOf(HasSubstr("What fewer sensors would do"),
                    HasSubstr("of 3 sensors do it, within 5\u00a0% of all"),
                    HasSubstr("What each further day would bring"),
                    HasSubstr("with all 10:")));
  EXPECT_EQ(Run({"report", "study", "--format", "html"}).out, page);
  // Of other data it tells nothing.
  Write("train.csv", DaysInCliPromise(2, 11));
  ASSERT_EQ(Run(compare).status, 0);
  EXPECT_THAT(Read("study/report.html"),
              Not(HasSubstr("What fewer sensors would do")));
  Write("study/learn-sensors.json", "{ half");
  const Outcome torn = Run({"report", "study"});
  EXPECT_EQ(torn.status, 0);
  EXPECT_THAT(torn.err, HasSubstr("learn-sensors.json is not drawn: is no"));
}

TEST_F(CliPromise, LearnsWhatToMeasureNext) {
  Write("next.csv",
        "position_mm,t1_degC,t2_degC,t3_degC\n"
        "80,24,23,22\n80,45,38,34\n40,24,23,22\n");
  const Json found =
      RunJson({"learn", "train.csv", "--next", "next.csv", "--format", "json"});
  EXPECT_EQ(found["next"][0]["row"], 1);
  EXPECT_THAT(RefusalOf(Run({"learn", "train.csv"}), kWrongCommandLine),
              HasSubstr("--by sessions|cycles|sensors"));
}

TEST_F(CliPromise, UpdatesAMapThatNewSessionsMakeBetter) {
  Write("new.csv", DaysInCliPromise(11, 14, 9.0));
  const Json moved = RunJson({"update",
                              "map.json",
                              "new.csv",
                              "-o",
                              "new.json",
                              "--known",
                              "new.csv",
                              "--format",
                              "json"});
  EXPECT_EQ(moved["updated"], true);
  EXPECT_LT(moved["new_rmse"], moved["old_rmse"]);
  const Json judged =
      RunJson({"evaluate", "new.json", "new.csv", "--format", "json"});
  EXPECT_LT(judged["summary"]["rmse"].get<double>(), 2.0);
}

// What an updated map learnt from is not forgotten by its next update.
TEST_F(CliPromise, UpdatesOnceMoreFromAllThatWasLearnt) {
  const auto update = [this](const std::string& map, const std::string& data) {
    return RunJson(
        {"update", map, data, "-o", "newer.json", "--format", "json"});
  };
  const auto files = [](const Json& updated) {
    std::vector<std::string> names;
    for (const Json& input : updated["provenance"]["inputs"]) {
      names.push_back(input["file"]);
    }
    return names;
  };
  Write("new.csv", DaysInCliPromise(11, 14, 9.0));
  Write("newer.csv", DaysInCliPromise(15, 16, 30.0));
  const Json once = update("map.json", "new.csv");
  ASSERT_EQ(once["updated"], true);
  EXPECT_THAT(files(once), ElementsAre("map.json", "train.csv", "new.csv"));
  Write("once.json", Read("newer.json"));
  EXPECT_THAT(files(update("once.json", "newer.csv")),
              ElementsAre("once.json", "train.csv", "new.csv", "newer.csv"));
  // A file that changed is named, and the rest still serves.
  Write("train.csv", DaysInCliPromise(1, 9));
  const Outcome lost =
      Run({"update", "once.json", "newer.csv", "-o", "newer.json"});
  EXPECT_EQ(lost.status, 0) << lost.err;
  EXPECT_THAT(lost.err,
              HasSubstr("warning: 'train.csv' is not at hand as it was"));
  EXPECT_THAT(Run({"update",
                   "once.json",
                   "newer.csv",
                   "-o",
                   "newer.json",
                   "--known",
                   "train.csv",
                   "--known",
                   "new.csv"})
                  .err,
              Not(HasSubstr("warning")));
}

TEST_F(CliPromise, KeepsTheOldMapUnlessTheNewOneIsBetter) {
  // DaysInCliPromise of the same kind: what ten days know, two more hardly
  // better.
  Write("same.csv", DaysInCliPromise(1, 2));
  const Outcome outcome =
      Run({"update", "map.json", "same.csv", "-o", "same.json"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("same.json is the old one"));
  EXPECT_EQ(Read("same.json"), Read("map.json"));
  Write("one.csv", DaysInCliPromise(11, 11));
  EXPECT_THAT(
      RefusalOf(
          Run({"update", "map.json", "one.csv", "-o", "one.json", "--quiet"}),
          kUnusable),
      HasSubstr("two new sessions"));
}

TEST_F(CliPromise, ComparesMapsThatAreRezeroed) {
  const std::vector<std::string> words = {"compare",
                                          "train.csv",
                                          "--models",
                                          "zero,poly:full:degree=2",
                                          "--rezero",
                                          "15min:noise=0.01um",
                                          "--quiet"};
  std::vector<std::string> as_json = words;
  as_json.insert(as_json.end(), {"--format", "json"});
  const Json record = RunJson(as_json);
  const Json component = record["components"][0];
  const Json& rezero = component["rezero"];
  EXPECT_EQ(rezero["interval"], 900.0);
  EXPECT_NEAR(rezero["noise"].get<double>(), 0.01, 1e-12);
  EXPECT_EQ(record["provenance"]["configuration"]["rezero"],
            "15min:noise=0.01um");
  // Of what this map leaves, each day has an offset of its own.
  const Json& map = rezero["models"][1];
  EXPECT_EQ(map["model"], "poly:full:degree=2");
  EXPECT_LT(map["rmse"], 0.8 * map["never"].get<double>()) << map;
  EXPECT_LT(map["rmse"], rezero["no_map"]);
  EXPECT_NEAR(component["recommendation"]["rmse"].get<double>(),
              map["rmse"].get<double>(),
              1e-9);
  const std::string text = OneLine(Run(words).out);
  EXPECT_THAT(text,
              AllOf(HasSubstr("All of this is re-zeroed every 15 min by "
                              "probes of 0.01"),
                    HasSubstr("does what a probe every 15 min does without"),
                    HasSubstr("no re-zero")));
}

TEST_F(CliPromise, RefusesToRezeroWithoutTimesOrRows) {
  const auto refusal = [&](const char* file, const char* rule, int status) {
    return RefusalOf(
        Run({"compare", file, "--models", "mean", "--rezero", rule, "--quiet"}),
        status);
  };
  EXPECT_THAT(refusal("train.csv", "2x", kWrongCommandLine),
              HasSubstr("--rezero must be an interval such as 2h"));
  EXPECT_THAT(refusal("train.csv", "1s", kUnusable),
              HasSubstr("leaves no row of a fold"));
  Write("bare.csv",
        "day,position_mm,error_mm\n1,1,1\n1,2,3\n1,3,2\n2,1,2\n2,2,1\n2,3,2"
        "\n3,1,5\n3,3,2\n3,4,1\n");
  EXPECT_THAT(refusal("bare.csv", "2h", kUnusable),
              HasSubstr("name their column with --time"));
}

TEST_F(CliPromise, ComparesWhatProbesOfASessionBuy) {
  const std::vector<std::string> words = {"compare",
                                          "train.csv",
                                          "--models",
                                          "zero,poly:full:degree=2",
                                          "--probes-per-session",
                                          "0,1,4",
                                          "--probe-spacing",
                                          "300",
                                          "--quiet"};
  std::vector<std::string> as_json = words;
  as_json.insert(as_json.end(), {"--format", "json"});
  const Json probes = RunJson(as_json)["components"][0]["probes"];
  EXPECT_EQ(probes["numbers"], Json({0, 1, 4}));
  EXPECT_EQ(probes["spacing"], 300.0);
  // Ten days of 40 rows, less four of each.
  EXPECT_EQ(probes["scored_rows"], 360);
  // Of what this map leaves, each day has an offset of its own.
  const Json& map = probes["models"][1];
  EXPECT_EQ(map["model"], "poly:full:degree=2");
  EXPECT_LT(map["rmse"][1], 0.8 * map["rmse"][0].get<double>()) << map;
  EXPECT_LT(map["rmse"][2], map["rmse"][1]) << map;
  EXPECT_THAT(OneLine(Run(words).out),
              AllOf(HasSubstr("after probes of each, 5 min apart"),
                    HasSubstr("zero: probes without a map")));
}

}  // namespace
}  // namespace errmap
