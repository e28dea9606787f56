// Sessions and times on the command line, and maps with a memory.

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/command.h"
#include "data/csv.h"
#include "models/history/history.h"
#include "models/history/with_history.h"
#include "models/model_file.h"
#include "models/recipe_catalog.h"
#include "tests/cli/cli_fixture.h"
#include "tests/cli/cli_runner.h"
#include "tests/cli/one_line.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kCliMemoryUnusable = cli::kUnusableInput;
constexpr int kRowsPerDay = 30;

// `days` days of 30 rows, a row a minute, each day's clock from 0; the error
// lags behind t1 by ten minutes.
std::string Days(int days, int first_row = 0, int end_row = kRowsPerDay) {
  std::string text = "day,time_s,t1_degC,error_um\n";
  for (int day = 1; day <= days; ++day) {
    double lagged = 20.0 + 0.1 * day;
    double t1 = lagged;
    for (int row = 0; row < kRowsPerDay; ++row) {
      if (row > 0) {
        const double before = t1;
        t1 += 0.3 * std::sin(0.3 * row + day);
        // Of a ramp, exactly.
        constexpr double kTau = 600.0;
        constexpr double kStep = 60.0;
        const double behind = kTau * (t1 - before) / kStep;
        lagged =
            t1 - behind + std::exp(-kStep / kTau) * (lagged - before + behind);
      }
      if (row < first_row || row >= end_row) continue;
      text += std::to_string(day) + "," + std::to_string(60 * row) + "," +
              data::CsvNumber(t1) + "," + data::CsvNumber(2.0 * lagged) + "\n";
    }
  }
  return text;
}

class CliMemory : public CliTest {
 protected:
  // A map of the lag, as it is, and guarded at what these days show.
  void WriteMap(const std::string& name, const std::string& csv) const {
    const data::Dataset dataset =
        data::MakeDataset(data::ParseCsv(csv, "train.csv"), {}).dataset;
    const models::History history{
        .time_unit = "s",
        .session = "day",
        .time = dataset.log()->time_column,
        .derived = {models::Ema(dataset.inputs()[0], 600.0, "s")},
        .form_inputs = {"ema(t1_degC,600s)"}};
    models::FittedModel fitted =
        models::MakeRecipe("poly:formula=\"ema(t1_degC,600s)\"")
            ->Fit(models::DeriveDataset(dataset, history), {});
    fitted.guards =
        models::MakeClampLimits(fitted.inputs, dataset.target_values());
    models::SaveModel(models::WithHistory(std::move(fitted), dataset, history),
                      {},
                      (scratch_ / name).string());
  }

  // The column of a CSV file that the program wrote to stdout.
  static std::vector<double> ColumnOf(const Outcome& outcome,
                                      const std::string& name) {
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const data::CsvTable table = data::ParseCsv(outcome.out, "stdout");
    return table.columns[static_cast<std::size_t>(table.Find(name))].values;
  }
};

TEST_F(CliMemory, PredictsFromASessionsFirstRow) {
  Write("days.csv", Days(3));
  WriteMap("map.json", Days(3));
  const Outcome outcome = Run({"predict", "map.json", "days.csv"});
  const std::vector<double> predicted = ColumnOf(outcome, "predicted");
  const data::CsvTable table = data::ParseCsv(Days(3), "days.csv");
  ASSERT_EQ(predicted.size(), table.num_rows);
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    EXPECT_NEAR(predicted[i], table.columns[3].values[i], 1e-9) << i;
  }
  EXPECT_THAT(outcome.err, Not(HasSubstr("warning")));
}

