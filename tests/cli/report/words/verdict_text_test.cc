#include "cli/report/words/answers/verdict_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/report/words/answers/interval_text.h"
#include "cli/report/words/answers/mark_words.h"
#include "cli/report/wrap_text.h"
#include "data/input_error.h"
#include "tests/cli/report/report_document.h"

namespace errmap::report {
namespace {

using models::ComponentRecord;
using models::Confidence;
using models::RemarkKind;
using models::RemarkRecord;
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
  advice.grounds.clear();
  advice.doubts.clear();
  advice.against_baseline = Confidence::kEstablished;
  advice.best_baseline = "zero";
  advice.removed_share = 0.9279;
  return record;
}

std::string Headline(ComponentRecord record) {
  AddSentences(&record);
  return record.recommendation->sentence;
}

std::string GroundOf(ComponentRecord record, RemarkRecord remark) {
  record.recommendation->grounds = {std::move(remark)};
  AddSentences(&record);
  return record.recommendation->grounds.at(0).text;
}

std::string DoubtOf(ComponentRecord record, RemarkRecord remark) {
  record.recommendation->doubts = {std::move(remark)};
  AddSentences(&record);
  return record.recommendation->doubts.at(0).text;
}

// --- The headline ----------------------------------------------------------

TEST(Headline, SaysWhatToUseAndHowGoodItIs) {
  EXPECT_EQ(Headline(Base()),
            "Use poly:eq8. Unseen cycles: 1.900 um RMSE (95 %: 1.520 to "
            "2.470).");
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
  advice.grounds = {{.kind = RemarkKind::kAveragesMaps}};
  for (models::ModelRecord& model : record.models) {
    Far(&model).tier = model.name == "poly:eq8" ? 1 : 2;
  }
  advice.decided_by = advice.holdout;
  EXPECT_EQ(MarkWords(ViewOf(record)),
            "* recommended, an average of maps: no single one is proven "
            "better, and the average is the safer bet; = the lowest error "
            "here.");
  advice.decided_by = "every:3";
  record.data.sessions = 2;
  for (models::HoldoutRecord& holdout : record.holdouts) {
    holdout.unit_of_analysis = "day";
  }
  EXPECT_THAT(MarkWords(ViewOf(record)),
              HasSubstr("2 days do not choose between them"));
}

// --- What speaks for it, and against ---------------------------------------

TEST(Sentences, TellTheShareOfTheErrorThatIsRemoved) {
  EXPECT_EQ(GroundOf(Base(), {.kind = RemarkKind::kRemoves}),
            "It removes 92 % of the error (0.800 um without a map).");
}

TEST(Sentences, TellOffsetAndScatterOfAMissedGoalApart) {
  EXPECT_EQ(GroundOf(Base(), {.kind = RemarkKind::kGoal}),
            "The goal (RMSE at most 0.5 um) is not met: scatter 1.881 um about "
            "an offset of 0.190 um.");
}

TEST(Sentences, CallAnOffsetPerCycleAThermalStateThatNoSensorSees) {
  ComponentRecord record = Base();
  models::ModelRecord& model = record.models[1];
  for (auto& [holdout, result] : model.results) {
    result.randomness.by_group.emplace().column = "cycle";
  }
  RemarkRecord remark{.kind = RemarkKind::kNotNoise};
  remark.columns = std::vector<std::string>{"cycle", "position_mm"};
  remark.shares = std::vector<double>{0.87, 0.31};
  remark.add_sensor = true;
  EXPECT_EQ(GroundOf(record, remark),
            "87 % of what is left is an offset per cycle: a thermal state that "
            "the sensors do not see. Add a sensor, or re-zero each cycle. 31 % "
            "of what is left repeats along position_mm: the map is too smooth "
            "there.");
  remark.add_sensor = false;
  EXPECT_THAT(GroundOf(record, remark), HasSubstr(" see. Re-zero each cycle."));
  remark.add_sensor.reset();
  EXPECT_THAT(GroundOf(record, remark), HasSubstr(" see. 31 %"));
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
              EndsWith(" um. Trust that for the next 2 days only: neighbouring "
                       "days may err alike (correlation 0.84)"));
  promise.good_for = 1;
  EXPECT_THAT(IntervalText(promise, error),
              HasSubstr("Trust that for the next day only"));
}

TEST(Sentences, TellWhichColumnToIgnoreForAFlatteredModel) {
  ComponentRecord record = Base();
  record.gap =
      models::GapRecord{.neighbours = "every:3",
                        .unseen = kFar,
                        .warning = {},
                        .models = {{"net:scg", 3.6e-4, 1.65e-3, 4.6, true}}};
  RemarkRecord remark{.kind = RemarkKind::kIgnoreNeighbours};
  remark.model = "net:scg";
  EXPECT_EQ(DoubtOf(record, remark),
            "Ignore the every:3 column for net:scg: 0.360 um next to known "
            "rows, 1.650 um on a cycle it never saw.");
}

