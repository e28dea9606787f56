#include "models/fleet/watch.h"

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "data/input_error.h"
#include "stats/distributions.h"

namespace errmap::models {
namespace {

using ::testing::DoubleEq;

// Ten held-out days of offset +-1 and mean square 2.
HeldOutErrors TenDays() {
  HeldOutErrors errors;
  errors.rmse = std::sqrt(2.0);
  for (int day = 0; day < 10; ++day) {
    HeldOutErrors::Unit& unit = errors.units.emplace_back();
    const double offset = day % 2 == 0 ? 1.0 : -1.0;
    unit.residuals.resize(4);
    unit.residuals << offset + 1.0, offset - 1.0, offset + 1.0, offset - 1.0;
  }
  return errors;
}

// A whole session; without time or place every row of a held-out day is like
// it.
WatchedSession Session(const HeldOutErrors& errors,
                       double offset,
                       double mean_square) {
  return {.label = "new",
          .rows = 100,
          .offset = offset,
          .mean_square = mean_square,
          .expected = ExpectedOf(errors, {}, {}),
          .sensor = ""};
}

WatchedSession Session(double offset, double mean_square) {
  return Session(TenDays(), offset, mean_square);
}

TEST(JudgeSessions, FindsADayLikeTheOthersAsPromised) {
  const auto found = JudgeSessions(TenDays(), {Session(1.0, 2.0)});
  ASSERT_TRUE(found);
  EXPECT_GT(found->p, 0.3);
  EXPECT_DOUBLE_EQ(found->found, std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(found->promised, std::sqrt(2.0));
  EXPECT_FALSE(IsWorse(*found, 0.0));
}

TEST(JudgeSessions, HoldsAnOffsetAgainstThoseHeldOut) {
  const auto found = JudgeSessions(TenDays(), {Session(-9.0, 82.0)});
  // By ten offsets about 0.
  EXPECT_THAT(found->p_offset, DoubleEq(stats::StudentTwoSided(9.0, 10.0)));
  EXPECT_LT(found->p, 1e-3);
  EXPECT_TRUE(IsWorse(*found, 0.0));
}

TEST(JudgeSessions, TwoDaysTogetherSayMoreThanTheNewest) {
  const WatchedSession day = Session(3.0, 2.0);
  const double one = JudgeSessions(TenDays(), {day})->p;
  EXPECT_LT(JudgeSessions(TenDays(), {day, day})->p, one);
  // Of a day of which nothing is expected nothing is made.
  WatchedSession few = day;
  few.expected = {};
  EXPECT_DOUBLE_EQ(JudgeSessions(TenDays(), {few, day})->p, one);
  EXPECT_FALSE(JudgeSessions(TenDays(), {day, few}));
}

TEST(JudgeSessions, JudgesNothingByTwoDays) {
  HeldOutErrors few = TenDays();
  few.units.resize(2);
  EXPECT_FALSE(JudgeSessions(few, {Session(few, 0.0, 1.0)}));
  EXPECT_FALSE(JudgeSessions(TenDays(), {}));
}

// Sure, but 3 % above the promise: 0.551 against 0.534.
TEST(IsWorse, NeedsAnEffectThatMatters) {
  MapJudgement judgement{
      .p = 1e-6, .found = 0.551, .offset = 0.1, .promised = 0.534};
  EXPECT_FALSE(IsWorse(judgement, 0.0));
  judgement.found = 0.65;
  EXPECT_TRUE(IsWorse(judgement, 0.0));
  EXPECT_FALSE(IsWorse(judgement, 0.2));
  EXPECT_FALSE(IsDoubtful(judgement, 0.0));
  judgement.p = 0.003;
  EXPECT_FALSE(IsWorse(judgement, 0.0));
  EXPECT_TRUE(IsDoubtful(judgement, 0.0));
  judgement.p = 0.3;
  EXPECT_FALSE(IsDoubtful(judgement, 0.0));
  // Far above the promise: 10 um are never as promised.
  judgement.found = 1.1;
  EXPECT_TRUE(IsDoubtful(judgement, 0.0));
  // An offset of two thirds of the promise adds a fifth to it.
  judgement = {.p = 1e-6, .found = 0.6, .offset = 0.4, .promised = 0.534};
  EXPECT_TRUE(IsWorse(judgement, 0.0));
}

// Days that begin 4 off and end 0 off, at places from 0 to 30.
HeldOutErrors Warming() {
  HeldOutErrors errors;
  errors.time_unit = "s";
  errors.position = "position_mm";
  for (int day = 0; day < 6; ++day) {
    HeldOutErrors::Unit& unit = errors.units.emplace_back();
    unit.elapsed = Eigen::VectorXd::LinSpaced(40, 0.0, 3900.0);
    unit.position.resize(40);
    for (int i = 0; i < 40; ++i) unit.position[i] = 10.0 * (i % 4);
    unit.residuals = (4.0 - 4.0 * unit.elapsed.array() / 3900.0 +
                      (unit.position.array() == 30.0).cast<double>() * 2.0) *
                     (1.0 + 0.1 * day);
  }
  return errors;
}

TEST(ExpectedErrors, AreThoseOfTheSameTimesAndPlaces) {
  const HeldOutErrors errors = Warming();
  const Eigen::VectorXd none;
  const double whole =
      ExpectedOf(errors, errors.units[0].elapsed, errors.units[0].position)
          .offset;
  const double begins =
      ExpectedOf(errors, Eigen::VectorXd{{0, 100, 200, 300}}, none).offset;
  const double ends =
      ExpectedOf(errors, Eigen::VectorXd{{3600, 3700, 3800, 3900}}, none)
          .offset;
  EXPECT_GT(begins, 1.5 * whole);
  EXPECT_LT(ends, whole);
  // One place in the whole of a day.
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(10, 0.0, 3900.0);
  EXPECT_GT(
      ExpectedOf(errors, times, Eigen::VectorXd::Constant(10, 30.0)).offset,
      1.3 *
          ExpectedOf(errors, times, Eigen::VectorXd::Constant(10, 0.0)).offset);
}

// The cold half hour of a healthy day, which is worse than the day: 27 of 60
// were accused.
TEST(JudgeSessions, HoldsPartOfADayAgainstPartsOfDays) {
  const HeldOutErrors errors = Warming();
  const HeldOutErrors::Unit& day = errors.units[2];
  const Eigen::VectorXd part = day.residuals.head(8);
  WatchedSession session = {
      .label = "new",
      .rows = 8,
      .offset = part.mean(),
      .mean_square = part.squaredNorm() / 8.0,
      .expected = ExpectedOf(errors, day.elapsed.head(8), day.position.head(8)),
      .sensor = ""};
  EXPECT_GT(JudgeSessions(errors, {session})->p, 0.1);
}

TEST(AreTooFew, CountsRowsAndTravel) {
  const HeldOutErrors errors = Warming();
  const Eigen::VectorXd none;
  EXPECT_TRUE(AreTooFew(errors, 4, none));
  EXPECT_FALSE(AreTooFew(errors, 5, none));
  EXPECT_TRUE(AreTooFew(errors, 8, Eigen::VectorXd::Constant(8, 10.0)));
  EXPECT_FALSE(AreTooFew(errors, 5, Eigen::VectorXd{{0, 5, 10, 15, 20}}));
}

// Of sd 1; a sum of twelve uniform numbers is normal enough.
class Deviates {
 public:
  double operator()() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) {
      sum += std::ldexp(static_cast<double>(random_() >> 11), -53);
    }
    return sum;
  }