// Newest first, as loggers write them, and by the time of day, as a sheet sorts
// them: each row gets what it gets in a file in order, at its place.
TEST_F(CliMemory, PutsRowsInOrderOfTime) {
  WriteMap("map.json", Days(3));
  Write("days.csv", Days(3));
  const std::vector<double> in_order =
      ColumnOf(Run({"predict", "map.json", "days.csv"}), "predicted");
  std::vector<std::string> lines = SplitLines(Days(3));
  const std::string header = lines.front() + "\n";
  lines.erase(lines.begin());
  const auto write = [&](const std::vector<std::size_t>& order) {
    std::string text = header;
    for (const std::size_t row : order) text += lines[row] + "\n";
    Write("other.csv", text);
  };
  std::vector<std::size_t> newest_first;
  std::vector<std::size_t> by_time;
  for (std::size_t row = 0; row < lines.size(); ++row) {
    newest_first.push_back(lines.size() - 1 - row);
    by_time.push_back(row % 3 * kRowsPerDay + row / 3);
  }
  for (const auto& order : {newest_first, by_time}) {
    write(order);
    const Outcome outcome = Run({"predict", "map.json", "other.csv"});
    // The column of days keeps the others in order.
    EXPECT_EQ(
        outcome.err.find("They were sorted by time_s.") != std::string::npos,
        order == newest_first);
    const std::vector<double> predicted = ColumnOf(outcome, "predicted");
    ASSERT_EQ(predicted.size(), order.size());
    for (std::size_t row = 0; row < order.size(); ++row) {
      EXPECT_EQ(predicted[row], in_order[order[row]]) << row;
    }
    const Json judged =
        RunJson({"evaluate", "map.json", "other.csv", "--format", "json"});
    EXPECT_LT(judged["summary"]["rmse"].get<double>(), 1e-9);
  }
}

// Without a clock a memory counts rows: those of the other way, which the map
// was not fitted to, too. Its own rows are predicted as they were fitted.
TEST_F(CliMemory, CountsTheRowsThatTheMapIsMadeFor) {
  constexpr int kPositions = 12;
  std::string text = "day,cycle,x_mm,t1_degC,error_um\n";
  std::string upwards = text;
  for (int row = 0; row < 3 * 5 * 2 * kPositions; ++row) {
    const int day = row / (10 * kPositions);
    const int cycle = row / (2 * kPositions);
    const bool up = row / kPositions % 2 == 0;
    const int at = up ? row % kPositions : kPositions - 1 - row % kPositions;
    const double t1 = 20.0 + 0.7 * (cycle % 5) + 0.3 * day +
                      0.3 * std::sin(1.3 * row) + (up ? 0.0 : 0.5);
    const double error =
        0.2 * at * (t1 - 20.0) + (up ? 0.0 : 3.0) + 0.1 * std::sin(7.7 * row);
    const std::string line =
        std::to_string(day + 1) + "," + std::to_string(cycle + 1) + "," +
        std::to_string(50 * at) + "," + data::CsvNumber(t1) + "," +
        data::CsvNumber(error) + "\n";
    text += line;
    if (up) upwards += line;
  }
  Write("ways.csv", text);
  Write("up.csv", upwards);
  const Json fitted = RunJson({"fit",
                               "ways.csv",
                               "--model",
                               "poly:ridge:view=history",
                               "--direction",
                               "up",
                               "-o",
                               "up.json",
                               "--format",
                               "json"});
  const Json judged =
      RunJson({"evaluate", "up.json", "ways.csv", "--format", "json"});
  EXPECT_EQ(judged["summary"]["n"], 3 * 5 * kPositions);
  EXPECT_NEAR(judged["summary"]["rmse"].get<double>(),
              fitted["train"]["rmse"].get<double>(),
              1e-9);
  // All rows of its file go up: as if they had been chosen.
  ASSERT_EQ(Run({"fit",
                 "up.csv",
                 "--model",
                 "poly:ridge:view=history",
                 "-o",
                 "one.json"})
                .status,
            0);
  const Outcome one = Run({"evaluate", "one.json", "ways.csv"});
  const Json both =
      RunJson({"evaluate", "one.json", "ways.csv", "--format", "json"});
  const Json alone =
      RunJson({"evaluate", "one.json", "up.csv", "--format", "json"});
  EXPECT_EQ(both["summary"]["n"], 3 * 5 * kPositions);
  EXPECT_NEAR(both["summary"]["rmse"].get<double>(),
              alone["summary"]["rmse"].get<double>(),
              1e-9);
  EXPECT_THAT(one.err, Not(HasSubstr("counting rows")));
  // Nothing else tells where a session begins.
  Write("no_day.csv", "x_mm,t1_degC,error_um\n0,20,1\n50,21,2\n");
  EXPECT_THAT(
      RefusalOf(Run({"predict", "one.json", "no_day.csv"}), kCliMemoryUnusable),
      HasSubstr("no column 'day', which shows the map's memory where a session "
                "begins; add it, or name another with --session"));
}