// --- Why not the net -------------------------------------------------------

std::string OfBestNet(ComponentRecord record) {
  RemarkRecord remark{.kind = RemarkKind::kBestNet};
  remark.model = "net:scg";
  return GroundOf(std::move(record), remark);
}

TEST(BestNet, IsSaidToErrByHowMuchMore) {
  ComponentRecord record = Base();
  models::PairRecord& pair = record.comparisons.front();
  ASSERT_EQ(pair.a, "poly:eq8");
  ASSERT_EQ(pair.b, "net:scg");
  pair.ci95 = {-1.75e-3, -4.5e-4};
  EXPECT_EQ(OfBestNet(record),
            "The best net, net:scg, has 3.000 um, 1.100 um more (95 % 0.450 to "
            "1.750).");
  // The pair may stand the other way round.
  std::swap(pair.a, pair.b);
  pair.ci95 = {4.5e-4, 1.75e-3};
  pair.established = false;
  EXPECT_EQ(OfBestNet(record),
            "The best net, net:scg, has 3.000 um, 1.100 um more (95 % 0.450 to "
            "1.750); call it likely.");
  record.comparisons.clear();
  EXPECT_EQ(OfBestNet(record),
            "The best net, net:scg, has 3.000 um, 1.100 um more.");
}

TEST(BestNet, IsSaidToErrLessWhereABaselineOrBlendIsUsedAllTheSame) {
  ComponentRecord record = Base();
  for (auto& [holdout, result] : record.models[2].results) {
    result.test.rmse = 1.5e-3;
  }
  models::PairRecord& pair = record.comparisons.front();
  pair.ci95 = {-1e-4, 9e-4};  // of poly:eq8 less net:scg
  pair.established = false;
  EXPECT_EQ(OfBestNet(record),
            "The best net, net:scg, has 1.500 um, 0.400 um less (95 % -0.100 "
            "to 0.900); that may be chance.");
}

TEST(BestNet, IsSaidToBeInterchangeableAndDearer) {
  ComponentRecord record = Base();
  record.recommendation->first_tier = {"poly:eq8", "net:scg"};
  EXPECT_EQ(OfBestNet(record),
            "The best net, net:scg (3.000 um), is interchangeable with it and "
            "dearer: 21 parameters for 11.");
  record.recommendation->parameters = 40;
  EXPECT_EQ(OfBestNet(record),
            "The best net, net:scg (3.000 um), is interchangeable with it.");
}

TEST(Sentences, TellHowLittleFewSessionsSay) {
  ComponentRecord record = Base();
  record.data.sessions = 2;
  record.recommendation->holdout = record.holdouts.front().name;
  record.holdouts.front().unit_of_analysis = "day";
  RemarkRecord remark{.kind = RemarkKind::kFewSessions};
  remark.holdouts = std::vector<std::string>{record.holdouts.front().name};
  EXPECT_EQ(DoubtOf(record, remark), "2 days tell little of another.");
  remark.holdouts = std::vector<std::string>{kFar};
  EXPECT_EQ(DoubtOf(record, remark),
            "2 days tell little of another, so the map was chosen by "
            "cycles held out (groups:5).");
}

TEST(Sentences, SayHowToCompareWithoutWhatOnlyGrows) {
  RemarkRecord remark{.kind = RemarkKind::kOnlyGrows};
  remark.columns = std::vector<std::string>{"age_d", "wear"};
  EXPECT_THAT(DoubtOf(Base(), remark),
              EndsWith("age_d and wear hardly ever return to values they had: "
                       "cycles to come lie beyond all that were held out. "
                       "Compare without: --exclude age_d,wear."));
  remark.columns = std::vector<std::string>{"age_d"};
  EXPECT_THAT(DoubtOf(Base(), remark),
              HasSubstr("age_d hardly ever returns to values it had: "));
}

TEST(Sentences, HaveNoZeroBelowZero) {
  const ErrorText error(data::UnitOfSymbol("mm"), 1e-3);
  EXPECT_EQ(error(-1e-9), "0.00");
  EXPECT_EQ(error(-1e-3), "-1.00");
}

