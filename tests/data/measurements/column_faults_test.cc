#include "data/measurements/column_faults.h"

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/turning_centre/simulation.h"
#include "data/column_header.h"
#include "data/measurements/dataset.h"
#include "data/measurements/faults/thermometers.h"
#include "tests/data/measurements/as_measured.h"
#include "tests/data/measurements/make_dataset_test_data.h"
#include "tests/places.h"

namespace errmap::data {
namespace {

using Eigen::Index;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using namespace as_measured;

constexpr Index kRows = 240;
constexpr double kPi = 3.14159265358979323846;

// A machine that warms up on four days: position, five thermometers of noise
// 0.02 degC and resolution 0.01, an error in mm.
struct Machine {
  std::vector<ColumnInfo> inputs;
  Eigen::MatrixXd values;
  ColumnInfo target{"error_mm", UnitOfColumn("error_mm")};
  Eigen::VectorXd errors;
  std::vector<Index> rows;
  Index num_sessions = 4;

  explicit Machine(const std::string& unit = "degC") {
    inputs.push_back({"position_mm", UnitOfColumn("position_mm")});
    for (int t = 1; t <= 5; ++t) {
      inputs.push_back(
          {"t" + std::to_string(t) + " [" + unit + "]", UnitOfSymbol(unit)});
    }
    values.resize(kRows, 6);
    errors.resize(kRows);
    std::mt19937_64 random(3);
    for (Index i = 0; i < kRows; ++i) {
      const double hours = static_cast<double>(i % 60) / 10.0;
      values(i, 0) = static_cast<double>(i % 12) * 25.0;
      for (Index t = 1; t <= 5; ++t) {
        const double k = static_cast<double>(t);
        double reading = 20.0 + 2.0 * k * (1.0 - std::exp(-hours / (1.0 + k)));
        double noise = -6.0;  // sum of twelve uniforms: nearly normal
        for (int n = 0; n < 12; ++n) {
          noise += static_cast<double>(random() >> 11U) * 0x1p-53;
        }
        reading += 0.02 * noise;
        values(i, t) = Converted(std::round(100.0 * reading) / 100.0,
                                 UnitOfSymbol("degC"),
                                 UnitOfSymbol(unit));
      }
      errors[i] =
          1e-4 * values(i, 0) + 1e-3 * std::sin(2.0 * kPi * hours / 6.0);
      rows.push_back(i);
    }
  }

  std::vector<ColumnFault> Faults() const {
    return FindColumnFaults({.target = target,
                             .target_values = errors,
                             .inputs = inputs,
                             .input_values = values,
                             .rows = rows,
                             .num_sessions = num_sessions});
  }

