#include "models/uncertainty/unit_interval.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "models/map_experience.h"
#include "models/recipe_catalog.h"
#include "models/study/judgement/units_of_analysis.h"
#include "models/study/study_defaults.h"
#include "models/uncertainty/add_uncertainty.h"
#include "stats/distributions.h"
#include "stats/random.h"
#include "tests/models/model_test_data.h"
#include "tests/models/simulated_days.h"
#include "tests/models/study/study_test_tools.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Units of 10 rows; in unit u the sizes are (u + 1) times 1 .. 10, of either
// sign and in no order.
struct Known {
  explicit Known(Index count) : residuals(10 * count) {
    for (Index i = 0; i < residuals.size(); ++i) {
      const Index unit = i / 10;
      const Index place = (7 * i + 3) % 10;
      residuals[i] = (i % 3 == 0 ? -1.0 : 1.0) *
                     static_cast<double>((unit + 1) * (place + 1));
      units.push_back(unit);
    }
  }
  VectorXd residuals;
  std::vector<Index> units;
};

// Student's t over the normal's quantile, 0.95 each, from tables.
constexpr double kOfTwo = 2.919986 / 1.644854;
constexpr double kOfFour = 2.131847 / 1.644854;
constexpr double kUnitIntervalRounding = 1e-5;

// Units that differ as much as these count for one degree of freedom each.

TEST(UnitIntervalLevel, IsAQuantileInWhichUnitsWeighTheSameTimesStudentsT) {
  // 20 rows of one size and 5 of 1 .. 5: up to 4 they weigh 1 + 4 / 5, which is
  // 0.9 of two units.
  VectorXd residuals = VectorXd::Constant(25, -0.5);
  std::vector<Index> units(25, 0);
  for (Index i = 0; i < 5; ++i) {
    residuals[5 * i] = (i % 2 == 0 ? 1.0 : -1.0) * static_cast<double>(i + 1);
    units[static_cast<std::size_t>(5 * i)] = 1;
  }
  EXPECT_NEAR(UnitIntervalLevel(residuals, units, 0.9).half_width,
              4.0 * kOfTwo,
              kUnitIntervalRounding);
  // Sizes of at most 20 are 10 + 10 + 6 + 5 of the 40 in four units, of at most
  // 27 and 28 are 35 and 36.
  const Known four(4);
  EXPECT_NEAR(UnitIntervalLevel(four.residuals, four.units, 0.9).half_width,
              28.0 * kOfFour,
              kUnitIntervalRounding);
}

TEST(UnitIntervalLevel, IsTheQuantileItselfOfManyUnits) {
  const VectorXd residuals = VectorXd::LinSpaced(10000, -1.0, 1.0);
  std::vector<Index> units(10000);
  for (std::size_t i = 0; i < units.size(); ++i) {
    units[i] = static_cast<Index>(i);
  }
  EXPECT_NEAR(UnitIntervalLevel(residuals, units, 0.9).half_width, 0.9, 1e-3);
}

TEST(UnitIntervalLevel, SaysAtLeastWhereUnitsAreTooFew) {
  const auto at_least = [](Index units, double coverage) {
    const Known known(units);
    return UnitIntervalLevel(known.residuals, known.units, coverage).at_least;
  };
  EXPECT_TRUE(at_least(8, 0.9));
  EXPECT_FALSE(at_least(9, 0.9));
  EXPECT_TRUE(at_least(18, 0.95));
  EXPECT_FALSE(at_least(19, 0.95));
}

TEST(UnitIntervalLevel, KnowsNothingWhereAResidualIsNotKnown) {
  Known known(4);
  known.residuals[7] = std::nan("");
  EXPECT_TRUE(std::isnan(
      UnitIntervalLevel(known.residuals, known.units, 0.9).half_width));
}

