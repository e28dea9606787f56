#include "cli/report/words/answers/first_answer.h"

#include <random>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/report/words/answers/verdict_text.h"
#include "cli/report/wrap_text.h"
#include "tests/cli/report/report_document.h"

namespace errmap::report {
namespace {

using models::ComponentRecord;
using models::GoalStanding;
using models::RemarkKind;
using models::RemarkRecord;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Le;
using ::testing::Not;
using ::testing::SizeIs;

constexpr const char* kUnseen = "groups:5";

// poly:eq8 of 1.9 um on unseen cycles is recommended, the net has 3 um.
ComponentRecord Answered() {
  DocumentSpec spec;
  spec.models = {"zero", "poly:eq8", "net:scg"};
  ComponentRecord record =
      Recorded(MakeReportDocument(spec)).components.front();
  for (models::HoldoutRecord& holdout : record.holdouts) {
    holdout.unit_of_analysis = "cycle";
    holdout.units = 6;
    holdout.among_neighbours = !holdout.whole_groups;
  }
  models::RecommendationRecord& advice = *record.recommendation;
  advice.grounds.clear();
  advice.doubts.clear();
  advice.best_baseline = "net:scg";  // stands for any rival here
  advice.removed_share = 0.9279;
  record.goal = models::kNotKnown;
  advice.goal_standing = GoalStanding::kNone;
  return record;
}

void SetGap(ComponentRecord* record, double low, double high, bool proven) {
  for (models::PairRecord& pair : record->comparisons) {
    pair.ci95 = {low, high};
    pair.established = proven;
  }
}

std::string Text(const ComponentRecord& record) {
  return fmt::format("{}",
                     fmt::join(AnswerLines(FirstAnswerOf(record), 80), "\n"));
}

TEST(FirstAnswer, HasTheMapItsErrorAndItsRival) {
  const std::string text = Text(Answered());
  EXPECT_THAT(text,
              AllOf(HasSubstr("Use poly:eq8.\n"),
                    HasSubstr("  unseen cycles    1.900 um RMSE"),
                    HasSubstr("; 92 % removed"),
                    HasSubstr("  simplest rival   3.000 um, net:scg; ")));
  EXPECT_THAT(text, HasSubstr("  goal             none given; "));
}

TEST(FirstAnswer, SaysHowSureTheGapIs) {
  ComponentRecord record = Answered();
  SetGap(&record, -2.0, -0.5, true);
  EXPECT_THAT(Text(record), HasSubstr("the gap is proven"));
  SetGap(&record, -2.0, -0.5, false);
  EXPECT_THAT(Text(record), HasSubstr("the gap is likely real"));
  SetGap(&record, -2.0, 0.5, false);
  EXPECT_THAT(Text(record), HasSubstr("the gap may be chance"));
  record.comparisons.clear();
  EXPECT_THAT(Text(record), HasSubstr("6 cycles cannot tell how sure that is"));
}

TEST(FirstAnswer, ToldOfOneRunNeverSpeaksOfAnotherDay) {
  ComponentRecord record = Answered();
  record.recommendation->doubts = {{.kind = RemarkKind::kOneRunOnly}};
  EXPECT_THAT(Text(record),
              HasSubstr("  another day      not measured: this is one run."));
}

TEST(FirstAnswer, LeavesOutAnIntervalThatReachesBelowNoError) {
  ComponentRecord record = Answered();
  for (models::ModelRecord& model : record.models) {
    for (auto& [name, result] : model.results) result.ci95 = {-0.1, 4.0};
  }
  EXPECT_THAT(Text(record), Not(HasSubstr("95 %")));
}

// The range is missing as neighbours err alike, which the reader is told.
TEST(FirstAnswer, SaysThatTheUnitsDoNotTellHowSureTheErrorIs) {
  ComponentRecord record = Answered();
  for (models::ModelRecord& model : record.models) {
    for (auto& [name, result] : model.results) {
      result.ci95 = {models::kNotKnown, models::kNotKnown};
    }
  }
  EXPECT_THAT(Text(record), HasSubstr("6 cycles do not tell how sure that is"));
}

TEST(FirstAnswer, HoldsTheErrorAgainstAGoal) {
  ComponentRecord record = Answered();
  record.goal = 0.0005;
  record.display = {.unit = "um", .scale = 1000.0};
  record.recommendation->goal_standing = GoalStanding::kMissed;
  EXPECT_THAT(Text(record),
              HasSubstr("  goal             0.5 um: not reached"));
}

// Whatever is to be said, the answer is read in ten seconds.
TEST(FirstAnswer, HasAtMostTwelveLinesAnd110Words) {
  std::mt19937_64 random(7);
  const RemarkKind kinds[] = {RemarkKind::kAveragesMaps,
                              RemarkKind::kOneRunOnly,
                              RemarkKind::kNoGroups,
                              RemarkKind::kFewSessions,
                              RemarkKind::kInterrupted,
                              RemarkKind::kNoGroupsHeldOut};
  for (int round = 0; round < 200; ++round) {
    ComponentRecord record = Answered();
    for (const RemarkKind kind : kinds) {
      if (random() % 2 == 0) continue;
      record.recommendation->doubts.push_back(RemarkRecord{.kind = kind});
    }
    for (std::uint64_t i = random() % 3; i > 0; --i) {
      record.data.doubts.emplace_back(
          "t1_degC reads 85 in 5 rows, far from the others: leave them out "
          "with --faults drop-rows");
    }
    for (const std::size_t width : {60U, 80U, 120U}) {
      const std::vector<std::string> lines =
          AnswerLines(FirstAnswerOf(record), width);
      EXPECT_THAT(lines, SizeIs(Le(12U)));
      std::size_t words = 0;
      for (const std::string& line : lines) {
        EXPECT_LE(WidthOf(line), width) << line;
        std::istringstream stream(line);
        for (std::string word; stream >> word;) ++words;
      }
      EXPECT_LE(words, 110U);
    }
  }
}

TEST(FirstAnswer, TellsWhereThereIsNothingToRecommend) {
  ComponentRecord record = Answered();
  record.recommendation.reset();
  EXPECT_EQ(Text(record), "No map can be recommended: none could be judged.");
  record.interrupted = true;
  EXPECT_EQ(Text(record),
            "No map can be recommended: the run was interrupted.");
}

}  // namespace
}  // namespace errmap::report
