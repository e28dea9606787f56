#include "models/session/session_check.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "models/recipe_catalog.h"
#include "models/session/calibration_check.h"
#include "models/session/session_offset.h"
#include "stats/distributions.h"
#include "stats/random.h"
#include "tests/models/model_test_data.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kRows = 40;
constexpr double kStep = 300.0;  // s

// An offset that wanders (variance 0.6, memory an hour) and noise (0.4) about
// `offset`, with a wrong shape of size `slope` over the positions -1 .. 1.
HeldOutErrors::Unit Day(stats::Random* random,
                        double offset = 0.0,
                        double slope = 0.0) {
  constexpr double kMemory = 3600.0;
  const auto normal = [&] {
    return stats::NormalQuantile(std::max(random->Uniform(), 1e-12));
  };
  HeldOutErrors::Unit unit{.label = "day",
                           .rmse = 0.0,
                           .elapsed = VectorXd(kRows),
                           .position = VectorXd(kRows),
                           .residuals = VectorXd(kRows)};
  double wander = std::sqrt(0.6) * normal();
  const double kept = std::exp(-kStep / kMemory);
  for (Index i = 0; i < kRows; ++i) {
    if (i > 0) {
      wander = kept * wander + std::sqrt(0.6 * (1.0 - kept * kept)) * normal();
    }
    unit.elapsed[i] = kStep * static_cast<double>(i);
    unit.position[i] = static_cast<double>(i % 5) / 2.0 - 1.0;
    unit.residuals[i] =
        offset + wander + std::sqrt(0.4) * normal() + slope * unit.position[i];
  }
  unit.rmse = std::sqrt(unit.residuals.squaredNorm() / kRows);
  return unit;
}

HeldOutErrors DaysInSessionCheck(int count,
                                 std::uint64_t seed,
                                 double slope = 0.0) {
  stats::Random random(seed);
  HeldOutErrors errors{
      .time_unit = "s", .position = "position_mm", .rmse = 0.0, .units = {}};
  double squares = 0.0;
  for (int day = 0; day < count; ++day) {
    errors.units.push_back(Day(&random, 0.0, slope));
    squares += std::pow(errors.units.back().rmse, 2);
  }
  errors.rmse = std::sqrt(squares / count);
  return errors;
}

SessionCheck CheckAt(const HeldOutErrors& errors,
                     const HeldOutErrors::Unit& day,
                     const std::vector<Index>& rows) {
  return CheckSession(errors,
                      {.elapsed = day.elapsed(rows),
                       .position = day.position(rows),
                       .predicted = VectorXd::Zero(std::ssize(rows)),
                       .residuals = day.residuals(rows)});
}

// Probes at position 0 of a map that predicts 0.
SessionProbes ProbesAt(const VectorXd& elapsed, const VectorXd& residuals) {
  return {.elapsed = elapsed,
          .position = VectorXd::Zero(elapsed.size()),
          .predicted = VectorXd::Zero(elapsed.size()),
          .residuals = residuals};
}

std::vector<Index> RowsUpTo(Index last, Index step) {
  std::vector<Index> rows;
  for (Index row = 0; row <= last; row += step) rows.push_back(row);
  return rows;
}

TEST(CheckSession, TellsSessionsThatAreOffFromThoseThatHold) {
  const HeldOutErrors errors = DaysInSessionCheck(10, 1);
  stats::Random random(2);
  const std::vector<Index> rows = RowsUpTo(kRows - 1, 3);
  int caught = 0;
  int false_alarms = 0;
  int held = 0;
  int wrongly_held = 0;
  int apart = 0;
  for (int i = 0; i < 100; ++i) {
    const bool is_offset = i % 2 == 0;
    const SessionCheck off = CheckAt(
        errors, is_offset ? Day(&random, 5.0) : Day(&random, 0.0, 7.0), rows);
    caught += off.status == SessionStatus::kOff ? 1 : 0;
    wrongly_held += off.status == SessionStatus::kHolds ? 1 : 0;
    apart += off.remedy == (is_offset ? Remedy::kRezero : Remedy::kRefit);
    const HeldOutErrors::Unit day = Day(&random);
    const SessionCheck well = CheckAt(errors, day, rows);
    held += well.status == SessionStatus::kHolds ? 1 : 0;
    false_alarms += well.status == SessionStatus::kOff ? 1 : 0;
  }
  EXPECT_GE(caught, 95);
  EXPECT_EQ(wrongly_held, 0);
  EXPECT_LE(false_alarms, 3);
  EXPECT_GE(held, 50);
  EXPECT_GE(apart, 90);
}