TEST_F(CliMemory, RunsThroughEarlierRowsFirst) {
  WriteMap("map.json", Days(3));
  Write("all.csv", Days(3));
  Write("earlier.csv", Days(3, 0, 12));
  Write("later.csv", Days(3, 12));
  const std::vector<double> whole =
      ColumnOf(Run({"predict", "map.json", "all.csv"}), "predicted");
  const Outcome outcome =
      Run({"predict", "map.json", "later.csv", "--after", "earlier.csv"});
  const std::vector<double> later = ColumnOf(outcome, "predicted");
  std::vector<double> expected;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (i % kRowsPerDay >= 12) expected.push_back(whole[i]);
  }
  EXPECT_EQ(later, expected);
  EXPECT_THAT(ColumnOf(outcome, "inside"), ::testing::Each(1.0));
  const Json judged = RunJson({"evaluate",
                               "map.json",
                               "later.csv",
                               "--after",
                               "earlier.csv",
                               "--format",
                               "json"});
  EXPECT_LT(judged["summary"]["rmse"].get<double>(), 1e-9);
  EXPECT_EQ(judged["clipped"], 0);
}

TEST_F(CliMemory, WarnsOncePerSessionThatBeginsInside) {
  WriteMap("map.json", Days(3));
  Write("later.csv", Days(2, 25));
  const Outcome outcome = Run({"predict", "map.json", "later.csv"});
  EXPECT_THAT(
      outcome.err,
      AllOf(HasSubstr("warning: session '1' seems to have begun before its "
                      "first row here: inside = 0"),
            HasSubstr("--after, or say --from-rest"),
            HasSubstr("session '2' seems to have begun before")));
  EXPECT_THAT(ColumnOf(outcome, "inside"), ::testing::Each(0.0));
  const Outcome rested =
      Run({"predict", "map.json", "later.csv", "--from-rest"});
  EXPECT_THAT(rested.err, Not(HasSubstr("seems to have begun before")));
  EXPECT_THAT(ColumnOf(rested, "inside"), ::testing::Each(1.0));
  EXPECT_THAT(
      Run({"predict", "map.json", "later.csv", "--after", "later.csv"}).err,
      HasSubstr("no session of later.csv continues in later.csv"));
}

TEST_F(CliMemory, RefusesDataWithoutTimes) {
  WriteMap("map.json", Days(3));
  Write("no_time.csv", "day,t1_degC,error_um\n1,20,40\n1,21,41\n");
  for (const char* command : {"predict", "evaluate"}) {
    EXPECT_THAT(RefusalOf(Run({command, "map.json", "no_time.csv"}),
                          kCliMemoryUnusable),
                HasSubstr("no_time.csv: no column of times, which the map's "
                          "filters need"));
  }
}

TEST_F(CliMemory, TakesTheTimeByWhichTheMapWasFitted) {
  WriteMap("map.json", Days(3));
  Write("plain.csv", "day,time_s,t1_degC\n9,0,20\n9,60,21\n9,120,23\n");
  Write("both.csv",
        "day,time_of_shift_h,time_s,t1_degC\n9,6,0,20\n9,6.1,60,21\n"
        "9,6.2,120,23\n");
  EXPECT_EQ(ColumnOf(Run({"predict", "map.json", "both.csv"}), "predicted"),
            ColumnOf(Run({"predict", "map.json", "plain.csv"}), "predicted"));
}