  ColumnFault OnlyFault() const {
    const std::vector<ColumnFault> faults = Faults();
    EXPECT_EQ(faults.size(), 1U);
    return faults.empty() ? ColumnFault{} : faults.front();
  }
};

TEST(FindColumnFaults, FindsNoneInAHealthyMachine) {
  EXPECT_THAT(Machine().Faults(), IsEmpty());
  EXPECT_THAT(Machine("K").Faults(), IsEmpty());
  EXPECT_THAT(Machine("degF").Faults(), IsEmpty());
}

TEST(FindColumnFaults, NamesValuesBeyondAnyThermometer) {
  Machine machine;
  machine.values(17, 3) = 999.9;
  machine.values(90, 3) = -127.0;
  const ColumnFault fault = machine.OnlyFault();
  EXPECT_EQ(fault.kind, FaultKind::kImpossible);
  EXPECT_EQ(fault.input, 3);
  EXPECT_THAT(fault.rows, ElementsAre(17, 90));
  EXPECT_TRUE(fault.of_cells);
  EXPECT_EQ(fault.value, 999.9);
  EXPECT_GT(fault.low, 19.0);
  EXPECT_LT(fault.high, 30.0);
  EXPECT_THAT(RowsOfCellFaults({fault, fault}), ElementsAre(17, 90));
}

TEST(FindColumnFaults, DoubtsTheUnitOfAColumnThatIsAllImpossible) {
  Machine machine;
  machine.values.col(2).array() += 273.15;
  const ColumnFault fault = machine.OnlyFault();
  EXPECT_EQ(fault.kind, FaultKind::kImpossible);
  EXPECT_FALSE(fault.of_cells);
  EXPECT_THAT(RowsOfCellFaults({fault}), IsEmpty());
}

// A day's curve from `low` to `high` and back, with a little noise.
void GoThrough(double low, double high, Index column, Machine* machine) {
  for (int i = 0; i < kRows; ++i) {
    const double way = 0.5 - 0.5 * std::cos(2.0 * kPi * (i % 60) / 60.0);
    const double reading = low + (high - low) * way + 0.03 * Noise(i);
    machine->values(i, column) = std::round(100.0 * reading) / 100.0;
  }
}

TEST(FindColumnFaults, BelievesWhatGoesTogetherHoweverColdOrHot) {
  const struct {
    const char* unit;
    double low;
    double high;
  } kCases[] = {{"K", 77.0, 77.4},
                {"K", 4.2, 4.6},
                {"degC", 600.0, 640.0},
                {"degC", 20.0, 640.0},
                {"degC", 180.0, 230.0},
                {"degC", -72.0, -49.0},
                {"degF", 350.0, 430.0}};
  for (const auto& [unit, low, high] : kCases) {
    Machine machine(unit);
    for (Index t = 1; t <= 5; ++t) GoThrough(low, high, t, &machine);
    EXPECT_THAT(machine.Faults(), IsEmpty()) << unit << " " << high;
    // One alone among others of a shop.
    if (high - low < 5.0) continue;
    machine = Machine(unit);
    GoThrough(low, high, 3, &machine);
    for (const ColumnFault& fault : machine.Faults()) {
      EXPECT_NE(fault.kind, FaultKind::kImpossible) << unit << " " << high;
    }
  }
}

TEST(FindColumnFaults, BelievesColdOnesOfWhichSomeAreWithinTheBounds) {
  Machine machine;
  for (Index t = 1; t <= 5; ++t) {
    GoThrough(-74.0 + static_cast<double>(4 * t), -44.0, t, &machine);
  }
  // A night that no row is from.
  for (Index i = 0; i < kRows; ++i) {
    if (machine.values(i, 1) < -60.0) machine.values(i, 1) -= 4.0;
  }
  EXPECT_THAT(machine.Faults(), IsEmpty());
}

TEST(FindColumnFaults, DoubtsOneInAnotherUnitThanItsLikeOrNotConnected) {
  const struct {
    const char* unit;
    double low;
    double high;
  } kCases[] = {{"degC", 292.0, 301.0},    // in K
                {"K", 19.0, 27.0},         // in degC
                {"degC", 1372.0, 1372.0},  // open: noise about one value
                {"degC", -290.0, -280.0}};
  for (const auto& [unit, low, high] : kCases) {
    Machine machine(unit);
    GoThrough(low, high, 3, &machine);
    EXPECT_EQ(machine.OnlyFault().kind, FaultKind::kImpossible) << low;
  }
}

TEST(FindColumnFaults, TakesDifferencesOfTemperaturesAsTheyAre) {
  Machine machine("K");
  GoThrough(-0.5, 8.0, 3, &machine);
  machine.inputs[3].name = "\u0394T bed [K]";
  EXPECT_THAT(machine.Faults(), IsEmpty());
}

TEST(FindColumnFaults, NamesCodesAndFarValuesOfTargetAndPosition) {
  Machine machine;
  machine.errors[5] = 9999.0;
  machine.errors[6] = 9999.0;
  machine.values(40, 0) = -999.0;
  const std::vector<ColumnFault> faults = machine.Faults();
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(faults[0].kind, FaultKind::kOutlying);
  EXPECT_EQ(faults[0].input, -1);
  EXPECT_THAT(faults[0].rows, ElementsAre(5, 6));
  EXPECT_EQ(faults[1].input, 0);
  EXPECT_THAT(faults[1].rows, ElementsAre(40));
  EXPECT_THAT(RowsOfCellFaults(faults), ElementsAre(5, 6, 40));
}

TEST(FindColumnFaults, TakesAWideTargetAsItIs) {
  Machine machine;
  machine.errors[5] = 3.0 * machine.errors.maxCoeff();
  EXPECT_THAT(machine.Faults(), IsEmpty());
}

TEST(FindColumnFaults, NamesJumpsThatComeBack) {
  Machine machine;
  machine.values(30, 4) = 0.0;
  machine.values(31, 4) = 0.0;
  machine.values(100, 4) = 85.0;
  const ColumnFault fault = machine.OnlyFault();
  EXPECT_EQ(fault.kind, FaultKind::kJump);
  EXPECT_THAT(fault.rows, ElementsAre(30, 31, 100));
  EXPECT_EQ(fault.value, 0.0);
  EXPECT_EQ(fault.low, machine.values(29, 4));
}

TEST(FindColumnFaults, ReportsDataRowsOfTheFile) {
  Machine machine;
  for (Index& row : machine.rows) row += 1000;
  machine.values(100, 4) = 85.0;
  EXPECT_THAT(machine.OnlyFault().rows, ElementsAre(1100));
}

TEST(FindColumnFaults, NamesAStepThatNoOtherThermometerMakes) {
  Machine machine;
  machine.values.col(2).segment(30, 20).array() += 6.0;
  const ColumnFault fault = machine.OnlyFault();
  EXPECT_EQ(fault.kind, FaultKind::kStep);
  EXPECT_EQ(fault.input, 2);
  EXPECT_FALSE(fault.of_cells);
  EXPECT_THAT(fault.rows, ElementsAre(30, 50));
  EXPECT_NEAR(fault.value, 6.0, 0.3);
}

TEST(FindColumnFaults, NamesAThermometerThatIsStuckInASession) {
  Machine machine;
  machine.values.col(5).segment(60, 60).setConstant(machine.values(60, 5));
  const ColumnFault fault = machine.OnlyFault();
  EXPECT_EQ(fault.kind, FaultKind::kStuck);
  EXPECT_EQ(fault.input, 5);
  EXPECT_EQ(fault.rows.front(), 60);
  EXPECT_GE(fault.rows.back(), 119);
  EXPECT_EQ(fault.value, machine.values(60, 5));
  EXPECT_GT(fault.high, 1.0);
  // Two others are witnesses enough.
  const std::vector<Index> kept{0, 3, 4, 5};
  machine.values = machine.values(Eigen::all, kept).eval();
  machine.inputs.erase(machine.inputs.begin() + 1, machine.inputs.begin() + 3);
  EXPECT_EQ(machine.OnlyFault().kind, FaultKind::kStuck);
}

TEST(FindColumnFaults, NamesANoisyThermometer) {
  Machine machine;
  std::mt19937_64 random(5);
  for (Index i = 0; i < kRows; ++i) {
    machine.values(i, 1) +=
        static_cast<double>(random() >> 11U) * 0x1p-52 - 1.0;
  }
  const ColumnFault fault = machine.OnlyFault();
  EXPECT_EQ(fault.kind, FaultKind::kNoisy);
  EXPECT_EQ(fault.input, 1);
  EXPECT_GT(fault.value, 10.0 * fault.high);
}

TEST(FindColumnFaults, NamesADriftFromSessionToSession) {
  Machine machine;
  for (Index i = 0; i < kRows; ++i) {
    machine.values(i, 3) += 1.5 * static_cast<double>(i) / kRows;
  }
  const ColumnFault fault = machine.OnlyFault();
  EXPECT_EQ(fault.kind, FaultKind::kDrifting);
  EXPECT_EQ(fault.input, 3);
  EXPECT_NEAR(fault.value, 1.5, 0.3);
  machine.num_sessions = 1;  // it might as well be one slow warm-up
  EXPECT_THAT(machine.Faults(), IsEmpty());
}

// 0.04 degC an hour, with three other thermometers and, over a day more, with
// one alone.
TEST(FindColumnFaults, NamesASlowDriftBesideFewOthers) {
  for (const int others : {3, 1}) {
    Rows rows = Measured(others == 3 ? kDays : kDays + 1);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (int k = 3; k < 2 + others; ++k) {
        const double own = 0.02 * Noise(static_cast<int>(i) + 2000 * k);
        rows[i].push_back(
            i == 0
                ? "t" + std::to_string(k) + "_degC"
                : Fixed(18.0 + 0.3 * k * (Number(rows[i][kT2]) - 19.0) + own));
      }
      if (i == 0) continue;
      const double hours =
          24.0 * Number(rows[i][kDay]) + Number(rows[i][kTime]) / 3600.0;
      rows[i][kT1] = Fixed(Number(rows[i][kT1]) + 0.04 * hours);
    }
    const std::vector<ColumnFault> faults = Make(Joined(rows)).faults;
    ASSERT_EQ(faults.size(), 1U) << others;
    EXPECT_EQ(faults[0].kind, FaultKind::kDrifting);
    EXPECT_EQ(faults[0].low, others);
  }
}

// Others that go their own ways but where a day begins, of two days or more.
TEST(FindColdDrift, NamesADriftBesideOthersUnlikeIt) {
  const auto own_way = [](const std::vector<std::string>& cells, int k) {
    const double hours = Number(cells[kTime]) / 3600.0;
    return 3.0 * std::sin((2.4 + 0.6 * k) * Number(cells[kDay]) * hours);
  };
  for (const int others : {1, 2}) {
    for (const double drift : {0.0, 0.04}) {
      Rows rows = Measured(kDays + 2);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (others == 2) rows[i].push_back(i == 0 ? "t3_degC" : rows[i][kT2]);
        if (i == 0) continue;
        const double day = Number(rows[i][kDay]);
        const double hours = 24.0 * day + Number(rows[i][kTime]) / 3600.0;
        rows[i][kT1] = Fixed(Number(rows[i][kT1]) + drift * hours);
        rows[i][kT2] = Fixed(19.0 + 0.3 * day + own_way(rows[i], 1));
        if (others == 2) {
          rows[i].back() = Fixed(19.0 + 0.3 * day + own_way(rows[i], 4));
        }
      }
      const std::vector<ColumnFault> faults = Make(Joined(rows)).faults;
      ASSERT_EQ(faults.size(), drift > 0.0 ? 1U : 0U) << others;
      if (faults.empty()) continue;
      EXPECT_EQ(faults[0].kind, FaultKind::kDrifting);
      EXPECT_EQ(faults[0].input, 1);
      EXPECT_NEAR(faults[0].value, 0.04 * 24.0 * 4.0 + 0.4, 0.1);
    }
  }
}

