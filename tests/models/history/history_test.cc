#include "models/history/history.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/history/history_state.h"
#include "models/history/lag.h"
#include "models/history/with_history.h"
#include "models/recipe_catalog.h"
#include "tests/models/history/history_data.h"

namespace errmap::models {
namespace {

using data::Dataset;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using errmap::testing::ColumnNamed;
using errmap::testing::WanderingDays;
using errmap::testing::WithLog;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double kRoundOff = 1e-13;

std::vector<Index> OneSession(Index rows) {
  return std::vector<Index>(static_cast<std::size_t>(rows), 0);
}

Dataset OneColumn(const std::string& name,
                  const VectorXd& values,
                  const VectorXd& time) {
  return WithLog({ColumnNamed(name)}, values, time, OneSession(time.size()));
}

History Of(std::vector<DerivedInput> derived) {
  History history{.time_unit = "s",
                  .session = "day",
                  .derived = std::move(derived),
                  .form_inputs = {}};
  for (const DerivedInput& input : history.derived) {
    history.form_inputs.push_back(input.column.name);
  }
  return history;
}

// Everything there is: raw, filtered, zeroed, zeroed after the filter.
History Everything() {
  const data::ColumnInfo t1 = ColumnNamed("t1_degC");
  const data::ColumnInfo t2 = ColumnNamed("t2_degC");
  const DerivedInput slow = Ema(t1, 600.0, "s");
  History history = Of({slow,
                        Ema(t1, 60.0, "s"),
                        Ema(t2, 600.0, "s"),
                        Zeroed(t2),
                        Zeroed(slow.column)});
  history.form_inputs.insert(history.form_inputs.begin(), "t1_degC");
  return history;
}

TEST(History, NamesWhatItDerives) {
  const data::ColumnInfo t12 = ColumnNamed("t12_degC");
  EXPECT_EQ(Ema(t12, 1800.0, "s").column.name, "ema(t12_degC,1800s)");
  EXPECT_EQ(Ema(t12, 2.5, "rows").column.name, "ema(t12_degC,2.5rows)");
  EXPECT_EQ(Zeroed(t12).column.name, "zeroed(t12_degC)");
  EXPECT_EQ(Zeroed(t12).column.unit.symbol, "degC");
  EXPECT_EQ(SineOf(ColumnNamed("c_deg")).column.name, "sin(c_deg)");
  EXPECT_EQ(CosineOf(ColumnNamed("c_deg")).column.unit.symbol, "");
}

// A filter of one column at rows with these times.
VectorXd Filtered(const VectorXd& values,
                  const VectorXd& time,
                  double tau,
                  Between between = Between::kLinear) {
  DerivedInput filter = Ema(ColumnNamed("t1_degC"), tau, "s");
  filter.between = between;
  return DeriveInputs(OneColumn("t1_degC", values, time), Of({filter}));
}

constexpr double kTau = 100.0;

// Of a step at t = 0 the filter has 1 - exp(-t / tau) at t, of a ramp
// t - tau (1 - exp(-t / tau)), however time is cut into steps.
TEST(History, FollowsAStepAndARampExactlyAtIrregularTimes) {
  VectorXd time(7);
  time << 0.0, 0.0, 10.0, 11.0, 40.0, 400.0, 400.5;
  VectorXd step = VectorXd::Ones(7);
  step[0] = 0.0;
  const Eigen::ArrayXd response = 1.0 - (-time.array() / kTau).exp();
  EXPECT_LT((Filtered(step, time, kTau).array() - response).abs().maxCoeff(),
            kRoundOff);
  EXPECT_LT(
      (Filtered(time, time, kTau).array() - (time.array() - kTau * response))
          .abs()
          .maxCoeff(),
      1e3 * kRoundOff);
}

// What a map learns from readings every tau / 2 holds in a control that takes
// them every tau / 100. Where a reading is taken to hold since the one before,
// as in the first maps, the filter is then late by up to a quarter of tau.
TEST(History, HardlyDependsOnHowOftenReadingsAreTaken) {
  constexpr Index kEvery = 50;
  const VectorXd time = VectorXd::LinSpaced(2001, 0.0, 20.0 * kTau);
  const VectorXd values = (time.array() / (2.0 * kTau)).sin();
  const auto few = Eigen::seqN(0, 2000 / kEvery + 1, kEvery);
  const auto difference = [&](Between between) {
    const VectorXd often = Filtered(values, time, kTau, between);
    const VectorXd seldom = Filtered(values(few), time(few), kTau, between);
    return (often(few) - seldom).cwiseAbs().maxCoeff();
  };
  EXPECT_LT(difference(Between::kLinear), 0.006);
  EXPECT_GT(difference(Between::kHeld), 0.1);
}

TEST(MeanDecay, KeepsItsDigitsInShortSteps) {
  EXPECT_EQ(MeanDecay(0.0), 1.0);
  for (double u = 1e-12; u < 100.0; u *= 1.7) {
    const double mean = -std::expm1(-u) / u;
    EXPECT_NEAR(MeanDecay(u), mean, 2e-15 * mean) << u;
  }
}

TEST(History, BeginsEverySessionInSteadyStateAndAtZero) {
  const Dataset dataset = WanderingDays();
  const History history = Everything();
  const MatrixXd derived = DeriveInputs(dataset, history);
  for (const Index row : dataset.log()->first_rows) {
    const double t1 = dataset.input_values()(row, 0);
    const double t2 = dataset.input_values()(row, 1);
    EXPECT_EQ(VectorXd(derived.row(row).transpose()),
              (VectorXd(6) << t1, t1, t1, t2, 0.0, 0.0).finished());
  }
}

TEST(History, LetsTheLaterOfTwoRowsAtOneTimeReplaceTheEarlier) {
  VectorXd time(4);
  time << 0.0, 5.0, 5.0, 9.0;
  VectorXd values(4);
  values << 20.0, 30.0, 24.0, 24.0;
  const History history = Of(
      {Ema(ColumnNamed("t1_degC"), 8.0, "s"), Zeroed(ColumnNamed("t1_degC"))});
  const MatrixXd derived =
      DeriveInputs(OneColumn("t1_degC", values, time), history);
  EXPECT_EQ(derived(2, 0), derived(1, 0));
  EXPECT_EQ(derived(2, 1), 4.0);
  EXPECT_NEAR(derived(3, 0),
              derived(1, 0) + (1.0 - std::exp(-0.5)) * (24.0 - derived(1, 0)),
              kRoundOff);
}

TEST(History, TurnsAnglesOfAnyUnitIntoSineAndCosine) {
  for (const auto& [name, turn] :
       {std::pair("c_deg", 360.0),
        std::pair("c_rad", 2.0 * std::numbers::pi)}) {
    Dataset::Parts parts;
    parts.inputs = {ColumnNamed(name)};
    parts.input_values = VectorXd::LinSpaced(4, 0.0, 0.75 * turn);
    parts.target = ColumnNamed("error_um");
    parts.target_values = VectorXd::Zero(4);
    // No log: an angle has no memory.
    const MatrixXd derived = DeriveInputs(
        Dataset(std::move(parts)),
        Of({SineOf(ColumnNamed(name)), CosineOf(ColumnNamed(name))}));
    EXPECT_TRUE(derived.col(0).isApprox(Eigen::Vector4d(0, 1, 0, -1), 1e-12));
    EXPECT_TRUE(derived.col(1).isApprox(Eigen::Vector4d(1, 0, -1, 0), 1e-12));
  }
}

TEST(History, DerivesASelectionOfRowsAsAllRows) {
  const Dataset dataset = WanderingDays();
  const std::vector<Index> some = {3, 17, 41, 90, 119, 5};
  EXPECT_EQ(DeriveInputs(dataset.SelectRows(some), Everything()),
            DeriveInputs(dataset, Everything())(some, Eigen::all));
}

TEST(History, KnowsNothingOfLaterRowsNorOfOtherSessions) {
  const Dataset dataset = WanderingDays();
  const MatrixXd derived = DeriveInputs(dataset, Everything());
  constexpr Index kChanged = 55;  // in the second of three sessions of 40 rows
  MatrixXd values = dataset.input_values();
  values.row(kChanged).array() += 1e3;
  const MatrixXd after = DeriveInputs(WithLog(dataset.inputs(),
                                              values,
                                              dataset.log()->time,
                                              dataset.session_codes()),
                                      Everything());
  for (Index row = 0; row < dataset.num_rows(); ++row) {
    const bool may_know = row >= kChanged && row < 80;
    if (may_know) {
      EXPECT_NE(after.row(row), derived.row(row)) << row;
    } else {
      EXPECT_EQ(after.row(row), derived.row(row)) << row;
    }
  }
}

TEST(History, HoldsTheLastReadingWhereOneIsMissing) {
  const double nan = std::nan("");
  VectorXd time = VectorXd::LinSpaced(5, 0.0, 4.0);
  VectorXd values(5);
  values << nan, 20.0, nan, 22.0, 22.0;
  const Dataset all = OneColumn("t1_degC", VectorXd::Constant(5, 20.0), time);
  auto log = std::make_shared<data::SessionLog>(*all.log());
  log->input_values = values;
  log->first_rows = {1};
  Dataset::Parts parts;
  parts.inputs = all.inputs();
  parts.input_values = Eigen::Vector2d(20.0, 22.0);
  parts.target = all.target();
  parts.target_values = Eigen::Vector2d::Zero();
  parts.log = log;
  parts.log_rows = {1, 3};  // rows with a missing cell were dropped
  const MatrixXd derived =
      DeriveInputs(Dataset(std::move(parts)),
                   Of({Ema(ColumnNamed("t1_degC"), 1.0, "s"),
                       Zeroed(ColumnNamed("t1_degC"))}));
  EXPECT_EQ(derived.row(0), Eigen::RowVector2d(20.0, 0.0));
  // From the reading held at t = 2 on a ramp up to t = 3.
  EXPECT_NEAR(derived(1, 0), 20.0 + 2.0 * std::exp(-1.0), kRoundOff);
  EXPECT_EQ(derived(1, 1), 2.0);
}

TEST(History, TakesTheZeroAtTheFirstRowThatWasKept) {
  const Dataset dataset = WanderingDays();
  auto log = std::make_shared<data::SessionLog>(*dataset.log());
  log->first_rows = {2, 43, 80};
  Dataset::Parts parts;
  parts.inputs = dataset.inputs();
  parts.input_values = dataset.input_values();
  parts.target = dataset.target();
  parts.target_values = dataset.target_values();
  parts.log = log;
  parts.log_rows = dataset.log_rows();
  const MatrixXd derived = DeriveInputs(Dataset(std::move(parts)),
                                        Of({Zeroed(ColumnNamed("t2_degC"))}));
  const VectorXd t2 = dataset.input_values().col(1);
  EXPECT_EQ(derived(2, 0), 0.0);
  EXPECT_EQ(derived(39, 0), t2[39] - t2[2]);
  EXPECT_EQ(derived(43, 0), 0.0);
}

TEST(History, SaysWhatTheDataLack) {
  const Dataset dataset = WanderingDays();
  const auto message = [](const std::string& text) {
    return ThrowsMessage<std::invalid_argument>(HasSubstr(text));
  };
  EXPECT_THAT(
      [&] { DeriveInputs(dataset, Of({Zeroed(ColumnNamed("t9_degC"))})); },
      message("reads input 't9_degC', which memory does not have"));
  EXPECT_THAT(
      [&] { DeriveInputs(dataset, Of({SineOf(ColumnNamed("t1_degC"))})); },
      message("'t1_degC' is not an angle"));
  EXPECT_THAT(
      [&] {
        DeriveInputs(dataset, Of({Ema(ColumnNamed("t1_degC"), 0.0, "s")}));
      },
      message("must be above 0, found 0"));
  History in_rows = Of({Ema(ColumnNamed("t1_degC"), 9.0, "rows")});
  in_rows.time_unit = "rows";
  EXPECT_THAT([&] { DeriveInputs(dataset, in_rows); },
              message("filters run in rows, and the time of memory is in s"));
  Dataset::Parts parts;
  parts.source = "xdown.csv";
  parts.inputs = dataset.inputs();
  parts.input_values = dataset.input_values();
  parts.target = dataset.target();
  parts.target_values = dataset.target_values();
  EXPECT_THAT([&] { DeriveInputs(Dataset(parts), Everything()); },
              message("the sessions of xdown.csv are not known"));
}

TEST(History, MakesADatasetThatAnyRecipeFits) {
  const Dataset dataset = WanderingDays();
  const History history = Everything();
  const Dataset derived = DeriveDataset(dataset, history);
  ASSERT_EQ(derived.num_inputs(), 6);
  EXPECT_EQ(derived.inputs()[1], history.derived[0].column);
  EXPECT_EQ(derived.input_values(), DeriveInputs(dataset, history));
  EXPECT_EQ(derived.session_codes(), dataset.session_codes());
  EXPECT_EQ(derived.target_values(), dataset.target_values());
  const std::vector<Index> some = {1, 50, 100};
  EXPECT_EQ(derived.SelectRows(some).input_values(),
            DeriveInputs(dataset.SelectRows(some), history));
}

// A row each half minute: the same filters in seconds, to the last bit, since
// tau and the steps are multiples of one power of two.
TEST(History, CountsSecondsWhereItIsKnownHowOftenRowsCame) {
  constexpr double kEvery = 32.0;
  const Dataset days = WanderingDays();
  const auto dataset = [&](double step, const std::string& unit) {
    auto log = std::make_shared<data::SessionLog>(*days.log());
    log->time_unit = unit;
    log->time =
        step * VectorXd::LinSpaced(log->time.size(),
                                   0.0,
                                   static_cast<double>(log->time.size() - 1));
    Dataset::Parts parts;
    parts.inputs = days.inputs();
    parts.input_values = days.input_values();
    parts.target = days.target();
    parts.target_values = days.target_values();
    parts.log = std::move(log);
    parts.log_rows = days.log_rows();
    return Dataset(std::move(parts));
  };
  const Dataset counted = dataset(1.0, "rows");
  const FittedModel map =
      MakeRecipe("poly:ridge:view=history:history=5")->Fit(counted, {});
  ASSERT_TRUE(CountsRows(map));
  const FittedModel timed = WithRowsEvery(map, kEvery);
  EXPECT_FALSE(CountsRows(timed));
  const Dataset in_seconds = dataset(kEvery, "s");
  EXPECT_EQ(timed.Predict(in_seconds), map.Predict(counted));
  EXPECT_EQ(timed.history->longest_bridged(),
            kEvery * map.history->longest_bridged());
  EXPECT_EQ(timed.history->settles_after(),
            kEvery * map.history->settles_after());
  // One that counts seconds stays as it is.
  EXPECT_EQ(WithRowsEvery(timed, 2.0).history, timed.history);
}

TEST(History, TellsASessionWhoseFirstRowsAreMissing) {
  const auto data = [](double start, double offset) {
    VectorXd time(6);
    time << start, start + 10, start + 20, offset, offset + 10, offset + 20;
    return WithLog(
        {ColumnNamed("t1_degC")}, VectorXd::Ones(6), time, {0, 0, 0, 1, 1, 1});
  };
  History history = Everything();
  history.latest_start = LatestStart(data(0.0, 5.0));
  EXPECT_EQ(history.latest_start, 55.0);  // five steps of 10 later
  const std::vector<Missing> nothing(6, Missing::kNothing);
  EXPECT_EQ(FindMissing(*data(0.0, 55.0).log(), history), nothing);
  constexpr Missing kHere = Missing::kNothing;
  constexpr Missing kStart = Missing::kStart;
  EXPECT_THAT(FindMissing(*data(0.0, 56.0).log(), history),
              ElementsAre(kHere, kHere, kHere, kStart, kStart, kStart));
  // A filter forgets where it began, a zero does not.
  history.derived = {Ema(ColumnNamed("t1_degC"), 2.0, "s")};
  EXPECT_EQ(history.settles_after(), 2.0 * kSettledTaus);
  EXPECT_THAT(FindMissing(*data(0.0, 56.0).log(), history),
              ElementsAre(kHere, kHere, kHere, kStart, kHere, kHere));
  history = Everything();
  EXPECT_TRUE(std::isinf(history.settles_after()));
  // Sessions by the clock on the wall: the start of a session tells nothing.
  history.latest_start = LatestStart(data(0.0, 86400.0));
  EXPECT_TRUE(std::isnan(history.latest_start));
  EXPECT_EQ(FindMissing(*data(1e6, 2e6).log(), history), nothing);
}

// Over steps of training, or of three time constants, filters know enough; of
// a longer one they know the end, and what lay before fades.
TEST(History, TellsRowsWhoseReadingsBeforeAreMissing) {
  VectorXd time(7);
  time << 0.0, 20.0, 40.0, 150.0, 200.0, 259.0, 260.0;
  const auto log = OneColumn("t1_degC", VectorXd::Ones(7), time).log();
  History history = Of({Ema(ColumnNamed("t1_degC"), 30.0, "s")});
  const std::vector<Missing> nothing(7, Missing::kNothing);
  EXPECT_EQ(FindMissing(*log, history), nothing);  // of training no step known
  history.longest_step = 20.0;
  EXPECT_EQ(history.longest_bridged(), 90.0);
  constexpr Missing kHere = Missing::kNothing;
  constexpr Missing kGap = Missing::kReadings;
  EXPECT_THAT(FindMissing(*log, history),
              ElementsAre(kHere, kHere, kHere, kGap, kGap, kGap, kHere));
  history.longest_step = 55.0;
  EXPECT_EQ(FindMissing(*log, history), nothing);
  history = Of({Zeroed(ColumnNamed("t1_degC"))});
  history.longest_step = 20.0;
  EXPECT_EQ(FindMissing(*log, history), nothing);  // nothing is filtered
}

// Rows cannot tell that some are missing; what is filtered can.
TEST(History, TellsMissingRowsByLeapsOfWhatIsFiltered) {
  VectorXd row = VectorXd::LinSpaced(6, 0.0, 5.0);
  VectorXd training(6);
  training << 20.0, 20.5, 21.5, 21.5, 22.0, 22.5;
  const auto in_rows = [&](const VectorXd& values) {
    Dataset dataset = OneColumn("t1_degC", values, row);
    auto log = std::make_shared<data::SessionLog>(*dataset.log());
    log->time_unit = "rows";
    return dataset.WithLog(log, dataset.log_rows());
  };
  History history = Of({Ema(ColumnNamed("t1_degC"), 5.0, "rows")});
  EXPECT_TRUE(RowChanges(in_rows(training), history).empty());
  history.time_unit = "rows";
  history.row_changes = RowChanges(in_rows(training), history);
  ASSERT_EQ(history.row_changes.size(), 1U);
  EXPECT_EQ(history.row_changes[0].column, "t1_degC");
  EXPECT_EQ(history.row_changes[0].largest, 1.0);
  EXPECT_DOUBLE_EQ(history.row_changes[0].mean, 0.5);
  VectorXd probes(6);
  probes << 20.0, 22.0, 23.05, 25.1, 25.2, 25.3;
  constexpr Missing kHere = Missing::kNothing;
  constexpr Missing kGap = Missing::kReadings;
  // A leap of 2.05 counts as 4.1 rows.
  EXPECT_THAT(FindMissing(*in_rows(probes).log(), history),
              ElementsAre(kHere, kHere, kHere, kGap, kGap, kGap));
}

TEST(History, LearnsTheLongestStepOfTheTrainingSessions) {
  const Dataset dataset = WithLog({ColumnNamed("t1_degC")},
                                  VectorXd::Ones(5),
                                  (VectorXd(5) << 0, 5, 20, 0, 40).finished(),
                                  {0, 0, 0, 1, 1});
  EXPECT_EQ(LongestStep(dataset), 40.0);
  EXPECT_EQ(LongestStep(dataset.SelectRows({0, 1})), 15.0);
}

TEST(WithHistory, MakesAMapOfTheColumnsThatItReads) {
  const Dataset dataset = WanderingDays();
  const History history = Everything();
  const FittedModel of_derived =
      MakeRecipe(
          "poly:formula=\"ema(t1_degC,60s)\"+\"zeroed(ema(t1_degC,600s))\"")
          ->Fit(DeriveDataset(dataset, history), {});
  const FittedModel map = WithHistory(of_derived, dataset, history);
  ASSERT_EQ(map.inputs.size(), 1U);
  EXPECT_EQ(map.inputs[0].column.name, "t1_degC");
  EXPECT_THAT(map.history->form_inputs,
              ElementsAre("ema(t1_degC,60s)", "zeroed(ema(t1_degC,600s))"));
  EXPECT_EQ(map.history->derived.size(), 3U);
  EXPECT_EQ(map.Predict(dataset),
            of_derived.Predict(DeriveDataset(dataset, history)));
}

TEST(HistoryState, StepsAsTheDatasetIsDerived) {
  const Dataset dataset = WanderingDays();
  const History history = Everything();
  const MatrixXd derived = DeriveInputs(dataset, history);
  HistoryState state(history, dataset.inputs());
  const std::vector<Index> sessions = dataset.session_codes();
  for (Index row = 0; row < dataset.num_rows(); ++row) {
    const VectorXd readings = dataset.input_values().row(row).transpose();
    const auto at = static_cast<std::size_t>(row);
    if (row == 0 || sessions[at] != sessions[at - 1]) {
      state.Start(readings);
    } else {
      state.Step(dataset.log()->time[row] - dataset.log()->time[row - 1],
                 readings);
    }
    EXPECT_EQ(state.form_inputs(), derived.row(row).transpose()) << row;
  }
}

TEST(HistoryState, RefusesWhatCannotBe) {
  HistoryState state(Everything(),
                     {ColumnNamed("t1_degC"), ColumnNamed("t2_degC")});
  const Eigen::Vector2d readings(20.0, 21.0);
  const auto message = [](const std::string& text) {
    return ThrowsMessage<std::invalid_argument>(HasSubstr(text));
  };
  EXPECT_THAT([&] { state.Step(1.0, readings); }, message("before Start"));
  state.Start(readings);
  EXPECT_THAT([&] { state.Step(-1.0, readings); }, message("a step of -1"));
  EXPECT_THAT([&] { state.Step(std::nan(""), readings); }, message("nan"));
  EXPECT_THAT([&] { state.Start(Eigen::Vector3d::Zero()); },
              message("3 readings, expected 2"));
  History twice =
      Of({Zeroed(ColumnNamed("t1_degC")), Zeroed(ColumnNamed("t1_degC"))});
  EXPECT_THAT([&] { HistoryState(twice, {ColumnNamed("t1_degC")}); },
              message("two inputs are named 'zeroed(t1_degC)'"));
}

}  // namespace
}  // namespace errmap::models
