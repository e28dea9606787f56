// Inputs and rows that a map cannot use: what is left out, and what is said.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/data/measurements/as_measured.h"
#include "tests/data/measurements/make_dataset_test_data.h"

namespace errmap::data {
namespace {

using ::testing::AnyOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using namespace as_measured;

TEST(UselessReadings, AThermometerThatEndsStuckIsLeftOut) {
  const Rows rows = Changed(Measured(), [](std::size_t i, auto* cells) {
    if (i > 46) (*cells)[kT2] = "21.5";  // 62 % of the rows
  });
  const PreparedDataset prepared = Make(Joined(rows));
  EXPECT_THAT(DroppedNames(prepared), ElementsAre("t2_degC"));
  EXPECT_THAT(prepared.remarks,
              Contains("input t2_degC is dead (stuck at 21.5 from data row 46 "
                       "on) and is left out; keep_dead keeps it"));
  EXPECT_EQ(Make(Joined(rows), {.keep_dead = true}).dataset.num_inputs(), 3);
  // One that was asked for stays, and the fault is told.
  const PreparedDataset named =
      Make(Joined(rows), {.inputs = {"t1_degC", "t2_degC"}});
  EXPECT_EQ(named.dataset.num_inputs(), 2);
  ASSERT_EQ(named.faults.size(), 1U);
  EXPECT_EQ(named.faults[0].kind, FaultKind::kStuck);
}

TEST(UselessReadings, InputsThatHoldTheErrorAreLeftOut) {
  const auto with = [](const std::string& name, const auto& value) {
    return Joined(Changed(Measured(), [&](std::size_t i, auto* cells) {
      cells->insert(cells->end() - 1, i == 0 ? name : CsvNumber(value(*cells)));
    }));
  };
  const auto error = [](const auto& cells) { return Number(cells[kError]); };
  const auto rounded = [](double value, double decimals) {
    const double scale = std::pow(10.0, decimals);
    return std::round(value * scale) / scale;
  };
  const auto actual = [&](const auto& cells) {
    return rounded(Number(cells[kPosition]) + error(cells) / 1000.0, 6);
  };
  const auto coarse = [&](const auto& cells) {
    return rounded(actual(cells), 4);
  };
  const auto copy = [&](const auto& cells) { return -25.4 * error(cells); };
  const auto coarse_copy = [&](const auto& cells) {
    return rounded(40.0 + error(cells) / 1000.0, 4);
  };
  const auto counts = [&](const auto& cells) {
    return 12345.0 +
           std::round(2000.0 * Number(cells[kPosition]) + 2.0 * error(cells));
  };
  const auto share = [&](const auto& cells) {
    const double at = Number(cells[kPosition]);
    return at == 0.0 ? 0.0 : rounded(1000.0 * error(cells) / at, 2);
  };
  double of_row_before = 0.0;
  const auto previous = [&](const auto& cells) {
    return std::exchange(of_row_before, error(cells));
  };
  for (const std::string& text : {with("actual_mm", actual),
                                  with("actual_mm", coarse),
                                  with("diameter_mm", coarse_copy),
                                  with("raw", copy),
                                  with("raw_counts", counts),
                                  with("err_ppm", share),
                                  with("previous", previous),
                                  with("dev_percent", copy)}) {
    const PreparedDataset prepared = Make(text);
    EXPECT_THAT(InputNames(prepared.dataset),
                ElementsAre("position_mm", "t1_degC", "t2_degC"));
    EXPECT_THAT(
        prepared.remarks,
        Contains(
            AnyOf(HasSubstr("holds the error itself ("),
                  HasSubstr("measures an error as the target does"),
                  HasSubstr("reads the position that position_mm commands"))));
  }
  const PreparedDataset asked =
      Make(with("actual_mm", actual), {.inputs = {"position_mm", "actual_mm"}});
  EXPECT_THAT(InputNames(asked.dataset), ElementsAre("position_mm"));
  EXPECT_THAT(asked.doubts, ElementsAre(HasSubstr("The input actual_mm")));
  EXPECT_THAT(ErrorOf(with("raw", copy), {.inputs = {"raw"}}),
              HasSubstr("no input is left: 'raw' holds the error itself"));
  // Two parts of it, of which none tells it alone.
  const auto part = [&](const auto& cells) {
    return rounded(std::sin(Number(cells[kCycle])), 3);
  };
  const std::string halves =
      Joined(Changed(Measured(), [&](std::size_t i, auto* cells) {
        const double a = i == 0 ? 0.0 : part(*cells);
        const double b = i == 0 ? 0.0 : rounded(error(*cells) - a, 3);
        cells->insert(
            cells->end() - 1,
            {i == 0 ? "a" : CsvNumber(a), i == 0 ? "b" : CsvNumber(b)});
      }));
  EXPECT_THAT(DroppedNames(Make(halves)), Contains("b"));
}

TEST(UselessReadings, WhatIsMadeOfTheErrorsSizeIsLeftOut) {
  const auto with = [](const std::string& name, const auto& value) {
    return Joined(Changed(Measured(), [&](std::size_t i, auto* cells) {
      if (i > 0) {
        (*cells)[kError] = Fixed(Number((*cells)[kError]) - 10.0);
      }
      cells->insert(
          cells->end() - 1,
          i == 0 ? name : CsvNumber(value(std::abs(Number((*cells)[kError])))));
    }));
  };
  const auto tenths = [](double value) { return std::round(10 * value) / 10; };
  const auto same = [](double size) { return size; };
  const auto share = [&](double size) { return tenths(size / 0.08); };
  const auto left = [&](double size) { return 8.0 - size; };
  const auto flag = [](double size) { return size > 3.0 ? 1.0 : 0.0; };
  for (const auto& [text, equation] :
       {std::pair(with("Betrag", same), "|error_um| = 1 Betrag"),
        std::pair(with("Used %", share), "|error_um| = 0.08 Used %"),
        std::pair(with("left", left), "|error_um| = 8 - 1 left"),
        std::pair(with("bad", flag), "where bad is 1")}) {
    const PreparedDataset prepared = Make(text);
    EXPECT_THAT(InputNames(prepared.dataset),
                ElementsAre("position_mm", "t1_degC", "t2_degC"));
    EXPECT_THAT(prepared.remarks, Contains(HasSubstr(equation)));
  }
  // A switch is none, and neither is one that goes with the size but loosely.
  int row = 0;
  const auto by_turns = [&](double) {
    return (row++ / 7) % 2 == 0 ? 1.0 : 0.0;
  };
  EXPECT_THAT(DroppedNames(Make(with("pump", by_turns))), IsEmpty());
  const auto loose = [](double size) { return std::round(size) + 20.0; };
  EXPECT_THAT(DroppedNames(Make(with("load", loose))), IsEmpty());
}

// A good map is not a leak: thermometers that tell the error to their rounding.
TEST(UselessReadings, StatesThatTellTheErrorAreNoLeak) {
  const Rows rows = Changed(Measured(), [](std::size_t i, auto* cells) {
    if (i == 0) return;
    (*cells)[kError] =
        Fixed(1.5 * Number((*cells)[kT1]) + 0.02 * Number((*cells)[kPosition]));
  });
  EXPECT_THAT(Make(Joined(rows)).dropped, IsEmpty());
}

TEST(UselessReadings, RowsThatAreNoMeasurementsAreNamedAndLeftOutByAnOption) {
  const Rows rows = Measured();
  const auto changed = [&](const auto& change) {
    return Joined(Changed(rows, [&](std::size_t i, auto* cells) {
      if (i > 0) change(static_cast<int>(i) - 1, cells);
    }));
  };
  struct Case {
    std::string text;
    FaultKind kind;
    std::vector<Eigen::Index> rows;  // the first of them
    Eigen::Index left;
  };
  Rows twice;
  for (const auto& row : rows) {
    twice.push_back(row);
    if (row != rows.front()) twice.push_back(row);
  }
  const std::vector<Case> cases = {
      {Joined(twice), FaultKind::kRepeated, {1, 3, 5}, 120},
      {changed([](int i, auto* cells) {
         if (i == 38 || i == 39 || i == 118) (*cells)[kError] = "0";
       }),
       FaultKind::kZero,
       {38, 39, 118},
       117},
      {changed([](int i, auto* cells) {
         if (i >= 60) {
           (*cells)[kError] = CsvNumber(Number((*cells)[kError]) / 1000.0);
         }
       }),
       FaultKind::kOtherUnit,
       {60, 61, 62},
       60},
      {changed([](int i, auto* cells) {
         if (i % 3 == 0) (*cells)[kT1] = "-999";
       }),
       FaultKind::kImpossible,
       {0, 3, 6},
       80},
      {changed([](int i, auto* cells) {
         if (i % 4 == 0) (*cells)[kError] = "-999";
       }),
       FaultKind::kOutlying,
       {0, 4, 8},
       90},
      {changed([](int i, auto* cells) {
         if (i % 6 == 0) (*cells)[kT1] = "3276.7";
       }),
       FaultKind::kImpossible,
       {0, 6, 12},
       100},
      // Rows between two readings.
      {changed([](int i, auto* cells) {
         if (i % 3 != 1) (*cells)[kError] = "999.99";
       }),
       FaultKind::kOutlying,
       {0, 2, 3},
       40},
      {changed([](int i, auto* cells) {
         if (i == 33 || i == 71 || i == 104) {
           (*cells)[kError] = CsvNumber(Number((*cells)[kError]) * 10.0);
         }
       }),
       FaultKind::kOutlying,
       {33, 71, 104},
       117},
  };
  for (const Case& one : cases) {
    const PreparedDataset kept = Make(one.text);
    ASSERT_EQ(kept.faults.size(), 1U) << ToString(one.kind);
    EXPECT_EQ(kept.faults[0].kind, one.kind);
    EXPECT_TRUE(kept.faults[0].of_cells);
    EXPECT_TRUE(
        std::ranges::equal(one.rows,
                           std::vector(kept.faults[0].rows.begin(),
                                       kept.faults[0].rows.begin() + 3)))
        << ToString(one.kind);
    EXPECT_EQ(
        Make(one.text, {.faults = FaultPolicy::kDropRows}).dataset.num_rows(),
        one.left)
        << ToString(one.kind);
  }
  // Codes for "no reading" change every figure: the answer says so.
  for (const std::size_t i : {3U, 4U}) {
    EXPECT_THAT(Make(cases[i].text).doubts,
                ElementsAre(HasSubstr("-999, which is not a reading; ")));
  }
  // Two lost rows whose thermometer reads alike are not a reference.
  const PreparedDataset alike = Make(changed([](int i, auto* cells) {
    if (i == 38 || i == 39 || i == 118) {
      (*cells)[kError] = "0";
      (*cells)[kT2] = "22.5";
    }
  }));
  const auto zero =
      std::ranges::find(alike.faults, FaultKind::kZero, &ColumnFault::kind);
  ASSERT_NE(zero, alike.faults.end());
  EXPECT_EQ(zero->rows, (std::vector<Eigen::Index>{38, 39, 118}));
  // A block in the middle, and days by turns, in millimetres.
  const auto in_mm = [&](const auto& where) {
    return changed([&](int i, auto* cells) {
      if (where(i)) {
        (*cells)[kError] = CsvNumber(Number((*cells)[kError]) / 1000.0);
      }
    });
  };
  const auto rows_in_mm = [](const PreparedDataset& made) {
    std::vector<Eigen::Index> found;
    for (const ColumnFault& fault : made.faults) {
      EXPECT_EQ(fault.kind, FaultKind::kOtherUnit);
      found.insert(found.end(), fault.rows.begin(), fault.rows.end());
    }
    std::ranges::sort(found);
    return found;
  };
  const std::function<bool(int)> blocks[] = {
      [](int i) { return i >= 50 && i < 62; },
      [](int i) { return i >= 40 && i < 80; },
      [](int i) { return i / 20 % 2 == 1; },
      [](int i) { return i >= 112; }};
  for (const auto& block : blocks) {
    std::vector<Eigen::Index> expected;
    for (int i = 0; i < 120; ++i) {
      if (block(i)) expected.push_back(i);
    }
    EXPECT_EQ(rows_in_mm(Make(in_mm(block))), expected);
  }
  // Three codes in a row for a lost beam are no larger unit of all others.
  EXPECT_EQ(Make(changed([](int i, auto* cells) {
                   if (i >= 50 && i < 53) (*cells)[kError] = "9999";
                 }),
                 {.faults = FaultPolicy::kDropRows})
                .dataset.num_rows(),
            117);
  // A machine that errs by nothing while it is cold is in one unit.
  EXPECT_THAT(Make(changed([](int i, auto* cells) {
                const bool is_cold = i % 40 < 6;
                if (is_cold) (*cells)[kT1] = Fixed(20.002 + 0.001 * (i % 3));
                (*cells)[kError] = CsvNumber(
                    1.5 * (Number((*cells)[kT1]) - 20.0) + 0.0001 * Noise(i));
              })).faults,
              ::testing::Each(::testing::Field(
                  &ColumnFault::kind, ::testing::Ne(FaultKind::kOtherUnit))));
  // To 0.1 um so many rows have few values; a third of them without a beam.
  Rows many = {rows.front()};
  for (int repeat = 0; repeat < 20; ++repeat) {
    for (std::size_t i = 1; i < rows.size(); ++i) {
      many.push_back(rows[i]);
      auto& cells = many.back();
      cells[kDay] = std::to_string(3 * repeat + std::stoi(cells[kDay]));
      cells[kCycle] = std::to_string(24 * repeat + std::stoi(cells[kCycle]));
      cells[kT1] = Fixed(Number(cells[kT1]) + 0.01 * Noise(repeat));
      const double error = Number(cells[kError]) + 0.015 * Noise(repeat);
      cells[kError] = CsvNumber(std::round(10.0 * error) / 10.0);
      if ((i + static_cast<std::size_t>(repeat)) % 3 == 0) cells[kError] = "0";
    }
  }
  const PreparedDataset lost = Make(Joined(many));
  ASSERT_EQ(lost.faults.size(), 1U);
  EXPECT_EQ(lost.faults[0].kind, FaultKind::kZero);
  EXPECT_EQ(lost.faults[0].rows.size(), 800U);
  // Zeros where each is one: the position that errors are measured from.
  const std::string reference = changed([](int, auto* cells) {
    if ((*cells)[kPosition] == "200") (*cells)[kError] = "0";
  });
  EXPECT_THAT(Make(reference).faults, IsEmpty());
  EXPECT_THAT(Make(Joined(rows)).faults, IsEmpty());
  EXPECT_THAT(Make(Joined(rows)).doubts, IsEmpty());
}

TEST(UselessReadings, RowsOfSeveralThingsAreAskedAbout) {
  const auto with = [](const std::string& name,
                       const std::string& one,
                       const std::string& other,
                       bool differ) {
    return Joined(Changed(Measured(), [&](std::size_t i, auto* cells) {
      const bool second = (i / kPositions) % 2 == 1;
      if (i > 0 && second && differ) {
        (*cells)[kError] = Fixed(5.0 - Number((*cells)[kError]));
      }
      cells->insert(cells->begin(), i == 0 ? name : second ? other : one);
    }));
  };
  const char* const kInputs[] = {"position_mm", "t1_degC", "t2_degC"};
  for (const char* name : {"machine", "direction", "tool", "axis"}) {
    const PreparedDataset same = Make(with(name, "A", "B", false));
    EXPECT_THAT(same.remarks,
                Contains(HasSubstr("may need a map each, by where")));
    EXPECT_THAT(same.doubts, IsEmpty());
    const PreparedDataset differ = Make(with(name, "A", "B", true));
    EXPECT_THAT(differ.doubts,
                ElementsAre(HasSubstr("Rows differ by " + std::string(name) +
                                      " (A, B): ")));
    EXPECT_THAT(InputNames(differ.dataset),
                ::testing::ElementsAreArray(kInputs));
  }
  const PreparedDataset numbers = Make(with("machine", "1", "2", true));
  EXPECT_THAT(InputNames(numbers.dataset),
              ::testing::ElementsAreArray(kInputs));
  EXPECT_THAT(numbers.doubts, ElementsAre(HasSubstr("machine (1, 2)")));
  // Rows of a state in which the axis moves.
  const auto states =
      Joined(Changed(Measured(), [&](std::size_t i, auto* cells) {
        const bool moves = i % 3 == 1;
        if (i > 0 && moves) {
          (*cells)[kError] =
              Fixed(100.0 * std::sin(static_cast<double>(i * i)));
        }
        cells->insert(cells->begin(), i == 0 ? "nState" : moves ? "5" : "20");
      }));
  EXPECT_THAT(Make(states).doubts,
              ElementsAre(AllOf(HasSubstr("A linear map leaves "),
                                HasSubstr("where nState is 20, and "),
                                HasSubstr("where nState is 5; keep"))));
  // A name for each position parts nothing.
  const auto named =
      Joined(Changed(Measured(), [&](std::size_t i, auto* cells) {
        cells->insert(cells->begin(),
                      i == 0 ? "Point" : "P" + std::to_string(i % kPositions));
      }));
  EXPECT_THAT(Make(named).doubts, IsEmpty());
}

TEST(UselessReadings, CountersAreNoInputsAndCyclesAreGroups) {
  for (const std::string name : {"Zyklus",
                                 "Cycle No.",
                                 "Takt",
                                 "cycle_number",
                                 "Lauf",
                                 "run",
                                 "Messung",
                                 "Nr."}) {
    const PreparedDataset prepared =
        Make(Joined(Changed(Measured(), [&](std::size_t i, auto* cells) {
          if (i == 0) (*cells)[kCycle] = name;
        })));
    EXPECT_THAT(InputNames(prepared.dataset),
                ElementsAre("position_mm", "t1_degC", "t2_degC"))
        << name;
    EXPECT_EQ(prepared.dataset.groups().column, name);
    EXPECT_EQ(prepared.dataset.groups().labels.size(),
              static_cast<std::size_t>(kDays * kCycles))
        << name;
  }
}

TEST(UselessReadings, WhatNeverFallsOrNumbersPlacesIsNoSensor) {
  const PreparedDataset prepared =
      Make(Joined(Changed(Measured(), [](std::size_t row, auto* cells) {
        const bool names = row == 0;
        cells->push_back(
            names ? "Op. hours"
                  : Fixed(8000.0 + 0.003 * static_cast<double>(row)));
        cells->push_back(
            names ? "StdOrder"
                  : std::to_string(std::stoi((*cells)[3]) / 100 + 1));
      })));
  EXPECT_THAT(prepared.reading.sensors, ElementsAre("t1_degC", "t2_degC"));
}

}  // namespace
}  // namespace errmap::data
