// Data that errmap cannot use, and data that only look so: exit status 3 and
// one line that names file, row, column and remedy.

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/cli_runner.h"
#include "tests/cli/one_line.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr int kUnusable = 3;

const std::string kHeader = "position_mm,t1_degC,error_mm\n";
const std::string kRows =
    "1,20,0.1\n2,21,0.3\n3,22.5,0.2\n4,20.3,0.5\n5,20.1,0.4\n6,22,0.6\n";

class CliBadInput : public CliTest {
 protected:
  Outcome Compare(std::string_view text,
                  std::vector<std::string> more = {}) const {
    Write("f.csv", text);
    std::vector<std::string> words{
        "compare", "f.csv", "--models", "mean", "--holdout", "every:3"};
    words.insert(words.end(), more.begin(), more.end());
    return Run(words);
  }

  std::string Refusal(std::string_view text,
                      const std::vector<std::string>& more = {}) const {
    return RefusalOf(Compare(text, more), kUnusable);
  }

  Json Data(const Outcome& outcome) const {
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return Json::parse(outcome.out)["components"][0];
  }
};

TEST_F(CliBadInput, MissingCellNamesLineRowColumnAndRemedies) {
  EXPECT_THAT(
      Refusal(kHeader + "1,20,0.1\n2,,0.3\n" + kRows),
      AllOf(HasSubstr("f.csv: line 3 (data row 1), column 't1_degC': empty"),
            HasSubstr("--missing drop-rows"),
            Not(HasSubstr("--exclude"))));  // the row may be shifted
}

TEST_F(CliBadInput, MissingTargetIsNotToBeExcluded) {
  EXPECT_THAT(Refusal(kHeader + kRows + "7,20,NA\n"),
              AllOf(HasSubstr("line 8 (data row 6), column 'error_mm': 'NA'"),
                    Not(HasSubstr("--exclude"))));
}

TEST_F(CliBadInput, NonNumericCellShowsItsText) {
  EXPECT_THAT(Refusal(kHeader + "1,20,0.1\n2,2o,0.3\n" + kRows),
              HasSubstr("f.csv: line 3 (data row 1), column 't1_degC': '2o' is "
                        "not a number"));
}

TEST_F(CliBadInput, NaNIsAMissingValue) {
  EXPECT_THAT(Refusal(kHeader + "1,20,NaN\n" + kRows),
              HasSubstr("f.csv: line 2 (data row 0), column 'error_mm': 'NaN' "
                        "is a missing value"));
}

TEST_F(CliBadInput, InfinitiesAreRefusedUnlessRowsMayBeDropped) {
  for (const std::string text : {"inf", "-inf", "Infinity", "1e999"}) {
    const std::string rows = kHeader + "1,20,0.1\n2," + text + ",0.3\n" + kRows;
    EXPECT_THAT(
        Refusal(rows),
        HasSubstr("f.csv: line 3 (data row 1), column 't1_degC': '" + text));
    if (text == "1e999") continue;  // a number, written wrongly
    Write("f.csv", rows);
    EXPECT_THAT(Run({"compare", "f.csv", "--missing", "drop-rows"}).err,
                HasSubstr("1 of 8 rows is dropped for missing cells"));
  }
}

TEST_F(CliBadInput, ShortAndLongRowsAreRagged) {
  EXPECT_THAT(Refusal(kHeader + kRows + "7,20\n"),
              HasSubstr("f.csv: line 8 (data row 6): 2 fields where the header "
                        "has 3"));
  EXPECT_THAT(Refusal(kHeader + "1,20,0,1\n" + kRows),
              AllOf(HasSubstr("f.csv: line 2 (data row 0): 4 fields where the "
                              "header has 3"),
                    HasSubstr("decimal commas")));
}

TEST_F(CliBadInput, RowsOfAnotherLengthAreLeftOutByTheOptionThatIsNamed) {
  const std::string text = kHeader + kRows + "7,20\n8,20,,1\n";
  EXPECT_THAT(
      Refusal(text),
      HasSubstr("2 rows have another number of cells than the header's "
                "3: line 8 has 2, line 9 has 4; complete them or remove "
                "them, or leave them out with --missing drop-rows"));
  const Outcome outcome =
      Compare(text, {"--missing", "drop-rows", "--format", "json"});
  EXPECT_EQ(Data(outcome)["data"]["rows"], 6);
  EXPECT_THAT(outcome.err, HasSubstr("2 rows are left out"));
}