 private:
  std::mt19937_64 random_{24};
};

// Four standard deviations of a count of 2000 at 5 %.
constexpr int kTrials = 2000;
const auto kOneInTwenty =
    ::testing::AllOf(::testing::Gt(60), ::testing::Lt(140));

TEST(JudgeSessions, AccusesHealthyOffsetsAsOftenAsPSays) {
  Deviates deviate;
  int below = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    HeldOutErrors errors = TenDays();
    for (HeldOutErrors::Unit& unit : errors.units) {
      unit.residuals.array() += deviate() - unit.residuals.mean();
    }
    const double offset = deviate();
    const auto found =
        JudgeSessions(errors, {Session(errors, offset, 1.0 + offset * offset)});
    below += found->p_offset < 0.05 ? 1 : 0;
  }
  EXPECT_THAT(below, kOneInTwenty);
}

TEST(JudgeSessions, AccusesDaysThatDifferByFactorsAsOftenAsPSays) {
  constexpr double kOfLogarithms = 0.8;  // sd of days of simulated machines
  Deviates deviate;
  int below = 0;
  int far_below = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    HeldOutErrors errors = TenDays();
    for (HeldOutErrors::Unit& unit : errors.units) {
      const double rms = std::exp(0.5 * kOfLogarithms * deviate());
      unit.residuals << 1.001, -1.0, 1.0, -1.0;
      unit.residuals *= rms;
    }
    const auto found = JudgeSessions(
        errors, {Session(errors, 0.0, std::exp(kOfLogarithms * deviate()))});
    below += found->p_rms < 0.05 ? 1 : 0;
    far_below += found->p_rms < 0.001 ? 1 : 0;
  }
  EXPECT_THAT(below, kOneInTwenty);
  EXPECT_LT(far_below, 9);  // two of 2000, and five standard deviations
}