// Shares of a further unit's errors within the 90 % promise, on average, where
// every unit has an offset: `draw` gives those of a run of units. Within a unit
// errors are that and noise of this standard deviation.
template <typename Draw>
double MeanCoverage(Index units, double noise, Draw&& draw) {
  constexpr int kRuns = 1000;
  constexpr Index kRows = 20;
  stats::Random random(11);
  double covered = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    const std::vector<double> offsets = draw(units + 1, &random);
    VectorXd residuals(kRows * (units + 1));
    std::vector<Index> codes;
    for (Index i = 0; i < residuals.size(); ++i) {
      codes.push_back(i / kRows);
      residuals[i] = offsets[static_cast<std::size_t>(i / kRows)] +
                     noise * stats::NormalQuantile(random.Uniform());
    }
    codes.resize(static_cast<std::size_t>(kRows * units));
    const double half_width =
        UnitIntervalLevel(residuals.head(kRows * units), codes, 0.9).half_width;
    covered += static_cast<double>(
        (residuals.tail(kRows).cwiseAbs().array() <= half_width).count());
  }
  return covered / (kRuns * static_cast<double>(kRows));
}

std::vector<double> HeavyTailed(Index count, stats::Random* random) {
  std::vector<double> offsets;
  constexpr double kFreedom = 3.0;
  for (Index i = 0; i < count; ++i) {
    offsets.push_back(stats::StudentQuantile(random->Uniform(), kFreedom));
  }
  return offsets;
}

// An autoregression of memory 0.9, in its steady state.
std::vector<double> WithMemory(Index count, stats::Random* random) {
  constexpr double kMemory = 0.9;
  std::vector<double> offsets;
  double value = stats::NormalQuantile(random->Uniform());
  for (Index i = 0; i < count; ++i) {
    offsets.push_back(value);
    value = kMemory * value + std::sqrt(1.0 - kMemory * kMemory) *
                                  stats::NormalQuantile(random->Uniform());
  }
  return offsets;
}

constexpr double kNoises[] = {0.1, 0.5};

// At least .85 is asked where units are heavy-tailed or resemble their
// neighbours. The largest unit's own quantile, taken before, held .96 of these
// heavy tails with noise 0.5 and ten units.
TEST(UnitIntervalLevel, HoldsWhatItSaysForHeavyTailsAndMemory) {
  for (const Index units : {10, 35}) {
    for (const double noise : kNoises) {
      for (const double held : {MeanCoverage(units, noise, HeavyTailed),
                                MeanCoverage(units, noise, WithMemory)}) {
        EXPECT_GT(held, 0.85) << units << " units, noise " << noise;
        EXPECT_LT(held, 0.955) << units << " units, noise " << noise;
      }
    }
  }
}

// The map fitted to the first of these sessions, and the share of the later
// ones' errors within what it promises.
struct Fitted {
  FittedModel map;
  data::Dataset later;

  double Within(Index sessions) const {
    const data::Dataset next = errmap::testing::FirstSessions(
        later, later.session_codes().front() + sessions);
    const VectorXd errors =
        next.target_values() - map.model->Predict(Eigen::MatrixXd(
                                   next.num_rows(), map.model->num_inputs()));
    return (errors.array().abs() <= map.interval->levels[0].half_width)
        .cast<double>()
        .mean();
  }
};

template <typename Draw>
Fitted FitSessions(Index known,
                   Index later,
                   Draw&& draw,
                   stats::Random* random) {
  constexpr Index kRows = 6;
  constexpr double kNoise = 0.3;
  std::string csv = "day,position_mm,error_um\n";
  Index day = 0;
  for (const double offset : draw(known + later, random)) {
    ++day;
    for (Index row = 0; row < kRows; ++row) {
      csv += fmt::format(
          "d{},{},{:.4f}\n",
          day,
          100 * row,
          offset + kNoise * stats::NormalQuantile(random->Uniform()));
    }
  }
  const data::Dataset all =
      data::MakeDataset(data::ParseCsv(csv, "days.csv"), {.session = "day"})
          .dataset;
  const data::Dataset first = errmap::testing::FirstSessions(all, known);
  Fitted fitted{MakeRecipe("mean")->Fit(first, {}),
                errmap::testing::FirstSessions(all, known, false)};
  AddUncertainty(first, MakeRecipe("mean"), {}, &fitted.map);
  return fitted;
}