TEST(FindColumnFaults, SaysNothingOfFewRows) {
  Machine machine;
  machine.values.conservativeResize(8, Eigen::NoChange);
  machine.errors.conservativeResize(8);
  machine.rows.resize(8);
  machine.values(3, 2) = 85.0;
  EXPECT_THAT(machine.Faults(), IsEmpty());
}

PreparedDataset Shipped(const std::string& name) {
  return MakeDataset(ReadCsv(tests::SourceDir() + "/data/sets/" + name), {});
}

TEST(FindColumnFaults, FindsNoneInTheShippedSets) {
  EXPECT_THAT(Shipped("nistir5367_xdisp_down.csv").faults, IsEmpty());
  EXPECT_THAT(Shipped("turning_centre/x_displacement_down.csv").faults,
              IsEmpty());
  EXPECT_THAT(Shipped("turning_centre/x_displacement_up.csv").faults,
              IsEmpty());
}

// Thermocouples and positions of one sweep of a simulated machine.
struct SimulatedSweep {
  explicit SimulatedSweep(const turning_centre::SimulationOptions& options) {
    const turning_centre::Simulation simulation =
        turning_centre::Simulate(options);
    std::vector<const turning_centre::Stop*> stops;
    for (const turning_centre::Stop& stop : simulation.stops) {
      if (stop.sweep == turning_centre::Sweep::kXForward)
        stops.push_back(&stop);
    }
    const auto m = static_cast<Index>(stops.size());
    constexpr auto kSensors =
        static_cast<Index>(turning_centre::kNumThermocouples);
    values.resize(m, kSensors);
    positions.resize(m);
    for (Index i = 0; i < m; ++i) {
      const turning_centre::Stop& stop = *stops[static_cast<std::size_t>(i)];
      if (i == 0 || stop.day != stops[static_cast<std::size_t>(i - 1)]->day) {
        session_starts.push_back(i);
      }
      positions[i] = stop.position();
      for (Index t = 0; t < kSensors; ++t) {
        values(i, t) = stop.readings[static_cast<std::size_t>(t)];
      }
      rows.push_back(i);
    }
    for (Index t = 0; t < kSensors; ++t) {
      inputs.push_back(
          {"t" + std::to_string(t) + "_degC", UnitOfSymbol("degC")});
    }
    num_sessions = options.days;
  }