// Errors of training and of the day bend alike over the positions: what that
// explains of them is not to be expected twice.
TEST(CheckSession, HoldsWhereTheShapeOfTheErrorsComesAgain) {
  constexpr double kSlope = 1.2;
  const HeldOutErrors errors = DaysInSessionCheck(6, 1, kSlope);
  stats::Random random(2);
  const std::vector<Index> rows = RowsUpTo(kRows - 1, 1);
  int held = 0;
  int off = 0;
  for (int i = 0; i < 60; ++i) {
    const auto status = CheckAt(errors, Day(&random, 0.0, kSlope), rows).status;
    held += status == SessionStatus::kHolds ? 1 : 0;
    off += status == SessionStatus::kOff ? 1 : 0;
  }
  EXPECT_GE(held, 48);
  EXPECT_LE(off, 1);
}

TEST(CheckSession, NeedsMoreThanThreeProbesForAWholeSession) {
  const HeldOutErrors errors = DaysInSessionCheck(10, 1);
  stats::Random random(2);
  HeldOutErrors::Unit day = Day(&random);
  day.residuals.setConstant(0.1);
  const auto status_of = [&](const std::vector<Index>& rows) {
    return CheckAt(errors, day, rows).status;
  };
  EXPECT_EQ(status_of({0, 13, 26, 38}), SessionStatus::kHolds);
  EXPECT_EQ(status_of({0, 19, 38}), SessionStatus::kHoldsSoFar);
}

// The first minutes of a day do not tell what it comes to.
TEST(CheckSession, SaysOfTheFirstMinutesOnlyThatTheMapHoldsSoFar) {
  const HeldOutErrors errors = DaysInSessionCheck(10, 1);
  stats::Random random(2);
  int so_far = 0;
  for (int i = 0; i < 50; ++i) {
    const SessionCheck check = CheckAt(errors, Day(&random), RowsUpTo(4, 1));
    EXPECT_NE(check.status, SessionStatus::kHolds);
    so_far += check.status == SessionStatus::kHoldsSoFar ? 1 : 0;
    if (check.status == SessionStatus::kHoldsSoFar) {
      ASSERT_TRUE(check.later.has_value());
      ASSERT_TRUE(check.next_probe.has_value());
      EXPECT_GT(*check.next_probe, 4 * kStep);
    }
  }
  EXPECT_GE(so_far, 10);
}

// Of a day whose map errs by `gain` times what it predicts.
template <typename Predicted>
SessionCheck CheckOfGain(const HeldOutErrors& errors,
                         double gain,
                         const Predicted& predicted,
                         const std::vector<Index>& rows,
                         stats::Random* random) {
  HeldOutErrors::Unit day = Day(random);
  const VectorXd map = VectorXd::NullaryExpr(kRows, predicted);
  day.residuals += (gain - 1.0) * map;
  return CheckSession(errors,
                      {.elapsed = day.elapsed(rows),
                       .position = day.position(rows),
                       .predicted = map(rows),
                       .residuals = day.residuals(rows)});
}

