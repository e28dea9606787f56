#include "models/sensors/sensor_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "models/map_experience.h"
#include "models/recipe_catalog.h"
#include "models/uncertainty/add_uncertainty.h"
#include "stats/random.h"
#include "tests/models/simulated_days.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using errmap::testing::FirstSessions;
using errmap::testing::SimulatedDays;

constexpr int kTrained = 6;
constexpr int kLater = 4;

// A map with a memory of six simulated days, and four later ones.
class SensorsOfAThermalMachine : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const data::Dataset days = SimulatedDays(3, kTrained + kLater, 8);
    const data::Dataset training = FirstSessions(days, kTrained);
    map_ = new FittedModel(
        MakeRecipe("poly:ridge:view=history:terms=linear")->Fit(training, {}));
    AddExperience(training, map_);
    later_ = new data::Dataset(FirstSessions(days, kTrained, false));
  }
  static void TearDownTestSuite() {
    delete map_;
    delete later_;
  }

  static MatrixXd Day(Index day) {
    std::vector<Index> rows;
    const std::vector<Index> sessions = later_->session_codes();
    for (std::size_t i = 0; i < sessions.size(); ++i) {
      if (sessions[i] == kTrained + day) rows.push_back(static_cast<Index>(i));
    }
    std::vector<Index> columns;
    for (const TrainedInput& input : map_->inputs) {
      columns.push_back(later_->FindInput(input.column.name));
    }
    return later_->input_values()(rows, columns);
  }
  static Index At(const std::string& name) {
    for (std::size_t i = 0; i < map_->inputs.size(); ++i) {
      if (map_->inputs[i].column.name == name) return static_cast<Index>(i);
    }
    ADD_FAILURE() << name;
    return 0;
  }
  static std::string Found(const MatrixXd& readings) {
    const auto found = FindSensorFault(*map_, readings);
    if (!found) return "";
    std::string text(ToString(found->fault));
    for (const data::ColumnInfo& column : found->columns) {
      text += " " + column.name;
    }
    return text;
  }

  static inline FittedModel* map_ = nullptr;
  static inline data::Dataset* later_ = nullptr;
};

TEST_F(SensorsOfAThermalMachine, AreSoundOnDaysLikeThoseOfTraining) {
  for (Index day = 0; day < kLater; ++day) {
    EXPECT_EQ(Found(Day(day)), "") << day;
    EXPECT_EQ(Found(Day(day).topRows(5)), "") << day;
  }
}

TEST_F(SensorsOfAThermalMachine, AreNamedWhereOneIsOffDeadOrFrozen) {
  for (const char* name : {"t05_degC", "t13_degC", "t28_degC"}) {
    for (Index day = 0; day < kLater; ++day) {
      MatrixXd off = Day(day);
      off.col(At(name)).array() += 10.0;
      EXPECT_EQ(Found(off), std::string("off ") + name) << day;
      EXPECT_EQ(Found(off.topRows(5)), std::string("off ") + name) << day;
      MatrixXd dead = Day(day);
      dead.col(At(name)).setZero();
      EXPECT_EQ(Found(dead), std::string("dead ") + name) << day;
      MatrixXd frozen = Day(day);
      frozen.col(At(name)).setConstant(frozen(0, At(name)));
      EXPECT_EQ(Found(frozen), std::string("frozen ") + name) << day;
    }
  }
}

TEST_F(SensorsOfAThermalMachine, AreNamedWhereCellsAreEmpty) {
  const double empty = std::numeric_limits<double>::quiet_NaN();
  MatrixXd dead = Day(0);
  dead.col(At("t13_degC")).setZero();
  dead(0, At("t13_degC")) = empty;
  EXPECT_EQ(Found(dead), "dead t13_degC");
  // Without a row that is whole nothing else could be judged.
  MatrixXd silent = Day(0);
  silent.col(At("t13_degC")).setConstant(empty);
  EXPECT_EQ(Found(silent), "dead t13_degC");
  EXPECT_TRUE(std::isnan(FindSensorFault(*map_, silent)->value));
  MatrixXd often = Day(0);
  often.col(At("t13_degC")).head(6 * often.rows() / 10).setConstant(empty);
  EXPECT_EQ(Found(often), "");
}