// Through fit, as users get it. Without a word of how long, the 90 % of 10 and
// 35 sessions of memory 0.9 hold .64 and .79 of the errors of the next 30. Of
// 2000 runs each it is reported in 83, 91 and 99 % from 6, 10 and 35 sessions,
// and holds .92, .90 and .91 of the errors.
TEST(PredictionIntervalOf, SaysForHowLongWhereNeighbouringSessionsErrAlike) {
  constexpr int kRuns = 400;
  constexpr Index kLater = 30;
  stats::Random random(5);
  for (const Index known : {6, 10, 35}) {
    int found = 0;
    double next = 0.0;
    double later = 0.0;
    for (int run = 0; run < kRuns; ++run) {
      const Fitted fitted = FitSessions(known, kLater, WithMemory, &random);
      ASSERT_TRUE(fitted.map.interval && fitted.map.interval->of_sessions);
      const Index good_for = fitted.map.interval->good_for;
      if (good_for == 0) continue;
      ++found;
      next += fitted.Within(good_for);
      later += fitted.Within(kLater);
    }
    EXPECT_GT(found, (known == 6 ? 0.78 : 0.88) * kRuns) << known;
    EXPECT_GT(next / found, 0.87) << known;
    EXPECT_LT(later / found, next / found - 0.05) << known;
  }
  int found = 0;
  for (int run = 0; run < kRuns; ++run) {
    const Fitted fitted = FitSessions(20, 1, HeavyTailed, &random);
    if (fitted.map.interval->good_for > 0) ++found;
  }
  // So many do exclude it where there is none.
  EXPECT_LT(found, kRuns / 6);
}

data::Dataset GroupedQuadratic(Index groups) {
  constexpr Index kRows = 6;
  data::Dataset line = errmap::testing::QuadraticData(groups * kRows);
  data::Dataset::Parts parts{.source = line.source(),
                             .inputs = line.inputs(),
                             .input_values = line.input_values(),
                             .target = line.target(),
                             .target_values = line.target_values(),
                             .groups = {},
                             .weights = {},
                             .rows = {}};
  parts.groups.column = "cycle";
  for (Index group = 0; group < groups; ++group) {
    parts.groups.labels.push_back(std::to_string(group));
    for (Index i = 0; i < kRows; ++i) parts.groups.codes.push_back(group);
  }
  return data::Dataset(std::move(parts));
}

TEST(PredictionIntervalOf, ComesFromWholeUnitsAndTellsWhich) {
  const data::Dataset dataset = GroupedQuadratic(12);
  EXPECT_EQ(StrictestDefaultHoldout(dataset), "groups:5");
  FittedModel fitted = MakeRecipe("mean")->Fit(dataset, {});
  AddUncertainty(dataset, MakeRecipe("mean"), {}, &fitted);
  const auto& promise = fitted.interval;
  ASSERT_TRUE(promise.has_value());
  ASSERT_NE(fitted.held_out, nullptr);
  EXPECT_EQ(fitted.held_out->units.size(), 12U);
  EXPECT_EQ(promise->holdout, "groups:5");
  EXPECT_EQ(promise->unit, "cycle");
  EXPECT_EQ(promise->units, 12);
  EXPECT_FALSE(promise->levels[0].at_least);
  EXPECT_TRUE(promise->levels[1].at_least);
  EXPECT_GE(promise->levels[1].half_width, promise->levels[0].half_width);
  // The mean of rows that were not held out, by hand.
  const Holdout holdout =
      MakeHoldout(stats::ParseHoldout("groups:5"), dataset, 1);
  VectorXd residuals(dataset.num_rows());
  for (const stats::Fold& fold : holdout.folds) {
    const double mean = dataset.target_values()(fold.train).mean();
    for (const Index row : fold.test) {
      residuals[row] = dataset.target_values()[row] - mean;
    }
  }
  EXPECT_NEAR(
      promise->levels[0].half_width,
      UnitIntervalLevel(residuals, dataset.groups().codes, 0.9).half_width,
      1e-12);
}