// What a map predicts grows over the day: a gain looks like an offset at first.
TEST(CheckSession, TellsAGainAndAnotherSignFromAnOffset) {
  HeldOutErrors errors = DaysInSessionCheck(10, 1);
  const auto predicted = [](Index row) {
    return 12.0 * static_cast<double>(row) / kRows - 4.0;
  };
  for (HeldOutErrors::Unit& unit : errors.units) {
    unit.predicted = VectorXd::NullaryExpr(kRows, predicted);
  }
  stats::Random random(3);
  const std::vector<Index> rows = RowsUpTo(kRows - 1, 2);
  for (const double gain : {2.0, -1.0}) {
    int told = 0;
    for (int i = 0; i < 30; ++i) {
      const SessionCheck check =
          CheckOfGain(errors, gain, predicted, rows, &random);
      EXPECT_NE(check.remedy, Remedy::kRezero);
      told += check.remedy == Remedy::kGain || check.remedy == Remedy::kSign;
      if (check.remedy == Remedy::kGain) {
        EXPECT_NEAR(check.gain, gain, 0.4);
      }
    }
    EXPECT_GE(told, 25) << gain;
  }
}

// Predictions of a few probes differ too little to tell a sign from an offset
// that wanders; still nobody is to measure days with the wrong sign.
TEST(CheckSession, LooksForASignOrAUnitBeforeItAsksForNewDays) {
  HeldOutErrors errors = DaysInSessionCheck(10, 1);
  const auto predicted = [](Index row) {
    return 10.0 + 6.0 * std::sin(0.3 * static_cast<double>(row));
  };
  for (HeldOutErrors::Unit& unit : errors.units) {
    unit.predicted = VectorXd::NullaryExpr(kRows, predicted);
  }
  stats::Random random(5);
  const std::vector<Index> rows = {0, 9, 11, 21, 31};
  for (const double gain : {-1.0, 2.0}) {
    for (int i = 0; i < 30; ++i) {
      const SessionCheck check =
          CheckOfGain(errors, gain, predicted, rows, &random);
      EXPECT_NE(check.remedy, Remedy::kRefit) << gain;
    }
  }
}

// Re-zeroing at the first positions would leave the others worse.
TEST(CheckSession, GivesNoOrderThatOneExplanationSpeaksAgainst) {
  HeldOutErrors errors = DaysInSessionCheck(10, 1);
  for (HeldOutErrors::Unit& unit : errors.units) {
    unit.predicted = 10.0 * unit.position;
  }
  // Five probes at one place: an offset, a gain or a shape.
  const VectorXd times = VectorXd::LinSpaced(5, 0.0, 1200.0);
  SessionProbes probes = ProbesAt(times, VectorXd::Constant(5, 8.0));
  probes.position.setConstant(1.0);
  probes.predicted.setConstant(10.0);
  const SessionCheck check = CheckSession(errors, probes);
  EXPECT_EQ(check.status, SessionStatus::kOff);
  EXPECT_EQ(check.remedy, Remedy::kUnknown);
}

// The map predicts what grows until noon and has another sign after it:
// errors in proportion to it may be a gain or go on growing.
TEST(CheckSession, SaysNoGainThatMayDoHarmLater) {
  HeldOutErrors errors = DaysInSessionCheck(10, 1);
  const auto predicted = [](Index row) {
    return row < kRows / 2 ? 0.5 * static_cast<double>(row) : -30.0;
  };
  for (HeldOutErrors::Unit& unit : errors.units) {
    unit.predicted = VectorXd::NullaryExpr(kRows, predicted);
  }
  stats::Random random(7);
  const SessionCheck check =
      CheckOfGain(errors, 1.9, predicted, RowsUpTo(kRows / 2 - 1, 1), &random);
  EXPECT_EQ(check.status, SessionStatus::kOff);
  EXPECT_EQ(check.remedy, Remedy::kUnknown);
}

TEST(CheckSession, IsLessSureOfOneProbeThanOfMany) {
  const HeldOutErrors errors = DaysInSessionCheck(10, 3);
  const SessionCheck few =
      CheckSession(errors, ProbesAt(VectorXd{{600.0}}, VectorXd{{1.0}}));
  EXPECT_NE(few.status, SessionStatus::kHolds);
  EXPECT_NE(few.status, SessionStatus::kOff);
  EXPECT_TRUE(std::isnan(few.probe_scatter));
  const SessionCheck many =
      CheckSession(errors,
                   ProbesAt(VectorXd::LinSpaced(8, 0.0, 11000.0),
                            VectorXd::Constant(8, 1.0)));
  EXPECT_LT(many.session.high - many.session.low,
            few.session.high - few.session.low);
}