TEST(SensorRelations, AccuseHealthySensorsAsOftenAsPSays) {
  constexpr Eigen::Index kSensors = 8;
  constexpr Eigen::Index kSessions = 10;
  Deviates deviate;
  int below = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    SensorRelations relations;
    relations.columns.resize(kSensors);
    relations.sessions = kSessions;
    relations.distance = Eigen::VectorXd::Ones(kSensors);
    relations.spread = Eigen::VectorXd::NullaryExpr(kSensors, [&] {
      double squares = 0.0;
      for (Eigen::Index i = 0; i < kSessions; ++i) {
        const double mean = deviate();
        squares += mean * mean;
      }
      return std::sqrt(squares / static_cast<double>(kSessions));
    });
    WatchedSession session = Session(0.0, 1.0);
    // As far from training as the sessions left out: twice the variance, and
    // the sd widened by 1.25.
    const SensorShifts shifts{
        .shift = Eigen::VectorXd::NullaryExpr(
            kSensors, [&] { return 1.25 * std::sqrt(2.0) * deviate(); }),
        .distance = Eigen::VectorXd::Ones(kSensors)};
    JudgeSensors(relations, shifts, &session);
    below += session.p_sensor < 0.05 ? 1 : 0;
  }
  EXPECT_THAT(below, kOneInTwenty);
}

// Three sensors of one temperature, by day.
data::Dataset Machine(int days, int first_day, double drift_of_b) {
  std::string text = "day,position_mm,a_degC,b_degC,c_degC,error_mm\n";
  std::mt19937_64 random(static_cast<unsigned>(first_day));
  const auto noise = [&] {
    return 0.02 * (static_cast<double>(random() % 2001) / 1000.0 - 1.0);
  };
  for (int day = first_day; day < first_day + days; ++day) {
    for (int i = 0; i < 40; ++i) {
      const double t = 20.0 + 0.1 * i + 0.5 * (day % 3);
      text += std::to_string(day) + "," + std::to_string(i) + "," +
              std::to_string(t + noise()) + "," +
              std::to_string(0.9 * t + drift_of_b + noise()) + "," +
              std::to_string(1.1 * t + noise()) + "," +
              std::to_string(0.001 * i + noise()) + "\n";
    }
  }
  return data::MakeDataset(data::ParseCsv(text, "machine.csv"), {}).dataset;
}

WatchedSession Judged(const SensorRelations& relations,
                      const data::Dataset& day) {
  WatchedSession session = Session(0.0, 0.0);
  JudgeSensors(relations,
               ShiftsOf(relations, day.input_values().rightCols(3)),
               &session);
  return session;
}