TEST_F(CliBadInput, WhatWasNotPlainInAFileIsSaid) {
  EXPECT_THAT(Compare("t,t,error_mm\n" + kRows).err,
              HasSubstr("f.csv: columns of one name: the later is read as "
                        "'t_2'"));
  EXPECT_THAT(
      Compare(kRows, {"--target", "column_3", "--inputs", "column_1,column_2"})
          .err,
      HasSubstr("f.csv: no line of names: the columns are called "
                "column_1 to column_3"));
}

TEST_F(CliBadInput, EmptyFile) {
  EXPECT_THAT(Refusal(""), HasSubstr("f.csv: the file is empty"));
}

TEST_F(CliBadInput, HeaderAlone) {
  EXPECT_THAT(Refusal(kHeader),
              HasSubstr("f.csv: line 1: a header without data"));
}

TEST_F(CliBadInput, AbsentFileAndFolder) {
  EXPECT_THAT(RefusalOf(Run({"compare", "none.csv"}), kUnusable),
              HasSubstr("none.csv: cannot be read: No such file"));
  EXPECT_THAT(RefusalOf(Run({"compare", "."}), kUnusable),
              AllOf(HasSubstr(".: is a folder"), HasSubstr("errmap init .")));
}

TEST_F(CliBadInput, UnknownColumnNamesFlagAndKnownColumns) {
  EXPECT_THAT(
      Refusal(kHeader + kRows, {"--target", "eror_mm"}),
      AllOf(HasSubstr("f.csv: no column 'eror_mm' (--target)"),
            HasSubstr("did you mean 'error_mm'?"),
            HasSubstr("the columns are 'position_mm', 't1_degC', 'error_mm'")));
  for (const std::string flag :
       {"--inputs", "--exclude", "--group", "--weight"}) {
    EXPECT_THAT(Refusal(kHeader + kRows, {flag, "nosuch"}),
                HasSubstr("f.csv: no column 'nosuch' (" + flag + ")"));
  }
}

TEST_F(CliBadInput, ConstantTarget) {
  EXPECT_THAT(Refusal(kHeader + "1,20,0.1\n2,21,0.1\n3,22,0.1\n"),
              HasSubstr("f.csv: target 'error_mm' is constant (0.1 in all 3 "
                        "rows)"));
}

TEST_F(CliBadInput, TargetMustBeNamedWhereItIsNotPlain) {
  constexpr int kAsked = 2;
  for (const char* text : {"position_mm,disp_um\n1,2\n2,3\n3,5\n",
                           "error_x_um,error_y_um,t1\n1,2,3\n2,3,9\n3,5,4\n"}) {
    EXPECT_THAT(RefusalOf(Compare(text), kAsked),
                AllOf(HasSubstr("f.csv"), HasSubstr("--target")));
  }
}

TEST_F(CliBadInput, TooFewRowsForEveryModel) {
  EXPECT_THAT(Refusal(kHeader + "1,20,0.1\n2,21,0.2\n"),
              HasSubstr("f.csv: hold-out 'every:3': needs at least 3 rows, "
                        "found 2"));
  Write("g.csv", kHeader + "1,20,0.1\n2,21,0.2\n");
  EXPECT_THAT(
      RefusalOf(Run({"compare", "g.csv", "--holdout", "every:2"}), kUnusable),
      HasSubstr("g.csv: too few rows for every model"));
}

TEST_F(CliBadInput, OpenQuote) {
  EXPECT_THAT(Refusal(kHeader + "1,20,0.1\n2,\"21,0.2\n" + kRows),
              HasSubstr("f.csv: line 3 (data row 1), column 't1_degC': the "
                        "quote that opens here is never closed"));
}

TEST_F(CliBadInput, NulByte) {
  EXPECT_THAT(Refusal(kHeader + "1,20,0.1\n2,2" + std::string(1, '\0') +
                      "1,0.2\n" + kRows),
              HasSubstr("f.csv: line 3: NUL byte"));
}

TEST_F(CliBadInput, DecimalCommasAndPointsMixed) {
  EXPECT_THAT(
      Refusal("position_mm;t1_degC;error_mm\n1,5;21;0,1\n2;20.5;0,2\n3;4;5\n"),
      AllOf(HasSubstr("f.csv: line 3 (data row 1), column 't1_degC': decimal "
                      "point (20.5)"),
            HasSubstr("decimal comma (0,1) at line 2 (data row 0), column "
                      "'error_mm'")));
}

TEST_F(CliBadInput, ColumnsNotInUseMayHoldAnything) {
  EXPECT_EQ(Compare("position_mm,t1_degC,error_mm,note\n1,2,0.1,inf\n"
                    "2,,0.2,\n3,x,0.4,7\n4,5,0.8,\n",
                    {"--inputs", "position_mm"})
                .status,
            0);
}