TEST(CheckSession, KnowsNothingWhereTheSessionBeginsInsideOrASensorIsAtFault) {
  const HeldOutErrors errors = DaysInSessionCheck(10, 3);
  const SessionProbes probes = ProbesAt(VectorXd::LinSpaced(5, 0.0, 11000.0),
                                        VectorXd::Constant(5, 9.0));
  EXPECT_EQ(CheckSession(errors, probes).status, SessionStatus::kOff);
  const SessionCheck inside = CheckSession(errors, probes, Missing::kStart);
  EXPECT_EQ(inside.status, SessionStatus::kUnknown);
  EXPECT_EQ(inside.remedy, Remedy::kNone);
  const SensorFaultFound fault{.fault = SensorFault::kOff,
                               .columns = {{"t1_degC", {}}},
                               .looks_like = ""};
  const SessionCheck sensor =
      CheckSession(errors, probes, Missing::kStart, fault);
  EXPECT_EQ(sensor.status, SessionStatus::kSensor);
  EXPECT_EQ(sensor.remedy, Remedy::kNone);
}

TEST(CheckSession, GrowsSurerThatItIsOffTheLargerTheProbes) {
  const HeldOutErrors errors = DaysInSessionCheck(6, 4);
  const VectorXd times{{0.0, 900.0, 3000.0}};
  double before = -1.0;
  for (const double size : {0.2, 1.2, 3.2, 20.0}) {
    const SessionCheck check =
        CheckSession(errors, ProbesAt(times, VectorXd::Constant(3, size)));
    EXPECT_GE(check.session.off_probability, before);
    before = check.session.off_probability;
  }
  EXPECT_GT(before, 0.99);
}

TEST(CheckSession, RefusesNoProbesAndOnesThatAreNotFinite) {
  const HeldOutErrors errors = DaysInSessionCheck(3, 5);
  EXPECT_THROW(CheckSession(errors, {}), std::invalid_argument);
  EXPECT_THROW(
      CheckSession(errors,
                   ProbesAt(VectorXd::Zero(1), VectorXd{{std::nan("")}})),
      std::invalid_argument);
  EXPECT_THROW(
      CheckSession(errors, ProbesAt(VectorXd::Zero(2), VectorXd::Zero(1))),
      std::invalid_argument);
}

// Probes at no known place cannot tell a shape over the positions.
TEST(CheckSession, AsksForNoShapeWherePositionsOfProbesAreNotKnown) {
  const HeldOutErrors errors = DaysInSessionCheck(10, 1);
  HeldOutErrors without = errors;
  without.position.clear();
  for (HeldOutErrors::Unit& unit : without.units) unit.position.resize(0);
  stats::Random random(4);
  const HeldOutErrors::Unit day = Day(&random, 0.0, 5.0);
  const std::vector<Index> rows = RowsUpTo(kRows - 1, 3);
  const SessionProbes nowhere{.elapsed = day.elapsed(rows),
                              .position = {},
                              .predicted = VectorXd::Zero(std::ssize(rows)),
                              .residuals = day.residuals(rows)};
  const SessionCheck check = CheckSession(errors, nowhere);
  const SessionCheck expected = CheckSession(without, nowhere);
  EXPECT_EQ(check.session.low, expected.session.low);
  EXPECT_EQ(check.session.off_probability, expected.session.off_probability);
  SessionProbes placed = nowhere;
  placed.position = day.position(rows);
  EXPECT_NE(CheckSession(errors, placed).session.low, check.session.low);
  placed.position = VectorXd::Zero(2);
  EXPECT_THROW(CheckSession(errors, placed), std::invalid_argument);
  placed.position = VectorXd::Constant(std::ssize(rows), std::nan(""));
  EXPECT_THROW(CheckSession(errors, placed), std::invalid_argument);
}

