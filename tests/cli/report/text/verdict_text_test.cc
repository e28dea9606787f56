#include "cli/report/text/answers/verdict_text.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/report/text/answers/interval_text.h"
#include "cli/report/text/answers/mark_words.h"
#include "cli/report/text/answers/remarks.h"
#include "cli/report/wrap_text.h"
#include "data/input_error.h"
#include "tests/cli/report/report_document.h"

namespace errmap::report {
namespace {

using models::ComponentRecord;
using models::Confidence;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Le;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::StartsWith;

constexpr const char* kFar = "groups:5";

// poly:eq8 of 1.9 um on unseen cycles is recommended; the mean has 0.8 um, the
// net 3 um.
ComponentRecord Base() {
  DocumentSpec spec;
  spec.models = {"zero", "poly:eq8", "net:scg"};
  ComponentRecord record =
      Recorded(MakeReportDocument(spec)).components.front();
  for (models::HoldoutRecord& holdout : record.holdouts) {
    holdout.unit_of_analysis = "cycle";
    holdout.units = 6;
    holdout.among_neighbours = !holdout.whole_groups;
  }
  record.tiers = {{kFar, {{"poly:eq8"}, {"net:scg"}, {"zero"}}}};
  models::RecommendationRecord& advice = *record.recommendation;
  record.models[2].choice = models::Choice::kNeural;
  record.data.sessions = 1;
  advice.against_baseline = Confidence::kEstablished;
  advice.best_baseline = "zero";
  advice.removed_share = 0.9279;
  return record;
}

std::string Headline(ComponentRecord record) {
  AddSentences(&record);
  return record.recommendation->sentence;
}

// The texts of the remarks with this label.
std::vector<std::string> TextsOf(const ComponentRecord& record,
                                 std::string_view label) {
  std::vector<std::string> texts;
  for (const Remark& remark : RemarksOf(ComponentNumbers(record))) {
    if (remark.label == label) texts.push_back(remark.text);
  }
  return texts;
}

std::string TextOf(const ComponentRecord& record, std::string_view label) {
  return fmt::format("{}", fmt::join(TextsOf(record, label), " | "));
}

// --- The headline ----------------------------------------------------------

TEST(Headline, SaysWhatToUseAndHowGoodItIs) {
  EXPECT_EQ(Headline(Base()),
            "Use poly:eq8. Unseen cycles: 1.900 um RMSE (95 %: 1.520 to "
            "2.470), largest 5.130 um.");
}

models::ResultRecord& Far(models::ModelRecord* model) {
  for (auto& [holdout, result] : model->results) {
    if (holdout == kFar) return result;
  }
  throw std::out_of_range(kFar);
}

// Of the best baseline's error, ten times the map's, less the map's.
ComponentRecord BesideBaseline(double low, double high) {
  ComponentRecord record = Base();
  const double rmse = ResultOf(record.models[1], kFar)->test.rmse;
  Far(&record.models[0]).test.rmse = 10.0 * rmse;
  models::PairRecord pair;
  pair.a = "poly:eq8";
  pair.b = "zero";
  pair.holdout = kFar;
  pair.difference = -9.0 * rmse;
  pair.ci95 = {-high * rmse, -low * rmse};
  record.comparisons = {pair};
  return record;
}

// --- The marks -------------------------------------------------------------

TEST(Marks, SayWhyALowerErrorIsNotTaken) {
  ComponentRecord record = BesideBaseline(8.0, 10.0);
  EXPECT_THAT(MarkWords(ViewOf(record)),
              StartsWith("* recommended: the lowest error"));
  models::RecommendationRecord& advice = *record.recommendation;
  advice.model = "net:scg";
  advice.single = "poly:eq8";
  advice.first_tier = {"net:scg"};
  for (models::ModelRecord& model : record.models) {
    Far(&model).tier = model.name == "poly:eq8" ? 1 : 2;
  }
  advice.decided_by = advice.holdout;
  EXPECT_EQ(MarkWords(ViewOf(record)),
            "* recommended, an average of maps: no single one "
            "is proven better. Best single map: poly:eq8 (1.900 um). = marks "
            "the lowest error, or as good in practice (--indifference).");
  advice.decided_by = "every:3";
  record.data.sessions = 2;
  for (models::HoldoutRecord& holdout : record.holdouts) {
    holdout.unit_of_analysis = "day";
  }
  EXPECT_THAT(MarkWords(ViewOf(record)),
              HasSubstr("2 days do not choose between them"));
}

TEST(Marks, SayThatASmallMapIsPreferred) {
  ComponentRecord record = BesideBaseline(8.0, 10.0);
  models::RecommendationRecord& advice = *record.recommendation;
  advice.model = "net:scg";
  advice.first_tier = {"poly:eq8"};
  advice.decided_by = advice.holdout;
  EXPECT_THAT(MarkWords(ViewOf(record)),
              HasSubstr("fewest operations among maps about as good"));
}

// --- What speaks for it, and against ---------------------------------------

TEST(Remarks, TellTheShareOfTheErrorThatIsRemoved) {
  EXPECT_EQ(TextOf(Base(), "without a map"), "0.800 um; 93 % removed");
}

TEST(Remarks, TellTheShareAboutTheMeanOfATargetFarFromZero) {
  ComponentRecord record = Base();
  record.models[2].name = "mean";
  for (auto& [holdout, result] : record.models[0].results) {
    result.test.rmse = 0.5;  // mm
  }
  record.recommendation->removed_share = 1.0 - 1.9 / 3.0;
  EXPECT_THAT(TextOf(record, "without a map"),
              HasSubstr("3.00 um about the mean; 37 % removed"));
}

TEST(Remarks, TellOffsetAndScatterOfAGoalThatAnOffsetHides) {
  ComponentRecord record = Base();
  record.recommendation->goal_standing =
      models::GoalStanding::kMetAfterRezeroing;
  EXPECT_EQ(TextOf(record, "goal"),
            "0.5 um: reached after re-zeroing; the scatter is 1.881 um about "
            "an offset of 0.190 um");
}

TEST(Remarks, CallAGoalProvenOnlyWhereTheWholeRangeIsBelowIt) {
  ComponentRecord record = Base();
  models::RecommendationRecord& advice = *record.recommendation;
  advice.goal_standing = models::GoalStanding::kMet;
  for (auto& [holdout, result] : record.models[1].results) {
    result.ci95 = {0.0001, 0.9 * record.goal};
  }
  EXPECT_EQ(TextOf(record, "goal"), "0.5 um: reached");
  for (const double upper : {1.1 * record.goal, models::kNotKnown}) {
    for (auto& [holdout, result] : record.models[1].results) {
      result.ci95 = {0.0001, upper};
    }
    EXPECT_EQ(TextOf(record, "goal"), "0.5 um: reached; not proven");
  }
}

// Of 6 days 4 are later ones: the first fold learns from two.
TEST(Remarks, TellFromHowFewDaysTheErrorOnLaterOnesIs) {
  ComponentRecord record = Base();
  models::RecommendationRecord& advice = *record.recommendation;
  advice.goal_standing = models::GoalStanding::kMet;
  record.data.sessions = 6;
  models::HoldoutRecord& later = record.holdouts.emplace_back();
  later.name = "forward:3";
  later.whole_sessions = true;
  later.unit_of_analysis = "day";
  later.units = 4;
  models::ResultRecord result = Far(&record.models[1]);
  result.test.rmse = 4.0 * result.test.rmse;
  result.ci95 = {models::kNotKnown, models::kNotKnown};
  record.models[1].results.emplace_back("forward:3", result);
  EXPECT_EQ(TextOf(record, "later days"),
            "7.600 um, fitted to as few as 2 days");
  EXPECT_EQ(TextOf(record, "goal"),
            "0.5 um: reached; not proven; not on later days");
  record.holdouts.back().unit_of_analysis = "cycle";
  EXPECT_EQ(TextOf(record, "goal"),
            "0.5 um: reached; not proven; not on later cycles");
}

TEST(Remarks, CallWhatShiftsWholeCyclesNoNoise) {
  ComponentRecord record = Base();
  for (auto& [holdout, result] : record.models[1].results) {
    auto& by_group = result.randomness.by_group.emplace();
    by_group.column = "cycle";
    by_group.explained = 0.87;
    by_group.test.value.p = 1e-6;
    auto& by_position = result.randomness.by_position.emplace();
    by_position.column = "position_mm";
    by_position.explained = 0.31;
    by_position.test.value.p = 1e-6;
  }
  record.recommendation->goal_standing = models::GoalStanding::kMissed;
  record.data.sensors = 2;
  EXPECT_THAT(
      TextsOf(record, "what is left"),
      ElementsAre(
          "87 % of it shifts whole cycles up or down: re-zero each cycle, or "
          "add a thermometer",
          "31 % of it repeats along position_mm: a finer curve would remove "
          "it"));
  record.data.sensors = 40;
  EXPECT_THAT(TextOf(record, "what is left"),
              HasSubstr(": re-zero each cycle |"));
  record.recommendation->goal_standing = models::GoalStanding::kMet;
  EXPECT_THAT(TextOf(record, "what is left"),
              StartsWith("87 % of it shifts whole cycles up or down |"));
}

TEST(Sentences, SayForHowManyDaysAPromiseIsGood) {
  models::PromiseRecord promise;
  promise.unit = "day";
  promise.levels.emplace_back().coverage = 0.9;
  promise.levels.back().half_width = 2.0;
  const ErrorText error(data::UnitOfSymbol("um"), 1.0);
  EXPECT_EQ(IntervalText(promise, error),
            "90 % of the errors on an unseen day lie within 2.00 um");
  promise.lag1 = 0.84;
  promise.good_for = 2;
  EXPECT_THAT(IntervalText(promise, error),
              EndsWith(" um. Trust this for the next 2 days only: neighbouring "
                       "days may err alike (lag-1 autocorrelation 0.84)"));
  promise.good_for = 1;
  EXPECT_THAT(IntervalText(promise, error),
              HasSubstr("Trust this for the next day only"));
}

// --- Why not the net -------------------------------------------------------

std::string OfBestNet(const ComponentRecord& record) {
  return TextOf(record, "why no net");
}

TEST(BestNet, IsSaidToErrByHowMuchMore) {
  ComponentRecord record = Base();
  models::PairRecord& pair = record.comparisons.front();
  ASSERT_EQ(pair.a, "poly:eq8");
  ASSERT_EQ(pair.b, "net:scg");
  pair.ci95 = {-1.75e-3, -4.5e-4};
  EXPECT_EQ(OfBestNet(record),
            "the best, net:scg, has 3.000 um, 1.100 um more (95 % 0.450 to "
            "1.750); the gap is proven");
  // The pair may stand the other way round.
  std::swap(pair.a, pair.b);
  pair.ci95 = {4.5e-4, 1.75e-3};
  pair.established = false;
  EXPECT_EQ(OfBestNet(record),
            "the best, net:scg, has 3.000 um, 1.100 um more (95 % 0.450 to "
            "1.750); the gap is likely real");
  record.comparisons.clear();
  EXPECT_EQ(OfBestNet(record),
            "the best, net:scg, has 3.000 um, 1.100 um more");
}

TEST(BestNet, IsSaidToErrLessWhereABaselineOrBlendIsUsedAllTheSame) {
  ComponentRecord record = Base();
  for (auto& [holdout, result] : record.models[2].results) {
    result.test.rmse = 1.5e-3;
  }
  models::PairRecord& pair = record.comparisons.front();
  pair.ci95 = {-1e-4, 9e-4};  // of poly:eq8 less net:scg
  pair.established = false;
  EXPECT_EQ(OfBestNet(record), "");
  EXPECT_EQ(TextOf(record, "a neural net"),
            "the best, net:scg, has 1.500 um, 0.400 um less (95 % -0.100 to "
            "0.900); the gap may be chance");
}

TEST(Remarks, TellHowLittleFewSessionsSay) {
  ComponentRecord record = Base();
  record.verdict.clear();
  record.data.sessions = 2;
  for (models::HoldoutRecord& holdout : record.holdouts) {
    holdout.unit_of_analysis = "day";
    holdout.units = 2;
    holdout.whole_sessions = holdout.whole_groups;
  }
  EXPECT_EQ(TextOf(record, "how sure"), "2 days say little about another");
}

TEST(Remarks, SayHowToCompareWithoutWhatOnlyGrows) {
  ComponentRecord record = Base();
  EXPECT_EQ(TextOf(record, "only grows"), "");
  record.recommendation->only_grow = std::vector<std::string>{"age_d", "wear"};
  EXPECT_EQ(TextOf(record, "only grows"),
            "age_d and wear: future cycles lie outside the data; compare with "
            "--exclude age_d,wear");
}

TEST(Sentences, HaveNoZeroBelowZero) {
  const ErrorText error(data::UnitOfSymbol("mm"), 1e-3);
  EXPECT_EQ(error(-1e-9), "0.00");
  EXPECT_EQ(error(-1e-3), "-1.00");
}

models::VerdictRecord Hindered(models::Obstacle::Kind kind,
                               std::int64_t units,
                               std::int64_t needed) {
  models::VerdictRecord verdict;
  verdict.holdout = kFar;
  verdict.model = "poly:eq8";
  verdict.obstacle = models::Obstacle{
      .kind = kind, .units = units, .needed = needed, .pairs = 3};
  return verdict;
}

TEST(Remarks, TellHowManyCyclesWouldProveADifference) {
  using Kind = models::Obstacle::Kind;
  ComponentRecord record = Base();
  record.verdict = {Hindered(Kind::kTooManyPairs, 6, 11)};
  EXPECT_EQ(TextOf(record, "how sure"),
            "6 cycles cannot prove which map is best; 11 cycles may");
  EXPECT_THAT(MeasureNext(record), HasSubstr("11 cycles or more in all"));
  record.verdict = {Hindered(Kind::kTooFewSignPatterns, 6, 0)};
  EXPECT_EQ(TextOf(record, "how sure"),
            "6 cycles cannot prove which map is best");
}

// Units are those held out, of which the data may have more.
TEST(Remarks, AdviseAnotherHoldoutWhereTheDataHaveEnough) {
  using Kind = models::Obstacle::Kind;
  ComponentRecord record = Base();
  record.verdict = {Hindered(Kind::kTooFewUnits, 4, 6)};
  for (models::HoldoutRecord& holdout : record.holdouts) holdout.units = 4;
  record.data.groups = 8;
  EXPECT_EQ(TextOf(record, "how sure"),
            "4 held-out cycles cannot prove which map is best; all 8 cycles "
            "held out, by --holdout groups:5, may");
  EXPECT_THAT(MeasureNext(record), Not(HasSubstr("in all")));
  record.verdict = {Hindered(Kind::kTooManyPairs, 4, 12)};
  EXPECT_EQ(TextOf(record, "how sure"),
            "4 held-out cycles cannot prove which map is best; 12 cycles "
            "may");
  EXPECT_THAT(MeasureNext(record),
              HasSubstr("12 cycles or more in all, with --holdout groups:5"));
}

TEST(Remarks, TellThatOneRunKnowsNothingOfAnotherDay) {
  EXPECT_THAT(TextOf(Base(), "another day"),
              StartsWith("not measured: this is one run."));
  EXPECT_THAT(MeasureNext(Base()), HasSubstr("other days"));
}

TEST(Remarks, TellWhatToMeasureWhereTheMapExtrapolates) {
  ComponentRecord record = Base();
  record.data.sessions = 0;
  record.verdict.clear();
  record.recommendation->extrapolated_share = 0.4;
  record.recommendation->beyond =
      std::vector<models::BeyondRecord>{{"t12_degC", 21.5, 27.0}};
  EXPECT_THAT(TextOf(record, "extrapolated"),
              StartsWith("40 % of the test readings were beyond"));
  EXPECT_EQ(MeasureNext(record),
            "a colder start or room (t12_degC below 21.5); a longer or "
            "hotter run (t12_degC above 27)");
  const auto place = [&] {
    const std::vector<Remark> remarks = RemarksOf(ComponentNumbers(record));
    return std::ranges::find(remarks, "extrapolated", &Remark::label)->place;
  };
  EXPECT_EQ(place(), Remark::Place::kNextSteps);
  record.recommendation->extrapolated_share = 0.6;
  EXPECT_EQ(place(), Remark::Place::kAnswer);
  record.recommendation->beyond = std::vector<models::BeyondRecord>{
      {"t12_degC", 21.5, models::kNotKnown},
      {"speed_rpm", models::kNotKnown, 3000.0},
      {"t3_degC", 20.0, 31.0}};
  EXPECT_EQ(
      MeasureNext(record),
      "a colder start or room (t12_degC below 21.5); a faster spindle "
      "(speed_rpm above 3000); a longer or hotter run (t3_degC above 31)");
  record.recommendation->beyond =
      std::vector<models::BeyondRecord>{{"elapsed_cycles", 1.0, 34.0}};
  EXPECT_EQ(MeasureNext(record),
            "readings with elapsed_cycles below 1; readings with "
            "elapsed_cycles above 34");
}

TEST(Remarks, TellThatNeighboursProveLittle) {
  ComponentRecord record = Base();
  models::PairRecord& pair = record.comparisons.front();
  pair.correlated = true;
  pair.lag1 = 0.75;
  pair.established = false;
  models::VerdictRecord verdict;
  verdict.holdout = pair.holdout;
  verdict.model = pair.a;
  verdict.rival = pair.b;
  record.verdict = {verdict};
  record.recommendation->holdout = pair.holdout;
  for (models::PairRecord& other : record.comparisons) {
    other.established = false;
  }
  EXPECT_EQ(TextOf(record, "memory"),
            "neighbouring cycles err alike (lag-1 autocorrelation 0.75), so "
            "their number proves "
            "little; no difference is established");
}

TEST(Remarks, NameTheMapsThatABlendAverages) {
  ComponentRecord record = Base();
  EXPECT_EQ(TextOf(record, "made of"), "");
  for (models::ModelRecord& model : record.models) {
    if (model.name != record.recommendation->model) continue;
    model.choice = models::Choice::kBlend;
    model.final.emplace().remarks = {"74 % curves from readings",
                                     "22 % lines from readings",
                                     "2 % net:scg",
                                     "2 % curves and products from readings"};
  }
  EXPECT_EQ(TextOf(record, "made of"),
            "74 % curves from readings; 22 % lines from readings; 2 more");
}

// Every remark has a label that fits its column, and ends as its text does.
TEST(Remarks, FitTheirColumn) {
  for (const Remark& remark : RemarksOf(ComponentNumbers(Base()))) {
    EXPECT_THAT(remark.label, SizeIs(Le(15U)));
    EXPECT_THAT(SentenceOf(remark), EndsWith("."));
  }
}

TEST(VerdictParagraphs, LeaveOutWhatTheAnswerAndTheNextStepsSay) {
  ComponentRecord record = Base();
  record.recommendation->beyond.emplace();
  AddSentences(&record);
  const std::string text = VerdictParagraphs(record, 1000, true);
  EXPECT_THAT(text, HasSubstr("  cost             "));
  EXPECT_THAT(text, Not(HasSubstr("without a map")));
  EXPECT_THAT(text, Not(HasSubstr("extrapolated")));
  EXPECT_THAT(VerdictParagraphs(record, 1000, false),
              HasSubstr("  extrapolated     "));
}

models::StudyRecord Study(ComponentRecord component) {
  models::StudyRecord study;
  study.components = {std::move(component)};
  return study;
}

TEST(PageUnits, AreTheSymbolsThatPeopleWriteAndOfNumbersOnly) {
  ComponentRecord record = Base();
  record.models[1].name = "2 um";
  record.verdict.clear();
  record.recommendation->model = "2 um";
  record.recommendation->best_baseline.reset();
  AddSentences(&record);
  const ComponentRecord page = WithPageUnits(Study(record)).components.front();
  EXPECT_THAT(page.recommendation->sentence,
              StartsWith("Use 2 um. Unseen cycles: 1.900 µm RMSE"));
  EXPECT_THAT(page.recommendation->reasons.front(),
              HasSubstr("0.800 µm; 93 % removed"));
}

TEST(PageUnits, LeaveTheWordsOfAnIncompleteRecord) {
  ComponentRecord record = Base();
  record.recommendation->reasons = {"As it was told."};
  record.recommendation->single = "a map that is not there";
  record.recommendation->decided_by = record.recommendation->holdout;
  const ComponentRecord page = WithPageUnits(Study(record)).components.front();
  EXPECT_THAT(page.recommendation->reasons, ElementsAre("As it was told."));
  EXPECT_THROW(AddSentences(&record), data::InputError);
}

}  // namespace
}  // namespace errmap::report