TEST_F(CliBadInput, MessageStaysOneLineWhateverTheCellHolds) {
  EXPECT_THAT(Refusal(kHeader + "1,\"a\nb\x1b[31m\",0.1\n" + kRows),
              HasSubstr("f.csv: line 2 (data row 0), column 't1_degC'"));
}

TEST_F(CliBadInput, OtherCommandsRefuseAlike) {
  Write("f.csv", kHeader + "1,,0.1\n" + kRows);
  EXPECT_THAT(
      RefusalOf(Run({"fit", "f.csv", "--model", "mean", "-o", "m"}), kUnusable),
      HasSubstr("f.csv: line 2 (data row 0), column 't1_degC'"));
  EXPECT_FALSE(Exists("m"));
  EXPECT_THAT(
      RefusalOf(Run({"residuals", "f.csv", "--column", "t1_degC"}), kUnusable),
      HasSubstr("f.csv: line 2 (data row 0), column 't1_degC'"));
  EXPECT_THAT(
      RefusalOf(Run({"residuals", "f.csv", "--column", "t9"}), kUnusable),
      HasSubstr("f.csv: no column 't9' (--column)"));
}

TEST_F(CliBadInput, DroppedRowsKeepTheNumberingOfTheFile) {
  const Outcome outcome =
      Compare(kHeader + "1,20,0.1\n2,,0.3\n3,22.5,0.2\n4,20.3,0.5\n5,na,1\n" +
                  "6,NaN,4\n7,22,4\n",
              {"--missing", "drop-rows", "--format", "json", "--out", "o"});
  const Json data = Data(outcome);
  EXPECT_EQ(data["data"]["rows"], 4);
  EXPECT_EQ(data["holdouts"][0]["train_rows"], Json::parse("[[0,2,6]]"));
  EXPECT_EQ(data["holdouts"][0]["test_rows"], Json::parse("[[3]]"));
  EXPECT_THAT(outcome.err,
              HasSubstr("3 of 7 rows are dropped for missing cells; the first: "
                        "f.csv: line 3 (data row 1), column 't1_degC'"));
  EXPECT_THAT(Read("o/residuals.csv"), HasSubstr("every:3,0,3,0.5,"));
}

TEST_F(CliBadInput, DropRowsNeverDropsWhatMayBeANumber) {
  EXPECT_THAT(Refusal(kHeader + "1,20,0.1\n2,,0.3\n3,2o,0.2\n" + kRows,
                      {"--missing", "drop-rows"}),
              HasSubstr("f.csv: line 4 (data row 2), column 't1_degC': '2o' is "
                        "not a number"));
}

TEST_F(CliBadInput, DropRowsThatLeavesNothing) {
  EXPECT_THAT(
      Refusal(kHeader + "1,,0.1\n2,20,\n,1,2\n", {"--missing", "drop-rows"}),
      HasSubstr("f.csv: no row is left"));
}

const std::string kDeadSensors =
    "position_mm,t1,t2,t3,t4,error_mm\n"
    "1,20,0,7,20,0.1\n2,21,0,7,21,0.3\n3,22.5,0,7,22.5,0.2\n"
    "4,20.3,0,7,20.3,0.5\n";

TEST_F(CliBadInput, DeadSensorsAndDuplicatesAreLeftOutAndNamed) {
  const Outcome outcome = Compare(kDeadSensors, {"--format", "json"});
  EXPECT_THAT(
      outcome.err,
      AllOf(HasSubstr("errmap: input t2 is dead (0 in all 4 rows) and is left "
                      "out; --keep-dead keeps it\n"),
            HasSubstr("errmap: input t3 is dead (7 in all 4 rows)"),
            HasSubstr("errmap: input t4 repeats t1 value for value and is left "
                      "out; name it in --inputs to use it\n")));
  const Json data = Data(outcome)["data"];
  EXPECT_EQ(data["inputs"], Json::parse(R"(["position_mm","t1"])"));
  ASSERT_EQ(data["dropped"].size(), 3U);
  EXPECT_EQ(data["dropped"][0]["column"], "t2");
  EXPECT_EQ(data["dropped"][1]["column"], "t3");
}

// Mutation: a headline without the doubts of its data fails.
TEST_F(CliBadInput, WhatWasAskedForAndLeftOutStandsInTheHeadline) {
  const std::vector<std::string> asked{
      "--inputs", "position_mm,t2", "--format"};
  for (const std::string quiet : {"", "--quiet"}) {
    std::vector<std::string> more = asked;
    more.emplace_back("json");
    if (!quiet.empty()) more.push_back(quiet);
    const Json data = Data(Compare(kDeadSensors, more))["data"];
    const std::string doubt =
        "The input t2, asked for by --inputs, is dead (0 in all 4 rows) and is "
        "left out; --keep-dead keeps it.";
    EXPECT_EQ(data["doubts"], Json::array({doubt}));
    EXPECT_THAT(data["remarks"].dump(), HasSubstr("input t2 is dead"));
    more[3] = "table";
    EXPECT_THAT(OneLine(Compare(kDeadSensors, more).out),
                HasSubstr("The input t2, asked for by --inputs, is dead"));
  }
}