// A map that fits a day exactly, and a place where the target is always 0.
TEST(RankProbeSites, LeavesOutWhereErrorsOfZeroTellNothing) {
  HeldOutErrors errors = DaysInSessionCheck(8, 6);
  errors.units.front().residuals.setZero();
  errors.units.front().rmse = 0.0;
  for (HeldOutErrors::Unit& unit : errors.units) {
    for (Index i = 0; i < kRows; ++i) {
      if (unit.position[i] > 0.4) unit.residuals[i] = 0.0;
    }
  }
  const std::vector<ProbeSite> sites = RankProbeSites(errors);
  ASSERT_FALSE(sites.empty());
  for (const ProbeSite& site : sites) {
    EXPECT_TRUE(std::isfinite(site.factor));
    EXPECT_LT(site.position_until, 0.9);
  }
}

TEST(RankProbeSites, PutsFirstWhereAProbeIsLikeItsDay) {
  HeldOutErrors errors = DaysInSessionCheck(8, 6);
  // At one end the error is exactly the day's, elsewhere it is noise.
  for (HeldOutErrors::Unit& unit : errors.units) {
    for (Index i = 0; i < kRows; ++i) {
      if (unit.position[i] > 0.4) unit.residuals[i] = unit.rmse;
    }
  }
  const std::vector<ProbeSite> sites = RankProbeSites(errors);
  ASSERT_GE(sites.size(), 6U);
  EXPECT_NEAR(sites.front().factor, 1.0, 1e-9);
  EXPECT_NEAR(sites.front().position_until, 1.0, 1e-12);
  EXPECT_GT(sites.back().factor, sites.front().factor);
}

TEST(FitOffset, FindsVarianceMemoryAndNoise) {
  const OffsetModel model = FitOffset(DaysInSessionCheck(300, 7));
  EXPECT_NEAR(model.variance, 0.6, 0.1);
  EXPECT_NEAR(model.noise, 0.4, 0.1);
  // The grid has factors of 2.
  EXPECT_GT(model.memory, 3600.0 / 2.1);
  EXPECT_LT(model.memory, 3600.0 * 2.1);
}

TEST(OffsetFilter, WeighsAProbeByWhatItCanKnow) {
  const OffsetModel model{.variance = 3.0, .memory = 100.0, .noise = 1.0};
  OffsetFilter filter(model);
  filter.Advance(50.0);
  EXPECT_EQ(filter.variance(), 3.0);
  filter.Update(2.0);
  EXPECT_NEAR(filter.offset(), 1.5, 1e-15);
  EXPECT_NEAR(filter.variance(), 0.75, 1e-15);
  filter.Advance(1e9);  // all of it has faded
  EXPECT_NEAR(filter.offset(), 0.0, 1e-12);
  EXPECT_NEAR(filter.variance(), 3.0, 1e-12);
  EXPECT_THROW(filter.Advance(0.0), std::invalid_argument);
}

TEST(TrackOffset, UsesProbesOfTheSameSessionUpToTheRow) {
  const OffsetModel model{.variance = 1.0,
                          .memory = std::numeric_limits<double>::infinity(),
                          .noise = 1.0};
  const OffsetTrack track = TrackOffset(model,
                                        {{"a", 20.0}, {"a", 10.0}, {"b", 0.0}},
                                        VectorXd{{3.0, 3.0, 100.0}},
                                        {{"a", 5.0}, {"a", 10.0}, {"a", 30.0}});
  EXPECT_EQ(track.used, (std::vector<Index>{0, 1, 2}));
  EXPECT_NEAR(track.offset[0], 0.0, 1e-15);
  EXPECT_NEAR(track.offset[1], 1.5, 1e-15);
  EXPECT_NEAR(track.offset[2], 2.0, 1e-15);
}

