// What a file means, and a reading that is used again.

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

class ReadCommand : public CliTest {
 protected:
  void SetUp() override {
    std::string text = "day,pass,where,heat_degC,comp_um,spare\n";
    for (int day = 1; day <= 3; ++day) {
      for (int pass = 1; pass <= 4; ++pass) {
        for (int place = 0; place < 5; ++place) {
          const double heat = 20.0 + pass + 0.3 * day;
          text += fmt::format(
              "{},{},{},{:.2f},{:.3f},7\n",
              day,
              pass,
              50 * place,
              heat,
              -(0.02 * 50 * place + 2.0 * (heat - 20.0) + 0.1 * (place % 2)));
        }
      }
    }
    Write("log.csv", text);
  }

  std::vector<std::string> Compare(std::vector<std::string> more) const {
    std::vector<std::string> words = {"compare",
                                      "log.csv",
                                      "--models",
                                      "mean,poly:position,poly:full:degree=1",
                                      "--format",
                                      "json",
                                      "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
};

TEST_F(ReadCommand, NamesEachRoleAndWhatWasLeftOut) {
  const Outcome read = Run({"read", "log.csv", "--target=-comp_um"});
  EXPECT_EQ(read.status, 0) << read.err;
  EXPECT_THAT(read.out,
              AllOf(HasSubstr("axis       where"),
                    HasSubstr("cycles     12 by pass"),
                    HasSubstr("sessions   3 by day"),
                    HasSubstr("sensors    heat_degC in degC"),
                    HasSubstr("left out   spare (is dead")));
}

TEST_F(ReadCommand, AReadingIsUsedAgain) {
  const Outcome read =
      Run({"read", "log.csv", "--target=-comp_um", "--format", "json"});
  ASSERT_EQ(read.status, 0) << read.err;
  Write("reading.json", read.out);
  const Json by_options = RunJson(Compare({"--target=-comp_um"}));
  const Json by_reading = RunJson(Compare({"--reading", "reading.json"}));
  const auto rmse = [](const Json& document) {
    const Json& model = document["components"][0]["models"][2];
    return model["results"]["sessions:3"]["test"]["rmse"];
  };
  EXPECT_EQ(rmse(by_reading), rmse(by_options));
  EXPECT_TRUE(rmse(by_options).is_number());
  EXPECT_EQ(by_reading["components"][0]["data"]["groups"],
            by_options["components"][0]["data"]["groups"]);
  // What an option says is never overruled.
  const Json other =
      RunJson(Compare({"--reading", "reading.json", "--inputs", "heat_degC"}));
  EXPECT_EQ(other["components"][0]["data"]["reading"]["sensors"],
            Json::array({"heat_degC"}));
  EXPECT_EQ(other["components"][0]["data"]["inputs"].size(), 1);
}

TEST_F(ReadCommand, WritesTheRowsInUse) {
  std::string text = Read("log.csv");
  text.replace(text.find("comp_um"), 7, "error_um");
  const std::size_t at = text.find(",-");
  text.replace(at, text.find(",7", at) - at, ",");
  Write("gap.csv", text + "Mean,,100,22.5,-6,7\n");
  std::vector<std::string> words = {"read", "gap.csv", "-o", "clean.csv"};
  EXPECT_EQ(Run(words).status, kUnusable);
  EXPECT_FALSE(Exists("clean.csv"));
  words.insert(words.end(), {"--missing", "drop-rows"});
  // The row of totals is gone: --faults has nothing to do with it.
  EXPECT_THAT(
      Run(words).out,
      AllOf(HasSubstr("Read: 59 rows"), HasSubstr("--missing, --faults")));
  EXPECT_EQ(Records(Read("clean.csv")).size(), 59U);
  EXPECT_THAT(Run({"read", "clean.csv"}).out,
              HasSubstr("Read: 59 rows in 3 sessions (by day) of 4 cycles"));
}

// Asked again for the sign of its own clean table, somebody would turn it back.
TEST_F(ReadCommand, PrintsAnObjectForAFileThatItRefuses) {
  Write("words.csv", "a,error_um\n1,2\n3\n");
  const Outcome read = Run({"read", "words.csv", "--format", "json"});
  EXPECT_EQ(read.status, kUnusable);
  const Json reading = Json::parse(read.out);
  EXPECT_EQ(reading["files"], Json({"words.csv"}));
  EXPECT_THAT(reading["remarks"][0].get<std::string>(),
              HasSubstr("line 3 (data row 1): 1 field"));
}

TEST_F(ReadCommand, WritesTheNegativeOfACorrectionAsAnError) {
  EXPECT_EQ(
      Run({"read", "log.csv", "--target=-comp_um", "-o", "clean.csv"}).status,
      0);
  const Outcome again = Run({"read", "clean.csv"});
  EXPECT_EQ(again.status, 0);
  EXPECT_THAT(again.out, HasSubstr("target     error [um] in um (name)"));
}

TEST_F(ReadCommand, CountsTheRowsOfTheWayInUse) {
  std::string text = "day,where,heat_degC,error_um\n";
  for (int i = 0; i < 120; ++i) {
    const int place = i % 10 < 5 ? i % 10 : 9 - i % 10;
    const double heat = 20.0 + 0.03 * i;
    text += fmt::format("{},{},{:.2f},{:.3f}\n",
                        1 + i / 40,
                        50 * place,
                        heat,
                        0.5 * place + heat - 20.0 + (i % 10 < 5 ? 1.0 : 0.0));
  }
  Write("ways.csv", text);
  EXPECT_THAT(Run({"read", "ways.csv"}).out,
              HasSubstr("Read: 120 rows in 3 sessions (by day) of 4 cycles; "
                        "axis where, both ways"));
  EXPECT_THAT(Run({"read", "ways.csv", "--direction", "down"}).out,
              AllOf(HasSubstr("Read: 60 rows in 3 sessions (by day) of 4 "
                              "cycles; axis where, downward"),
                    HasSubstr("down of up, down")));
  const Json reading =
      RunJson({"read", "ways.csv", "--direction", "up", "--format", "json"});
  EXPECT_EQ(reading["rows"], 60);
  EXPECT_EQ(reading["rows_filtered"], 60);
  EXPECT_EQ(reading["direction"]["chosen"], "up");
}

TEST_F(ReadCommand, WhatIsNoReadingSaysWhatWritesOne) {
  Write("other.json", "{\"schema\": \"errmap-map-2\"}");
  EXPECT_THAT(
      RefusalOf(Run(Compare({"--reading", "other.json"})), kUnusable),
      AllOf(HasSubstr("other.json"), HasSubstr("errmap read DATA.csv")));
}

}  // namespace
}  // namespace errmap