TEST_F(SensorsOfAThermalMachine, AreNamedWhereOneReadingIsNone) {
  for (Index day = 0; day < kLater; ++day) {
    MatrixXd once = Day(day);
    once(7, At("t13_degC")) = -127.0;
    EXPECT_EQ(Found(once), "spike t13_degC") << day;
    EXPECT_EQ(FindSensorFault(*map_, once)->row, 7) << day;
    // What else is wrong is of more weight.
    once.col(At("t05_degC")).array() += 10.0;
    EXPECT_EQ(Found(once), "off t05_degC") << day;
  }
}

TEST_F(SensorsOfAThermalMachine, AreNamedInTheUnitThatTheirFiguresFit) {
  MatrixXd kelvin = Day(0);
  kelvin.col(At("t05_degC")).array() += 273.15;
  const auto found = FindSensorFault(*map_, kelvin);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->fault, SensorFault::kUnit);
  EXPECT_EQ(found->looks_like, "K");
}

TEST_F(SensorsOfAThermalMachine, AreNamedWhereTwoAreSwapped) {
  const std::vector<Index>& sensors = map_->applicability->columns;
  int pairs = 0;
  int named = 0;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    for (std::size_t j = i + 1; j < sensors.size(); ++j) {
      MatrixXd swapped = Day(pairs % kLater);
      swapped.col(sensors[i]).swap(swapped.col(sensors[j]));
      const auto& inputs = map_->inputs;
      const std::string wanted =
          "swapped " +
          inputs[static_cast<std::size_t>(sensors[i])].column.name + " " +
          inputs[static_cast<std::size_t>(sensors[j])].column.name;
      ++pairs;
      named += Found(swapped) == wanted ? 1 : 0;
    }
  }
  EXPECT_GE(pairs, 10);
  EXPECT_GE(named, 0.95 * pairs);
}

TEST_F(SensorsOfAThermalMachine, AreSoundWhereALogBeginsLater) {
  for (Index day = 0; day < kLater; ++day) {
    const MatrixXd whole = Day(day);
    EXPECT_EQ(Found(whole.bottomRows(whole.rows() / 3)), "") << day;
    EXPECT_EQ(Found(whole.bottomRows(2 * whole.rows() / 3)), "") << day;
  }
}

TEST_F(SensorsOfAThermalMachine, AreSoundInAStateThatIsUnlikeInAllOfThem) {
  MatrixXd warmer = Day(0);
  for (const Index sensor : map_->applicability->columns) {
    warmer.col(sensor).array() += 8.0;
  }
  EXPECT_EQ(Found(warmer), "");
}

// Thermometers follow a room by different shares. Where it is far warmer than
// in training, what the others tell of one is extrapolated.
TEST_F(SensorsOfAThermalMachine, AreSoundInARoomFarWarmerThanInTraining) {
  for (const char* slow : {"t05_degC", "t13_degC", "t28_degC"}) {
    MatrixXd warmer = Day(0);
    for (const Index sensor : map_->applicability->columns) {
      warmer.col(sensor).array() += 12.0;
    }
    warmer.col(At(slow)).array() -= 4.0;
    EXPECT_EQ(Found(warmer), "");
    warmer.col(At(slow)).array() -= 20.0;
    EXPECT_EQ(Found(warmer), std::string("off ") + slow);
  }
}

// Days of five thermometers that begin `apart` degC apart, the same each
// morning but for up to `unlike`. Then they warm: `together`, by shares that
// stay, or each by itself.
struct Mornings {
  double apart = 0.6;
  double unlike = 0.0;
  bool together = false;
};
data::Dataset DaysOf(const Mornings& mornings, int days, std::uint64_t seed) {
  stats::Random random(seed);
  std::string text =
      "session,t1_degC,t2_degC,t3_degC,t4_degC,t5_degC,error_um\n";
  for (int day = 1; day <= days; ++day) {
    const double room = 18.0 + 4.0 * random.Uniform();
    std::vector<double> start(5);
    std::vector<double> by(5);
    for (double& warming : by) warming = 1.5 * random.Uniform();
    const double warming = 2.0 + 2.5 * by.front();
    for (std::size_t i = 0; i < start.size(); ++i) {
      const auto place = static_cast<double>(i);
      start[i] = room + mornings.apart * place;
      if (!mornings.together) continue;
      start[i] += mornings.unlike * random.Uniform();
      by[i] = warming * (0.3 + 0.35 * place);
    }
    for (int row = 0; row < 40; ++row) {
      text += fmt::format("{}", day);
      for (std::size_t i = 0; i < start.size(); ++i) {
        text += fmt::format(",{:.2f}",
                            start[i] + by[i] * (1.0 - std::exp(-row / 12.0)) +
                                0.05 * random.Uniform());
      }
      text += fmt::format(",{:.3f}\n", room + random.Uniform());
    }
  }
  return data::MakeDataset(data::ParseCsv(text, "mornings.csv"),
                           {.session = "session"})
      .dataset;
}