TEST(TrackOffset, LowersTheErrorOfLaterRows) {
  const HeldOutErrors errors = DaysInSessionCheck(10, 8);
  const OffsetModel model = FitOffset(errors);
  stats::Random random(9);
  double before = 0.0;
  double after = 0.0;
  for (int day = 0; day < 50; ++day) {
    const HeldOutErrors::Unit unit = Day(&random);
    const std::vector<Index> probes = {0, 4, 8, 12};
    std::vector<Moment> moments;
    for (const Index i : probes) moments.push_back({"d", unit.elapsed[i]});
    std::vector<Moment> later;
    for (Index i = 13; i < 21; ++i) later.push_back({"d", unit.elapsed[i]});
    const OffsetTrack track =
        TrackOffset(model, moments, unit.residuals(probes), later);
    const VectorXd rest = unit.residuals.segment(13, 8);
    before += rest.squaredNorm();
    after += (rest - track.offset).squaredNorm();
  }
  EXPECT_LT(after, 0.95 * before);
}

TEST(FitOffset, NeverTakesFewUnitsForProofThatThereIsNoOffset) {
  // Alternating errors: neighbours pull the fitted variance below 0.
  HeldOutErrors errors = DaysInSessionCheck(4, 10);
  for (HeldOutErrors::Unit& unit : errors.units) {
    for (Index i = 0; i < kRows; ++i) unit.residuals[i] = i % 2 == 0 ? 1 : -1;
  }
  const OffsetModel model = FitOffset(errors);
  EXPECT_NEAR(model.variance, 0.2, 1e-12);
  EXPECT_NEAR(model.noise, 0.8, 1e-12);
}

// Probes whose mean is 0.33 moved nothing, "known to 0.00".
TEST(OffsetFilter, NeverKnowsAnOffsetBetterThanProbesScatter) {
  OffsetFilter filter({.variance = 1e-6, .memory = 1e9, .noise = 1e-4});
  const VectorXd probes{{0.01, 0.65, 0.31, 0.36}};
  for (const double probe : probes) {
    filter.Advance(0.0);
    filter.Update(probe);
  }
  const double scatter =
      std::sqrt((probes.array() - probes.mean()).square().sum() / 3.0);
  EXPECT_GE(std::sqrt(filter.variance()), 0.999 * scatter / 2.0);
  EXPECT_TRUE(filter.contradicted());
  EXPECT_GT(filter.Widening(), 1.0);
}

TEST(OffsetFilter, HoldsNothingFromOneProbe) {
  const OffsetModel model{.variance = 3.0, .memory = 1e9, .noise = 1.0};
  OffsetFilter filter(model);
  EXPECT_EQ(filter.Widening(), 1.0);
  filter.Update(1.0);
  EXPECT_GE(filter.Widening(), 1.0);
  filter.Update(1.2);
  EXPECT_LT(filter.Widening(), 0.8);
  EXPECT_FALSE(filter.contradicted());
}

// Shares of later rows within 90 % of the model's errors, so widened.
struct WithinAndWide {
  double within = 0.0;    // share of all later rows
  double widening = 0.0;  // median of the days
};

// 200 days of which so many rows of the first half are probes; `disturb` adds
// what is wrong today.
template <typename Disturb>
WithinAndWide AfterProbes(Index num_probes, Disturb disturb) {
  constexpr double kWide = 1.645;
  constexpr int kDays = 200;
  const OffsetModel model = FitOffset(DaysInSessionCheck(6, 11));
  const double sd = std::sqrt(model.variance + model.noise);
  stats::Random random(12);
  WithinAndWide found;
  std::vector<double> widenings;
  for (int day = 0; day < kDays; ++day) {
    HeldOutErrors::Unit unit = Day(&random);
    disturb(&random, &unit);
    std::vector<Moment> moments;
    VectorXd probes(num_probes);
    for (Index k = 0; k < num_probes; ++k) {
      const Index part = kRows / 2 / num_probes;
      const auto row =
          k * part +
          static_cast<Index>(random.Below(static_cast<std::uint64_t>(part)));
      moments.push_back({"d", unit.elapsed[row]});
      probes[k] = unit.residuals[row];
    }
    std::vector<Moment> later;
    for (Index i = kRows / 2; i < kRows; ++i) {
      later.push_back({"d", unit.elapsed[i]});
    }
    const OffsetTrack track = TrackOffset(model, moments, probes, later);
    const VectorXd left =
        (unit.residuals.tail(kRows / 2) - track.offset).cwiseAbs();
    found.within += (left.array() <= kWide * sd * track.widening.array())
                        .cast<double>()
                        .mean() /
                    kDays;
    widenings.push_back(track.widening.mean());
  }
  std::ranges::nth_element(widenings, widenings.begin() + kDays / 2);
  found.widening = widenings[kDays / 2];
  return found;
}