TEST_F(CliMemory, CountsWhatIsClipped) {
  WriteMap("map.json", Days(3));
  std::string hot = "day,time_s,t1_degC\n9,0,20\n";
  for (int row = 1; row < 10; ++row) {
    hot += "9," + std::to_string(60 * row) + "," +
           std::to_string(20 + 20 * row) + "\n";
  }
  Write("hot.csv", hot);
  const Outcome outcome = Run({"predict", "map.json", "hot.csv"});
  EXPECT_THAT(outcome.err, HasSubstr("clipped by the map's guards"));
  EXPECT_LT(ColumnOf(outcome, "predicted").back(), 60.0);
}

TEST_F(CliMemory, ComparesByWholeSessions) {
  Write("days.csv", Days(5));
  const Json document = RunJson({"compare",
                                 "days.csv",
                                 "--models",
                                 "mean,poly:temperature",
                                 "--format",
                                 "json"});
  const Json& component = document["components"][0];
  EXPECT_EQ(component["data"]["session"], "day");
  EXPECT_EQ(component["data"]["time"], "time_s");
  EXPECT_EQ(component["data"]["sessions"], 5);
  EXPECT_EQ(component["data"]["inputs"], Json({"t1_degC"}));
  ASSERT_EQ(component["holdouts"].size(), 3U);
  EXPECT_EQ(component["holdouts"][2]["name"], "forward:3");
  const Json& sessions = component["holdouts"][1];
  EXPECT_EQ(sessions["name"], "sessions:5");
  EXPECT_EQ(sessions["unit_of_analysis"], "day");
  EXPECT_EQ(sessions["inner"][0], "sessions:4 of day");
  EXPECT_EQ(component["recommendation"]["holdout"], "sessions:5");
}

TEST_F(CliMemory, AddsBlocksWhereSessionsAreTooFewToDecide) {
  Write("days.csv", Days(2));
  const Outcome outcome =
      Run({"compare", "days.csv", "--models", "mean", "--format", "csv"});
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("sessions:2"), HasSubstr("blocks:5")));
  Write("one.csv", Days(1));
  EXPECT_THAT(OneLine(Run({"compare", "one.csv", "--models", "mean"}).out),
              AllOf(HasSubstr("in 1 session (by day)"),
                    HasSubstr("not measured: this is one run")));
}

TEST_F(CliMemory, SaysThatEachSessionsFirstValueIsTakenOff) {
  Write("days.csv", Days(4));
  const Outcome outcome =
      Run({"compare", "days.csv", "--models", "mean", "--align", "first"});
  EXPECT_THAT(OneLine(outcome.out),
              HasSubstr("error_um minus each session's first value"));
  EXPECT_EQ(Run({"fit",
                 "days.csv",
                 "--model",
                 "poly:temperature",
                 "--align",
                 "first",
                 "-o",
                 "m.json"})
                .status,
            0);
  EXPECT_EQ(Json::parse(Read("m.json"))["target"]["align"], "first");
  EXPECT_THAT(OneLine(Run({"evaluate", "m.json", "days.csv"}).out),
              HasSubstr("error_um minus each session's first value"));
  EXPECT_THAT(Run({"predict", "m.json", "days.csv"}).err,
              HasSubstr("since the session's first row"));
}

TEST_F(CliMemory, WritesRolesIntoTheStudyFile) {
  Write("days.csv", Days(4));
  ASSERT_EQ(Run({"init", "days.csv", "-o", "study.toml"}).status, 0);
  EXPECT_THAT(Read("study.toml"),
              AllOf(HasSubstr("session = \"day\""),
                    HasSubstr("time = \"time_s\""),
                    HasSubstr("# align = \"first\"")));
  EXPECT_EQ(Run({"compare",
                 "--config",
                 "study.toml",
                 "--models",
                 "mean",
                 "--set",
                 "component.0.align=first"})
                .status,
            0);
  EXPECT_THAT(RefusalOf(Run({"compare",
                             "--config",
                             "study.toml",
                             "--set",
                             "component.0.align=last"}),
                        cli::kWrongCommandLine),
              HasSubstr("'align' in [[component]] must be"));
}

}  // namespace
}  // namespace errmap