// Of all pairs swapped in the first `rows` of ten days, the share in which one
// of both is named by a map of six others; sound days must not name any.
double ShareOfSwapsNamed(const Mornings& mornings,
                         Index rows,
                         std::uint64_t seed) {
  const data::Dataset training = DaysOf(mornings, 6, seed);
  FittedModel map = MakeRecipe("poly:full:degree=1")->Fit(training, {});
  AddExperience(training, &map);
  const data::Dataset later = DaysOf(mornings, 10, seed + 1);
  double pairs = 0.0;
  double named = 0.0;
  for (Index day = 0; day < 10; ++day) {
    const MatrixXd sound = later.input_values().middleRows(40 * day, rows);
    EXPECT_FALSE(FindSensorFault(map, sound).has_value()) << day;
    for (Index i = 0; i < sound.cols(); ++i) {
      for (Index j = i + 1; j < sound.cols(); ++j) {
        MatrixXd swapped = sound;
        swapped.col(i).swap(swapped.col(j));
        ++pairs;
        const auto found = FindSensorFault(map, swapped);
        if (!found) continue;
        named += std::ranges::any_of(found->columns, [&](const auto& column) {
          return column.name == fmt::format("t{}_degC", i + 1) ||
                 column.name == fmt::format("t{}_degC", j + 1);
        });
      }
    }
  }
  return named / pairs;
}

TEST(SensorCheck, NamesTwoSwappedByTheFirstRowsOfASession) {
  EXPECT_GE(ShareOfSwapsNamed({.apart = 0.6}, 3, 1), 0.9);
}

TEST(SensorCheck, NamesTwoSwappedByHowTheyWarmWhereMorningsDiffer) {
  constexpr Mornings kMornings{.apart = 0.0, .unlike = 1.5, .together = true};
  double share = 0.0;
  for (const std::uint64_t seed : {1, 11, 21, 31, 41}) {
    share += ShareOfSwapsNamed(kMornings, 40, seed) / 5.0;
  }
  // By all rows alone, without how sensors change, it is 0.14.
  EXPECT_GE(share, 0.65);
}

// Four sessions of 90 rows: two thermometers, and the speed that a programme
// sets, which changes with every row or stands for as long as `held`.
data::Dataset SpeedThatIsHeld(Index held) {
  stats::Random random(5);
  std::string text = "session,t1_degC,t2_degC,speed,error_um\n";
  for (int session = 1; session <= 4; ++session) {
    double speed = 0.0;
    for (Index row = 0; row < 90; ++row) {
      if (row % 30 >= held) speed = std::round(1000.0 * random.Uniform());
      const double warm = 20.0 + 0.1 * static_cast<double>(row);
      text += fmt::format("{},{:.3f},{:.3f},{},{:.3f}\n",
                          session,
                          warm + random.Uniform(),
                          warm + random.Uniform(),
                          speed,
                          warm + 0.001 * speed);
    }
  }
  return data::MakeDataset(data::ParseCsv(text, "held.csv"),
                           {.session = "session"})
      .dataset;
}

TEST(SensorCheck, CallsFrozenWhatStandsLongerThanInTraining) {
  constexpr Index kHeld = 12;
  const data::Dataset training = SpeedThatIsHeld(kHeld);
  FittedModel map = MakeRecipe("poly:full:degree=1")->Fit(training, {});
  AddExperience(training, &map);
  MatrixXd readings = training.input_values().middleRows(90 + 10, 50);
  const Index speed = training.FindInput("speed");
  readings.col(speed).tail(kHeld).setConstant(500.0);
  EXPECT_FALSE(FindSensorFault(map, readings).has_value());
  readings.col(speed).tail(4 * kHeld).setConstant(500.0);
  const auto found = FindSensorFault(map, readings);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->fault, SensorFault::kFrozen);
}

}  // namespace
}  // namespace errmap::models