TEST(SensorRelations, NamesTheSensorThatDriftsAndLeavesHealthyOnesAlone) {
  const auto relations = LearnRelations(Machine(10, 1, 0.0));
  ASSERT_TRUE(relations);
  EXPECT_EQ(relations->columns.size(), 3U);
  EXPECT_EQ(relations->sessions, 10);
  EXPECT_GT(Judged(*relations, Machine(1, 11, 0.0)).p_sensor, 0.05);
  const WatchedSession drifting = Judged(*relations, Machine(1, 11, 0.3));
  EXPECT_EQ(drifting.sensor, "b_degC");
  EXPECT_NEAR(drifting.sensor_shift, 0.3, 0.03);
  EXPECT_LT(drifting.p_sensor, 1e-4);
}

TEST(SensorRelations, MeasuresHowFarTheOtherSensorsAreFromTraining) {
  const data::Dataset trained = Machine(10, 1, 0.0);
  const auto relations = LearnRelations(trained);
  const Eigen::MatrixXd day = Machine(1, 11, 0.3).input_values().rightCols(3);
  const SensorShifts found = ShiftsOf(*relations, day);
  for (Eigen::Index sensor = 0; sensor < 3; ++sensor) {
    const std::vector<Eigen::Index> others{(sensor + 1) % 3, (sensor + 2) % 3};
    const Eigen::MatrixXd values =
        trained.input_values().rightCols(3)(Eigen::all, others);
    const Eigen::RowVector2d mean = values.colwise().mean();
    const Eigen::MatrixXd centred = values.rowwise() - mean;
    const Eigen::Matrix2d covariance =
        centred.transpose() * centred / static_cast<double>(values.rows()) +
        1e-5 * Eigen::Matrix2d::Identity();
    const Eigen::Vector2d far =
        (day(Eigen::all, others).colwise().mean() - mean).transpose();
    EXPECT_NEAR(found.distance[sensor],
                far.dot(covariance.inverse() * far),
                1e-6 * (1.0 + found.distance[sensor]));
  }
}

TEST(SensorRelations, AShiftFarFromTrainingSaysLess) {
  const auto relations = LearnRelations(Machine(10, 1, 0.0));
  SensorShifts shifts{.shift = 3.0 * relations->spread,
                      .distance = relations->distance};
  WatchedSession near = Session(0.0, 0.0);
  JudgeSensors(*relations, shifts, &near);
  shifts.distance *= 9.0;
  WatchedSession far = Session(0.0, 0.0);
  JudgeSensors(*relations, shifts, &far);
  EXPECT_LT(near.p_sensor, far.p_sensor);
}

// Half a day is off by what rows of a day are off about its mean.
TEST(SensorRelations, PartOfADaySaysLess) {
  const auto relations = LearnRelations(Machine(10, 1, 0.0));
  EXPECT_EQ(relations->rows, 40);
  const SensorShifts shifts{.shift = 3.0 * relations->spread,
                            .distance = relations->distance};
  WatchedSession whole = Session(0.0, 0.0);
  whole.rows = 40;
  JudgeSensors(*relations, shifts, &whole);
  WatchedSession part = Session(0.0, 0.0);
  part.rows = 5;
  JudgeSensors(*relations, shifts, &part);
  EXPECT_LT(whole.p_sensor, part.p_sensor);
}

TEST(SensorRelations, NeedsThreeDaysAndTwoSensors) {
  EXPECT_FALSE(LearnRelations(Machine(2, 1, 0.0)));
}

TEST(SensorRelations, ReadsBackWhatItWroteAndRefusesOtherText) {
  const auto relations = LearnRelations(Machine(4, 1, 0.0));
  const SensorRelations read =
      SensorRelations::FromJsonText(relations->ToJsonText());
  EXPECT_EQ(read.weights, relations->weights);
  EXPECT_EQ(read.spread, relations->spread);
  EXPECT_EQ(read.within, relations->within);
  EXPECT_EQ(read.rows, relations->rows);
  EXPECT_EQ(read.variance, relations->variance);
  EXPECT_EQ(read.distance, relations->distance);
  EXPECT_EQ(read.columns, relations->columns);
  for (const char* text :
       {"", "{}", R"({"schema": "errmap-relations-1", "columns": [{}]})"}) {
    EXPECT_THROW(SensorRelations::FromJsonText(text), data::InputError) << text;
  }
}

}  // namespace
}  // namespace errmap::models