TEST(TrackOffset, HoldsItsIntervalWhateverIsWrongToday) {
  const auto well = [](stats::Random*, HeldOutErrors::Unit*) {};
  const auto moved = [](stats::Random* random, HeldOutErrors::Unit* unit) {
    unit->residuals.array() += 10.0 * random->Uniform() - 5.0;
  };
  // What the map predicts grows over the day and differs by place.
  const auto gain = [](stats::Random* random, HeldOutErrors::Unit* unit) {
    const double size = 10.0 + 10.0 * random->Uniform();
    for (Index i = 0; i < kRows; ++i) {
      unit->residuals[i] += size * (unit->position[i] + 0.3) *
                            (0.5 + static_cast<double>(i) / kRows);
    }
  };
  for (const Index probes : {1, 2, 3, 5, 8}) {
    SCOPED_TRACE(probes);
    const WithinAndWide as_ever = AfterProbes(probes, well);
    EXPECT_NEAR(as_ever.within, 0.9, 0.05);
    EXPECT_LT(as_ever.widening, probes == 1 ? 1.3 : 1.2);
    const WithinAndWide after_offset = AfterProbes(probes, moved);
    EXPECT_NEAR(after_offset.within, 0.9, 0.05);
    EXPECT_LT(after_offset.widening, probes == 1 ? 3.3 : 2.9);
    // One probe does not show that the error differs by place: .44.
    if (probes > 1) {
      EXPECT_GE(AfterProbes(probes, gain).within, 0.8);
    }
  }
}

TEST(OffsetExplains, NearlyAllOfTheMeanSquare) {
  FittedModel fitted =
      MakeRecipe("mean")->Fit(errmap::testing::ShippedMeasurements(), {});
  const HeldOutErrors errors = DaysInSessionCheck(10, 13);
  fitted.held_out = std::make_shared<HeldOutErrors>(errors);
  stats::Random random(14);
  for (int i = 0; i < 20; ++i) {
    HeldOutErrors::Unit day = Day(&random);
    // 99 % of the mean square, and more scatter than was promised.
    day.residuals = 1.6 * day.residuals.array() + 20.0;
    const CalibrationCheck kept =
        CheckCalibration(fitted, day.residuals, VectorXd::Zero(kRows));
    EXPECT_GT(kept.offset_share, 0.97);
    EXPECT_EQ(kept.shape, ErrorShape::kOffset);
  }
}

TEST(CheckCalibration, TellsAnOffsetFromAWrongShape) {
  FittedModel fitted =
      MakeRecipe("mean")->Fit(errmap::testing::ShippedMeasurements(), {});
  fitted.held_out = std::make_shared<HeldOutErrors>(
      HeldOutErrors{.time_unit = "", .position = "", .rmse = 1.0, .units = {}});
  const VectorXd predicted = VectorXd::Zero(4);
  const VectorXd small{{0.5, -0.5, 0.5, -0.5}};
  EXPECT_EQ(CheckCalibration(fitted, small, predicted).shape,
            ErrorShape::kWithin);
  const VectorXd offset = small.array() + 5.0;
  const CalibrationCheck kept = CheckCalibration(fitted, offset, predicted);
  EXPECT_EQ(kept.shape, ErrorShape::kOffset);
  EXPECT_NEAR(kept.offset_share, 25.0 / 25.25, 1e-12);
  EXPECT_FALSE(kept.better_than_nothing());
  EXPECT_EQ(CheckCalibration(fitted, 8.0 * small, predicted).shape,
            ErrorShape::kShape);
  fitted.held_out = nullptr;
  EXPECT_FALSE(CheckCalibration(fitted, small, predicted).shape.has_value());
}

}  // namespace
}  // namespace errmap::models