TEST(PredictionIntervalOf, TellsRowsInsideAndOutsideOfWhatWasTrainedApart) {
  const data::Dataset dataset = GroupedQuadratic(12);
  const Holdout holdout =
      MakeHoldout(stats::ParseHoldout("groups:5"), dataset, 1);
  std::vector<std::unique_ptr<ModelRecipe>> recipes;
  recipes.push_back(MakeRecipe("mean"));
  const StudyResult study = RunStudy(dataset, {holdout}, recipes, {});
  const HoldoutResult& result = study.models[0].holdouts[0];
  const HeldOutRows held = GatherHeldOut(dataset, holdout);
  const VectorXd residuals = ResidualsOf(held, result);
  const double middle = residuals.cwiseAbs().mean();
  std::vector<bool> small;
  std::vector<bool> large;
  std::vector<Index> rows;
  std::vector<Index> groups;
  for (Index i = 0; i < residuals.size(); ++i) {
    small.push_back(std::abs(residuals[i]) < middle);
    large.push_back(!small.back());
    if (!small.back()) continue;
    rows.push_back(i);
    groups.push_back(dataset.groups().codes[static_cast<std::size_t>(
        held.rows[static_cast<std::size_t>(i)])]);
  }
  const auto level = PredictionIntervalOf(dataset, holdout, result, [&] {
                       return small;
                     })->levels[0];
  EXPECT_EQ(level.inside,
            std::min(UnitIntervalLevel(residuals(rows), groups, 0.9).half_width,
                     level.half_width));
  EXPECT_LT(level.inside, level.half_width);
  EXPECT_GE(level.outside, level.half_width);
  // No row inside, and rows inside that err more than those outside.
  const std::vector<bool> none(small.size(), false);
  for (const std::vector<bool>& inside : {none, large, {}}) {
    const auto same = PredictionIntervalOf(dataset, holdout, result, [&] {
                        return inside;
                      })->levels[0];
    EXPECT_EQ(same.half_width, level.half_width);
    EXPECT_EQ(same.inside, level.half_width);
    EXPECT_EQ(same.outside, level.half_width);
  }
}

TEST(PredictionIntervalOf, MakesNoneFromNeighbouringRowsOrAFitThatFails) {
  const data::Dataset dataset = GroupedQuadratic(12);
  const Holdout rows = MakeHoldout(stats::ParseHoldout("every:3"), dataset, 1);
  std::vector<std::unique_ptr<ModelRecipe>> recipes;
  recipes.push_back(MakeRecipe("mean"));
  const StudyResult study = RunStudy(dataset, {rows}, recipes, {});
  EXPECT_FALSE(PredictionIntervalOf(dataset, rows, study.models[0].holdouts[0])
                   .has_value());
  FittedModel fitted = MakeRecipe("mean")->Fit(dataset, {});
  AddUncertainty(dataset, MakeRecipe("poly:full:degree=12"), {}, &fitted);
  EXPECT_FALSE(fitted.interval.has_value());
  EXPECT_EQ(fitted.held_out, nullptr);
}

// Else a map would be written without the interval that it can have.
TEST(PredictionIntervalOf, IsNotGivenUpWhereAFoldFindsNotEnoughMemory) {
  const data::Dataset dataset = GroupedQuadratic(12);
  FittedModel fitted = MakeRecipe("mean")->Fit(dataset, {});
  int fits = 0;
  EXPECT_THROW(AddUncertainty(dataset,
                              std::make_unique<errmap::testing::CountingRecipe>(
                                  "mean",
                                  [&fits] {
                                    if (++fits == 2) throw std::bad_alloc();
                                  }),
                              {},
                              &fitted),
               std::bad_alloc);
}

}  // namespace
}  // namespace errmap::models
