// Files that a map is used on, written otherwise than those that it was fitted
// to: what can be told is read, the rest is said or refused.

#include <cctype>
#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/commands/promise_days.h"
#include "tests/cli/one_line.h"

namespace errmap {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kUnusableFile = 3;

class UsedFiles : public CliPromise {
 protected:
  void SetUp() override {
    Write("train.csv", DaysInCliPromise(1, 6));
    const Outcome outcome = Fit({"train.csv", "-o", "map.json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    Write("same.csv", DaysInCliPromise(11, 11));
  }

  Outcome Fit(std::vector<std::string> words) const {
    words.insert(words.begin(), "fit");
    words.insert(words.end(), {"--model", "poly:ridge:view=history"});
    return Run(words);
  }

  // "predicted" of each row, as text.
  std::vector<std::string> Predicted(std::vector<std::string> words) const {
    words.insert(words.begin(), {"predict", "map.json"});
    const Outcome outcome = Run(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const data::CsvTable table = data::ParseCsv(outcome.out, "stdout");
    std::vector<std::string> cells;
    for (std::size_t row = 0; row < table.num_rows; ++row) {
      cells.push_back(table.CellText(table.At(table.Find("predicted")), row));
    }
    return cells;
  }

  // A file of rows whose cells, header included, are changed.
  void Rewrite(
      const std::string& from,
      const std::string& to,
      const std::function<void(std::vector<std::string>*)>& change) const {
    std::string text;
    for (const std::string& line : SplitLines(Read(from))) {
      std::vector<std::string> cells = SplitFields(line);
      change(&cells);
      for (std::size_t i = 0; i < cells.size(); ++i) {
        text += (i == 0 ? "" : ",") + cells[i];
      }
      text += "\n";
    }
    Write(to, text);
  }

  // Columns of DaysInCliPromise.
  enum Place { kDay, kTime, kPosition, kT1, kT2, kT3, kError };
};

TEST_F(UsedFiles, AreReadInOtherLettersAndWithoutTheColumnOfSessions) {
  const std::vector<std::string> expected = Predicted({"same.csv"});
  Rewrite("same.csv", "upper.csv", [](auto* cells) {
    for (std::string& cell : *cells) {
      for (char& c : cell) c = static_cast<char>(std::toupper(c));
    }
  });
  EXPECT_EQ(Predicted({"upper.csv"}), expected);
  Rewrite("same.csv", "no_day.csv", [](auto* cells) {
    cells->erase(cells->begin() + kDay);
  });
  EXPECT_EQ(Predicted({"no_day.csv"}), expected);
  EXPECT_THAT(Run({"predict", "map.json", "no_day.csv"}).err,
              HasSubstr("no column 'day': the clock gives the sessions"));
}

TEST_F(UsedFiles, TakeTheClocksUnitFromTheMap) {
  Write("minutes.csv", DaysInCliPromise(1, 6));
  const auto in_minutes = [](const std::string& name) {
    return [name](auto* cells) {
      std::string& cell = (*cells)[kTime];
      cell = cell == "time_s" ? name : data::CsvNumber(std::stod(cell) / 60.0);
    };
  };
  Rewrite("train.csv", "minutes.csv", in_minutes("time_min"));
  ASSERT_EQ(Fit({"minutes.csv", "-o", "map.json"}).status, 0);
  Rewrite("same.csv", "named.csv", in_minutes("time_min"));
  Rewrite("same.csv", "bare.csv", in_minutes("t"));
  EXPECT_EQ(Predicted({"bare.csv"}), Predicted({"named.csv"}));
  EXPECT_THAT(Run({"predict", "map.json", "bare.csv"}).err,
              HasSubstr("'t' counts min, as when the map was fitted"));
}

TEST_F(UsedFiles, AreJudgedByTheColumnThatIsNamed) {
  Rewrite("same.csv", "correction.csv", [](auto* cells) {
    std::string& cell = (*cells)[kError];
    cell = cell == "error_um" ? "correction_mm"
                              : data::CsvNumber(std::stod(cell) / -1000.0);
  });
  for (const char* command : {"check", "evaluate"}) {
    const Outcome asked = Run({command, "map.json", "correction.csv"});
    EXPECT_THAT(RefusalOf(asked, kUnusableFile), HasSubstr("--target=-COL"));
    const Outcome told =
        Run({command, "map.json", "correction.csv", "--target=-correction_mm"});
    const Outcome same = Run({command, "map.json", "same.csv"});
    EXPECT_EQ(told.status, same.status);
    EXPECT_THAT(told.err,
                HasSubstr("error_um is read from '-correction_mm' and "
                          "converted from mm to um"));
    // The lines but for the file's name.
    EXPECT_EQ(told.out.substr(told.out.find("expected")),
              same.out.substr(same.out.find("expected")));
  }
}

TEST_F(UsedFiles, AreJoinedWithTheLogOfTheThermometers) {
  Rewrite("same.csv", "log.csv", [](auto* cells) {
    *cells = {(*cells)[kTime], (*cells)[kT1], (*cells)[kT2], (*cells)[kT3]};
  });
  Rewrite("same.csv", "errors.csv", [](auto* cells) {
    *cells = {
        (*cells)[kDay], (*cells)[kTime], (*cells)[kPosition], (*cells)[kError]};
  });
  EXPECT_EQ(Predicted({"errors.csv", "--with", "log.csv"}),
            Predicted({"same.csv"}));
  EXPECT_EQ(
      Run({"check", "map.json", "errors.csv", "--with", "log.csv"}).status,
      Run({"check", "map.json", "same.csv"}).status);
}

TEST_F(UsedFiles, LeaveRowsWithoutAReadingOut) {
  const std::vector<std::string> expected = Predicted({"same.csv"});
  int row = -1;
  Rewrite("same.csv", "missing.csv", [&row](auto* cells) {
    if (row++ == 7) (*cells)[kT2] = "";
  });
  const std::vector<std::string> found = Predicted({"missing.csv"});
  ASSERT_EQ(found.size(), expected.size());
  EXPECT_EQ(found[7], "");
  // Rows before it are the same, later ones remember one reading less.
  EXPECT_EQ(found[6], expected[6]);
  EXPECT_NE(found[8], "");
  const Outcome outcome = Run({"predict", "map.json", "missing.csv"});
  EXPECT_THAT(outcome.err,
              HasSubstr("1 of 40 rows lacks a reading, the first 't2_degC' in "
                        "data row 7"));
  EXPECT_THAT(SplitLines(outcome.out)[8], HasSubstr(",,,,,0,missing,t2_degC"));
}

// A log as the logger has it: of the whole day, by its own clock, in its own
// order and letters.
TEST_F(UsedFiles, GoOnFromAnyLogOfTheDay) {
  const std::vector<std::string> whole_day = Predicted({"same.csv"});
  const std::vector<std::string> expected(whole_day.begin() + 20,
                                          whole_day.end());
  std::vector<std::string> lines = SplitLines(Read("same.csv"));
  std::string noon = lines.front() + "\n";
  for (std::size_t row = 21; row < lines.size(); ++row) {
    noon += lines[row] + "\n";
  }
  Write("noon.csv", noon);
  const auto expect_whole = [&](const std::string& log) {
    EXPECT_EQ(Predicted({"noon.csv", "--after", log}), expected) << log;
  };
  expect_whole("same.csv");
  Rewrite("same.csv", "minutes.csv", [](auto* cells) {
    std::string& time = (*cells)[kTime];
    time = time == "time_s" ? "Time [min]"
                            : data::CsvNumber(std::stod(time) / 60.0);
    std::string& day = (*cells)[kDay];
    if (day == "day") day = "Day";
  });
  expect_whole("minutes.csv");
  Rewrite("same.csv", "no_day.csv", [](auto* cells) {
    *cells = {(*cells)[kTime], (*cells)[kT1], (*cells)[kT2], (*cells)[kT3]};
  });
  expect_whole("no_day.csv");
  std::string newest_first = lines.front() + "\n";
  for (std::size_t row = lines.size() - 1; row > 0; --row) {
    newest_first += lines[row] + "\n";
  }
  Write("newest_first.csv", newest_first);
  expect_whole("newest_first.csv");
  // The day before is over.
  Write("yesterday.csv", DaysInCliPromise(10, 10));
  EXPECT_THAT(
      Run({"predict", "map.json", "noon.csv", "--after", "yesterday.csv"}).err,
      HasSubstr("no session of yesterday.csv continues"));
}

TEST_F(UsedFiles, RefuseProbesByAnotherClock) {
  Rewrite("same.csv", "dated.csv", [](auto* cells) {
    std::string& cell = (*cells)[kTime];
    if (cell == "time_s") return;
    const int minute = std::stoi(cell) / 60;
    cell = "2026-03-02 07:" + std::string(minute < 10 ? "0" : "") +
           std::to_string(minute) + ":00";
  });
  EXPECT_THAT(RefusalOf(Run({"predict",
                             "map.json",
                             "same.csv",
                             "--probes",
                             "dated.csv",
                             "--quiet"}),
                        kUnusableFile),
              HasSubstr("have no common zero"));
  Write("other_day.csv", DaysInCliPromise(12, 12));
  EXPECT_THAT(
      Run({"predict", "map.json", "same.csv", "--probes", "other_day.csv"}).err,
      HasSubstr("warning: 40 probes move none of 40 rows"));
}

// Temperatures less those before: rows of a pass have none before them where
// the pass has one time.
TEST_F(UsedFiles, AreWarnedOfWhereTheMapKnewPassesWithOneTime) {
  const auto at_once = [row = -1](auto* cells) mutable {
    static std::vector<std::string> first;
    if (row % 5 == 0 || row < 0) first = *cells;
    for (const auto place : {kTime, kT1, kT2, kT3}) {
      (*cells)[place] = first[place];
    }
    ++row;
  };
  Rewrite("train.csv", "passes.csv", at_once);
  Rewrite("same.csv", "pass.csv", at_once);
  ASSERT_EQ(Fit({"passes.csv", "-o", "map.json"}).status, 0);
  EXPECT_THAT(Run({"predict", "map.json", "same.csv"}).err,
              HasSubstr("fitted to passes with one time and temperature each"));
  EXPECT_THAT(Run({"predict", "map.json", "pass.csv"}).err,
              Not(HasSubstr("one time and temperature")));
}

TEST_F(UsedFiles, AreCheckedWithinTheTravel) {
  int row = -1;
  Rewrite("same.csv", "beyond.csv", [&row](auto* cells) {
    if (row++ % 5 != 4) return;
    (*cells)[kPosition] = "400";
    (*cells)[kError] = "90";
  });
  const Outcome outcome = Run({"check", "map.json", "beyond.csv"});
  EXPECT_THAT(outcome.err,
              HasSubstr("32 of 40 probes are judged: the others are beyond"));
  EXPECT_EQ(outcome.status, Run({"check", "map.json", "same.csv"}).status);
}

TEST_F(UsedFiles, HaveNoZeroWhereTheirFirstRowIsNotTheSessions) {
  ASSERT_EQ(Fit({"train.csv", "-o", "map.json", "--align", "first"}).status, 0);
  int row = -1;
  std::string noon;
  for (const std::string& line : SplitLines(DaysInCliPromise(11, 11))) {
    if (row < 0 || row >= 20) noon += line + "\n";
    ++row;
  }
  Write("noon.csv", noon);
  const Outcome outcome = Run({"check", "map.json", "noon.csv"});
  EXPECT_EQ(outcome.status, 5);
  EXPECT_THAT(outcome.out, HasSubstr("Not known whether the map holds"));
}

}  // namespace
}  // namespace errmap