TEST_F(CliBadInput, EvaluateKnowsWhatTheMapLearntFrom) {
  Write("f.csv", kHeader + kRows);
  Write("more.csv", kHeader + kRows + "7,21,0.7\n8,20.5,0.9\n");
  Write("new.csv", kHeader + "7,21,0.7\n8,20.5,0.9\n9,22,0.8\n");
  ASSERT_EQ(
      Run({"fit", "f.csv", "--model", "poly:position", "-o", "m.json"}).status,
      0);
  const auto learnt = [&](const std::string& file) {
    return Json::parse(Run({"evaluate", "m.json", file, "--format", "json"})
                           .out)["learnt_from"];
  };
  EXPECT_EQ(learnt("f.csv"), Json::parse(R"({"file": true, "rows": 6})"));
  EXPECT_THAT(Run({"evaluate", "m.json", "f.csv"}).out,
              HasSubstr("The map was fitted to this file"));
  ASSERT_EQ(
      Run({"fit", "f.csv", "--model", "poly:full:degree=1", "-o", "t.json"})
          .status,
      0);
  // The map knows its rows without the file.
  std::filesystem::remove(scratch_ / "f.csv");
  EXPECT_EQ(learnt("more.csv"), Json::parse(R"({"file": false, "rows": 6})"));
  EXPECT_EQ(learnt("new.csv"), Json::parse(R"({"file": false, "rows": 0})"));
  const char* known = "The map was fitted to 6 of 8 rows";
  EXPECT_THAT(Run({"evaluate", "m.json", "more.csv"}).out, HasSubstr(known));
  EXPECT_THAT(OneLine(Run({"predict", "t.json", "more.csv"}).err),
              HasSubstr("the map was trained on the readings of 6 of 8 rows"));
  for (const std::string command : {"evaluate", "predict"}) {
    const Outcome fresh = Run({command, "t.json", "new.csv"});
    EXPECT_THAT(fresh.out + fresh.err,
                Not(::testing::ContainsRegex("trained on|was fitted to")));
  }
}

TEST_F(CliBadInput, KeepDeadKeepsThemAndSaysSo) {
  const Outcome outcome =
      Compare(kDeadSensors, {"--format", "json", "--keep-dead"});
  EXPECT_THAT(outcome.err,
              HasSubstr("errmap: input t2 is dead (0 in all 4 rows) and is "
                        "kept\n"));
  const Json data = Data(outcome)["data"];
  EXPECT_EQ(data["inputs"].size(), 4U);
  ASSERT_EQ(data["dropped"].size(), 1U);
  EXPECT_EQ(data["dropped"][0]["column"], "t4");
}

TEST_F(CliBadInput, QuietKeepsRemarksBack) {
  EXPECT_EQ(Compare(kDeadSensors, {"--quiet"}).err, "");
}

TEST_F(CliBadInput, GermanFileGivesTheVerySameFigures) {
  const std::string plain =
      Process::TextOf(SetPath("nistir5367_xdisp_down.csv"));
  std::string german = "\xEF\xBB\xBF";
  for (const char c : plain) {
    if (c == '\n') german += '\r';
    german += c == ',' ? ';' : c == '.' ? ',' : c;
  }
  Write("plain.csv", plain);
  Write("german.csv", german);
  const std::vector<std::string> options{"--models",
                                         "mean,poly:eq8,poly:stepwise,net:scg:"
                                         "iterations=50",
                                         "--format",
                                         "json"};
  std::vector<std::string> words{"compare", "plain.csv"};
  words.insert(words.end(), options.begin(), options.end());
  Json a = RunJson(words)["components"][0]["models"];
  words[1] = "german.csv";
  Json b = RunJson(words)["components"][0]["models"];
  ASSERT_EQ(a.size(), b.size());
  ASSERT_GT(a.size(), 0U);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i]["equation"], b[i]["equation"]);
    for (const std::string holdout : {"every:3", "groups:5"}) {
      for (const std::string part : {"train", "test", "normality"}) {
        EXPECT_EQ(a[i]["results"][holdout][part],
                  b[i]["results"][holdout][part]);
      }
    }
  }
}

}  // namespace
}  // namespace errmap
