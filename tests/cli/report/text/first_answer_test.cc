#include "cli/report/text/answers/first_answer.h"

#include <algorithm>
#include <random>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/report/report_view.h"
#include "cli/report/text/answers/verdict_text.h"
#include "cli/report/wrap_text.h"
#include "tests/cli/report/report_document.h"

namespace errmap::report {
namespace {

using models::ComponentRecord;
using models::GoalStanding;
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
  return fmt::format(
      "{}", fmt::join(AnswerLines(FirstAnswerOf(record), 80).lines, "\n"));
}

TEST(FirstAnswer, HasTheMapItsErrorAndItsRival) {
  const std::string text = Text(Answered());
  EXPECT_THAT(text,
              AllOf(HasSubstr("Use poly:eq8.\n"),
                    HasSubstr("  unseen cycles    1.900 um RMSE"),
                    HasSubstr("; 93 % removed"),
                    HasSubstr("  best simple map  3.000 um, net:scg; ")));
  EXPECT_THAT(text, HasSubstr("  goal             none given; "));
}

TEST(FirstAnswer, DoesNotSayThatMapsWereWorseThatWereNotCompared) {
  ComponentRecord record = Answered();
  record.recommendation->choice = models::Choice::kBaseline;
  EXPECT_THAT(Text(record), HasSubstr("no richer map is proven better"));
  for (models::ModelRecord& model : record.models) model.baseline = true;
  EXPECT_THAT(Text(record), HasSubstr("only simple maps were compared"));
}

TEST(FirstAnswer, CallsCyclesPredictedFromEarlierOnesLater) {
  ComponentRecord record = Answered();
  models::HoldoutRecord holdout = record.holdouts.front();
  holdout.whole_groups = true;
  holdout.name = "forward:9";
  EXPECT_TRUE(IsOfLaterUnits(holdout));
  holdout.name = "groups:5";
  EXPECT_FALSE(IsOfLaterUnits(holdout));
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
  EXPECT_THAT(Text(record), HasSubstr("6 cycles are too few to tell"));
}

// The verdict cannot establish it, so the answer does not call it likely.
TEST(FirstAnswer, CallsNoGapLikelyThatTooFewUnitsCannotEstablish) {
  ComponentRecord record = Answered();
  SetGap(&record, -2.0, -0.5, false);
  models::VerdictRecord verdict;
  verdict.holdout = record.recommendation->holdout;
  verdict.obstacle =
      models::Obstacle{.kind = models::Obstacle::Kind::kPerhapsOneSession,
                       .units = 6,
                       .needed = 12,
                       .pairs = 3};
  record.verdict = {verdict};
  EXPECT_THAT(Text(record),
              AllOf(HasSubstr("6 cycles are too few to tell"),
                    Not(HasSubstr("likely real"))));
}

TEST(FirstAnswer, SaysThatItsRangeReachesBeyondTheErrorWithoutAMap) {
  ComponentRecord record = Answered();
  const auto set = [&](double high) {
    for (models::ModelRecord& model : record.models) {
      if (model.name != record.recommendation->model) continue;
      for (auto& [name, result] : model.results) result.ci95 = {0.6, high};
    }
  };
  const double without = TestRmse(*models::FindNamed(record.models, "zero"),
                                  record.recommendation->holdout);
  set(0.9 * without);
  EXPECT_THAT(Text(record), Not(HasSubstr("is it better?")));
  set(1.1 * without);
  EXPECT_THAT(Text(record),
              HasSubstr("is it better?    not proven: the range ends above"));
  // The paired test of the same days may prove it nevertheless.
  models::PairRecord& pair = record.comparisons.front();
  pair.holdout = record.recommendation->holdout;
  pair.a = "zero";
  pair.b = record.recommendation->model;
  pair.established = true;
  EXPECT_THAT(Text(record), Not(HasSubstr("is it better?")));
}

TEST(FirstAnswer, ToldOfOneRunNeverSpeaksOfAnotherDay) {
  ComponentRecord record = Answered();
  record.data.sessions = 1;
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
  EXPECT_THAT(Text(record),
              HasSubstr("6 cycles are too few or too alike for a"));
}

// Other maps have ranges by the same cycles: these are not too few.
TEST(FirstAnswer, BlamesTheErrorsOfTheMapWhereOthersHaveARange) {
  ComponentRecord record = Answered();
  for (models::ModelRecord& model : record.models) {
    if (model.name != record.recommendation->model) continue;
    for (auto& [name, result] : model.results) {
      result.ci95 = {models::kNotKnown, models::kNotKnown};
    }
  }
  std::string text = Text(record);
  std::ranges::replace(text, '\n', ' ');
  EXPECT_THAT(text,
              AllOf(HasSubstr("no 95 % range: its errors on"),
                    Not(HasSubstr("too few or too alike"))));
}

TEST(FirstAnswer, HoldsTheErrorAgainstAGoal) {
  ComponentRecord record = Answered();
  record.goal = 0.0005;
  record.display = {.unit = "um", .scale = 1000.0};
  record.recommendation->goal_standing = GoalStanding::kMissed;
  EXPECT_THAT(Text(record),
              HasSubstr("  goal             0.5 um: not reached"));
}

// The goal that was asked for, and what bounds the map's worth, stay where
// there is no room for all; what is left out is kept for --details.
TEST(FirstAnswer, LeavesOutNeitherAGivenGoalNorCaveats) {
  ComponentRecord record = Answered();
  record.goal = 0.0005;
  record.recommendation->goal_standing = GoalStanding::kMissed;
  record.data.sessions = 1;
  record.interrupted = true;
  for (const char* doubt : {"t1_degC", "t2_degC", "t3_degC"}) {
    record.data.doubts.push_back(
        std::string(doubt) +
        " reads 85 in 5 rows, far from the others: leave them out with "
        "--faults drop-rows");
  }
  const FirstAnswer answer = FirstAnswerOf(record);
  const ShownAnswer shown = AnswerLines(answer, 80, {"one", "two", "three"});
  const std::string text = fmt::format("{}", fmt::join(shown.lines, "\n"));
  for (const char* label : {"\n  goal ",
                            "\n  another day ",
                            "\n  interrupted ",
                            "t1_degC reads",
                            "t3_degC reads"}) {
    EXPECT_THAT(text, HasSubstr(label));
  }
  ASSERT_THAT(shown.left_out, Not(SizeIs(0)));
  for (const Remark& remark : shown.left_out) {
    EXPECT_FALSE(remark.must_show) << remark.label;
    EXPECT_THAT(text, Not(HasSubstr("  " + remark.label + " ")));
  }
}

// Whatever is to be said, the answer is read in ten seconds, unless what must
// be shown alone needs longer.
TEST(FirstAnswer, HasAtMostTwelveLinesAnd110Words) {
  std::mt19937_64 random(7);
  int within = 0;
  for (int round = 0; round < 200; ++round) {
    ComponentRecord record = Answered();
    for (models::ModelRecord& model : record.models) {
      for (auto& [name, result] : model.results) result.ci95 = {1.5, 1.9};
    }
    const auto perhaps = [&] { return random() % 2 == 0; };
    record.interrupted = perhaps();
    record.data.sessions = static_cast<std::int64_t>(random() % 4);
    if (perhaps()) record.data.group.reset();
    for (models::HoldoutRecord& holdout : record.holdouts) {
      holdout.whole_groups = perhaps();
      holdout.whole_sessions = holdout.whole_groups && perhaps();
    }
    if (perhaps()) record.recommendation->single = "zero";
    if (perhaps()) {
      record.recommendation->only_grow = std::vector<std::string>{"age_d"};
    }
    for (std::uint64_t i = random() % 3; i > 0; --i) {
      record.data.doubts.emplace_back(
          "t1_degC reads 85 in 5 rows, far from the others: leave them out "
          "with --faults drop-rows");
    }
    for (const std::size_t width : {60U, 80U, 120U}) {
      const FirstAnswer answer = FirstAnswerOf(record);
      const ShownAnswer shown = AnswerLines(answer, width);
      std::size_t words = 0;
      for (const std::string& line : shown.lines) {
        EXPECT_LE(WidthOf(line), width) << line;
        std::istringstream stream(line);
        for (std::string word; stream >> word;) ++words;
      }
      const auto optional = static_cast<std::size_t>(
          std::ranges::count(answer.lines, false, &Remark::must_show));
      if (shown.left_out.size() == optional) continue;
      EXPECT_THAT(shown.lines, SizeIs(Le(12U)));
      EXPECT_LE(words, 110U);
      ++within;
    }
  }
  EXPECT_GT(within, 300);
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