  std::vector<ColumnFault> Faults() const {
    const MeasuredColumns measured{.target = target,
                                   .target_values = positions,
                                   .inputs = inputs,
                                   .input_values = values,
                                   .rows = rows,
                                   .num_sessions = num_sessions};
    std::vector<ColumnFault> faults = FindColumnFaults(measured);
    if (const auto drift = FindColdDrift(measured, session_starts, faults)) {
      faults.push_back(*drift);
    }
    return faults;
  }

  ColumnInfo target{"error_mm", UnitOfSymbol("mm")};
  Eigen::VectorXd positions;
  std::vector<ColumnInfo> inputs;
  Eigen::MatrixXd values;
  std::vector<Index> rows;
  std::vector<Index> session_starts;
  Index num_sessions = 0;
};

TEST(FindColumnFaults, RaisesNoFalseAlarmOverSimulatedMachines) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const int days = 1 + static_cast<int>(seed % 5);
    EXPECT_THAT(SimulatedSweep({.seed = seed, .days = days}).Faults(),
                IsEmpty())
        << seed;
  }
}

// Nor where few of its thermometers were logged: of all 780 pairs of four
// machines none gave one, of which some are looked at here, and some triples.
TEST(FindColumnFaults, RaisesNoFalseAlarmOverFewThermometers) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SimulatedSweep sweep({.seed = seed, .days = 5});
    const SimulatedSweep all = sweep;
    int alarms = 0;
    for (Index a = 1; a < all.values.cols(); ++a) {
      for (const std::vector<Index>& few : std::vector<std::vector<Index>>{
               {a, a - 1}, {a, a / 2}, {a, a - 1, a / 2}, {a, a / 2, a / 3}}) {
        sweep.values = all.values(Eigen::all, few);
        sweep.inputs.clear();
        for (const Index i : few) {
          sweep.inputs.push_back(all.inputs[static_cast<std::size_t>(i)]);
        }
        alarms += sweep.Faults().empty() ? 0 : 1;
      }
    }
    EXPECT_EQ(alarms, 0) << seed;
  }
}

TEST(FindColumnFaults, FindsWhatFailsInASimulatedMachine) {
  const std::vector<ColumnFault> faults = SimulatedSweep({.seed = 24,
                                                          .days = 5,
                                                          .stuck = {8, 26},
                                                          .drifting = {11, 30},
                                                          .noisy = {13, 24}})
                                              .Faults();
  std::vector<std::pair<Index, FaultKind>> found;
  for (const ColumnFault& fault : faults) {
    found.emplace_back(fault.input, fault.kind);
  }
  EXPECT_THAT(found,
              ElementsAre(std::pair(8, FaultKind::kStuck),
                          std::pair(11, FaultKind::kDrifting),
                          std::pair(13, FaultKind::kNoisy),
                          std::pair(24, FaultKind::kNoisy),
                          std::pair(26, FaultKind::kStuck),
                          std::pair(30, FaultKind::kDrifting)));
}

}  // namespace
}  // namespace errmap::data