TEST(Sentences, SayWhichMapHasLessErrorThanABlend) {
  RemarkRecord remark{.kind = RemarkKind::kAveragesMaps};
  remark.model = "zero";
  ComponentRecord record = Base();
  record.recommendation->decided_by = record.recommendation->holdout;
  EXPECT_THAT(GroundOf(record, remark),
              EndsWith("The best single map is zero (0.800 um)."));
  record.recommendation->decided_by = "every:3";
  EXPECT_THAT(GroundOf(record, remark),
              EndsWith("Of single maps every:3 would choose zero (0.800 um)."));
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

TEST(Sentences, TellHowManyCyclesWouldProveADifference) {
  using Kind = models::Obstacle::Kind;
  ComponentRecord record = Base();
  record.models[0].baseline = true;
  record.verdict = {Hindered(Kind::kTooManyPairs, 6, 11)};
  EXPECT_EQ(DoubtOf(record, {.kind = RemarkKind::kTooManyMaps}),
            "6 cycles cannot prove a difference between 2 maps: measure 11 or "
            "more in all, or compare fewer.");
  record.verdict = {Hindered(Kind::kTooFewSignPatterns, 6, 0)};
  EXPECT_EQ(DoubtOf(record, {.kind = RemarkKind::kTooManyMaps}),
            "6 cycles cannot prove a difference between 2 maps: compare "
            "fewer.");
  record.verdict = {Hindered(Kind::kTooFewUnits, 5, 6)};
  EXPECT_EQ(DoubtOf(record, {.kind = RemarkKind::kTooFewUnits}),
            "5 cycles alone cannot prove which map is better: measure 6 or "
            "more in all.");
  record.verdict = {Hindered(Kind::kPerhapsOneSession, 8, 12)};
  EXPECT_EQ(DoubtOf(record, {.kind = RemarkKind::kTooFewUnits}),
            "8 cycles that may be of one day cannot prove which map is better: "
            "measure 12 or more in all, or on several days (a column day or "
            "session).");
}

TEST(Sentences, TellThatOneRunKnowsNothingOfAnotherDay) {
  EXPECT_EQ(DoubtOf(Base(), {.kind = RemarkKind::kOneRunOnly}),
            "One run only: nothing is known of another day.");
}

TEST(Sentences, TellWhatToMeasureWhereTheMapExtrapolates) {
  ComponentRecord record = Base();
  record.recommendation->extrapolated_share = 0.4;
  RemarkRecord remark{.kind = RemarkKind::kExtrapolates};
  remark.columns = std::vector<std::string>{"t12_degC"};
  remark.below = std::vector<double>{21.5};
  remark.above = std::vector<double>{27.0};
  EXPECT_EQ(DoubtOf(record, remark),
            "In 40 % of the held-out rows an input lies outside what the fold "
            "was trained on: the map extrapolates. Measure a colder start or "
            "room (t12_degC below 21.5); a longer run or hotter room (t12_degC "
            "above 27).");
  remark.columns = std::vector<std::string>{"t12_degC", "speed_rpm", "t3_degC"};
  remark.below = std::vector<double>{21.5, models::kNotKnown, 20.0};
  remark.above = std::vector<double>{models::kNotKnown, 3000.0, 31.0};
  record.recommendation->doubts = {remark};
  EXPECT_EQ(
      MeasureNext(record),
      "a colder start or room (t12_degC below 21.5); a faster spindle "
      "(speed_rpm above 3000); a longer run or hotter room (t3_degC above 31)");
}

TEST(Sentences, TellThatNeighboursProveLittle) {
  RemarkRecord remark{.kind = RemarkKind::kUnitsCorrelated};
  remark.lag1 = 0.75;
  remark.pairs = 3;
  remark.established = 0;
  EXPECT_THAT(
      DoubtOf(Base(), remark),
      StartsWith("Neighbouring cycles resemble each other (lag-1 "
                 "correlation 0.75 of the loss differences), so their "
                 "number proves little. Nothing is called established"));
}

TEST(VerdictParagraphs, LeaveOutWhatTheNextStepsSay) {
  ComponentRecord record = Base();
  record.recommendation->grounds = {{.kind = RemarkKind::kGoal}};
  record.recommendation->doubts = {{.kind = RemarkKind::kExtrapolates}};
  AddSentences(&record);
  const std::string text = VerdictParagraphs(record, 1000, true);
  EXPECT_THAT(text, HasSubstr("The goal "));
  EXPECT_THAT(text, Not(HasSubstr("the map extrapolates")));
  EXPECT_THAT(VerdictParagraphs(record, 1000, false),
              HasSubstr("the map extrapolates"));
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
  record.recommendation->grounds = {{.kind = RemarkKind::kGoal}};
  AddSentences(&record);
  const ComponentRecord page = WithPageUnits(Study(record)).components.front();
  EXPECT_THAT(page.recommendation->sentence,
              StartsWith("Use 2 um. Unseen cycles: 1.900 µm RMSE"));
  EXPECT_THAT(page.recommendation->grounds.front().text,
              HasSubstr("scatter 1.881 µm about"));
}

TEST(PageUnits, LeaveTheWordsOfAnIncompleteRecord) {
  ComponentRecord record = Base();
  record.recommendation->grounds = {
      {.kind = RemarkKind::kPromise, .text = "As it was told."}};
  const ComponentRecord page = WithPageUnits(Study(record)).components.front();
  EXPECT_EQ(page.recommendation->grounds.front().text, "As it was told.");
  EXPECT_THROW(AddSentences(&record), data::InputError);
}

}  // namespace
}  // namespace errmap::report
