// What more measurements would do: learning_curve, power_law, sensor_curve,
// next_states.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fitting/interruption.h"
#include "models/error_model.h"
#include "models/learning/learning_curve.h"
#include "models/learning/next_states.h"
#include "models/learning/power_law.h"
#include "models/learning/sensor_curve.h"
#include "models/recipe_catalog.h"
#include "models/study/judgement/units_of_analysis.h"
#include "stats/distributions.h"
#include "stats/random.h"
#include "tests/models/simulated_days.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using errmap::testing::SimulatedDays;

double Law(double size) { return std::hypot(1.0, 4.0 * std::pow(size, -0.8)); }

TEST(PowerLaw, HoldsTheLawThatMadeThePoints) {
  std::vector<LearningPoint> points;
  for (const double size : {2.0, 3.0, 5.0, 8.0, 12.0}) {
    points.push_back({size, Law(size), 0.02});
  }
  const PowerLaw law(points, 10.0);
  const PowerLaw::Quantiles later = law.ErrorAt(24.0);
  EXPECT_LT(later.low, Law(24.0));
  EXPECT_GT(later.high, Law(24.0));
  EXPECT_NEAR(later.median, Law(24.0), 0.1 * Law(24.0));
  EXPECT_NEAR(law.ErrorAt(8.0).median, Law(8.0), 0.05 * Law(8.0));
}

TEST(PowerLaw, CoversTheErrorOfAllFromNoisyHalves) {
  stats::Random random(5);
  int covered = 0;
  for (int run = 0; run < 20; ++run) {
    const auto normal = [&random] {
      return stats::NormalQuantile(std::max(random.Uniform(), 1e-9));
    };
    // Mostly of the units, which all sizes are tested on.
    const double common = 0.09 * normal();
    std::vector<LearningPoint> points;
    for (const double size : {2.0, 3.0, 4.0, 5.0}) {
      const double noise = common + 0.045 * normal();
      points.push_back({size, Law(size) * std::exp(noise), 0.1});
    }
    const PowerLaw::Quantiles at = PowerLaw(points, 6.0).ErrorAt(10.0);
    covered += at.low <= Law(10.0) && Law(10.0) <= at.high ? 1 : 0;
  }
  EXPECT_GE(covered, 17);
}

TEST(PowerLaw, TellsHowManyAGoalNeedsOrThatItIsNeverReached) {
  std::vector<LearningPoint> points;
  for (const double size : {2.0, 3.0, 5.0, 8.0, 12.0, 20.0}) {
    points.push_back({size, Law(size), 0.005});
  }
  const PowerLaw law(points, 25.0);
  // sqrt(1 + (4 n^-0.8)^2) = 1.25 at n = (16 / 3)^(1 / 0.8) = 8.1.
  const PowerLaw::Quantiles units = law.UnitsFor(1.25);
  EXPECT_LE(units.low, 9.0);
  EXPECT_GE(units.high, 9.0);
  EXPECT_GT(law.NeverReaches(0.5), 0.9);
  EXPECT_LT(law.NeverReaches(2.0), 0.01);
  EXPECT_EQ(law.UnitsFor(100.0).median, 1.0);
}

TEST(PowerLaw, RefusesOneSizeAndErrorsOfNothing) {
  EXPECT_THROW(PowerLaw({{2.0, 1.0, 0.1}, {2.0, 1.1, 0.1}}, 5.0),
               std::invalid_argument);
  EXPECT_THROW(PowerLaw({{2.0, 1.0, 0.1}, {3.0, 0.0, 0.1}}, 5.0),
               std::invalid_argument);
  EXPECT_THROW(PowerLaw({{2.0, 1.0, 0.1}, {3.0, 0.9, 0.1}}, 1.0),
               std::invalid_argument);
}

TEST(PlanLearning, TestsWholeUnitsThatTheFoldHasNotSeen) {
  const data::Dataset days = SimulatedDays(1, 6, 6);
  const LearningPlan plan = PlanLearning(days, LearnBy::kSessions, 2, 1);
  EXPECT_EQ(plan.unit, "day");
  EXPECT_EQ(plan.num_units, 6);
  EXPECT_EQ(plan.sizes, (std::vector<Index>{2, 3, 4}));
  const std::vector<Index> sessions = days.session_codes();
  for (std::size_t i = 0; i < plan.sizes.size(); ++i) {
    // Twice five folds; four of a pool of four can be drawn once.
    ASSERT_EQ(plan.holdouts[i].folds.size(), plan.sizes[i] < 4 ? 10U : 5U);
    for (const stats::Fold& fold : plan.holdouts[i].folds) {
      std::set<Index> train;
      std::set<Index> test;
      for (const Index row : fold.train) {
        train.insert(sessions[static_cast<std::size_t>(row)]);
      }
      for (const Index row : fold.test) {
        test.insert(sessions[static_cast<std::size_t>(row)]);
      }
      EXPECT_EQ(static_cast<Index>(train.size()), plan.sizes[i]);
      for (const Index session : test) EXPECT_FALSE(train.contains(session));
    }
  }
  EXPECT_THROW(PlanLearning(SimulatedDays(1, 3, 4), LearnBy::kSessions, 1, 1),
               std::invalid_argument);
}

TEST(PlanLearning, NeverTrainsOnTheSameRowsTwiceWhateverTheRepeats) {
  for (int units = 4; units <= 9; ++units) {
    const data::Dataset days = SimulatedDays(1, units, 4);
    for (const int repeats : {1, 3, 40}) {
      for (const Holdout& holdout :
           PlanLearning(days, LearnBy::kSessions, repeats, 7).holdouts) {
        std::set<std::pair<std::vector<Index>, std::vector<Index>>> fits;
        for (const stats::Fold& fold : holdout.folds) {
          EXPECT_TRUE(fits.emplace(fold.train, fold.test).second)
              << holdout.name << ", " << repeats << " repeats";
        }
        const Index folds = std::min<Index>(units, 5);
        EXPECT_EQ(static_cast<Index>(fits.size()), folds * holdout.repeats);
        EXPECT_LE(holdout.repeats, repeats);
      }
    }
  }
}

TEST(CurvesOf, FallsWithTheNumberOfDaysAndNamesWhatFails) {
  const data::Dataset days = SimulatedDays(2, 8, 6);
  const LearningPlan plan = PlanLearning(days, LearnBy::kSessions, 1, 1);
  std::vector<std::unique_ptr<ModelRecipe>> recipes;
  recipes.push_back(MakeRecipe("poly:ridge:view=raw:terms=linear"));
  recipes.push_back(MakeRecipe("poly:full:degree=12"));
  const StudyResult study =
      RunStudy(days, plan.holdouts, recipes, {.fit_all_rows = false});
  const std::vector<LearningCurve> curves = CurvesOf(days, plan, study);
  ASSERT_EQ(curves.size(), 2U);
  ASSERT_EQ(curves[0].points.size(), plan.sizes.size());
  EXPECT_LT(curves[0].points.back().rmse, curves[0].points.front().rmse);
  for (const LearningCurve::Point& point : curves[0].points) {
    EXPECT_LT(point.low, point.rmse);
    EXPECT_GT(point.high, point.rmse);
  }
  EXPECT_TRUE(curves[0].law.has_value());
  EXPECT_TRUE(curves[1].points.empty());
  EXPECT_NE(curves[1].why_failed, "");
}

// One draw of days from which a rich map explodes made the curve jump.
TEST(CurvesOf, IsThatOfTheTypicalDraw) {
  const data::Dataset days = SimulatedDays(2, 8, 6);
  const LearningPlan plan = PlanLearning(days, LearnBy::kSessions, 4, 1);
  std::vector<std::unique_ptr<ModelRecipe>> recipes;
  recipes.push_back(MakeRecipe("poly:full:degree=1:clip=none"));
  const StudyResult study =
      RunStudy(days, plan.holdouts, recipes, {.fit_all_rows = false});
  const std::vector<LearningCurve> curves = CurvesOf(days, plan, study);
  ASSERT_EQ(curves[0].points.size(), plan.sizes.size());
  for (std::size_t i = 0; i < plan.sizes.size(); ++i) {
    const HeldOutRows held = GatherHeldOut(days, plan.holdouts[i]);
    const VectorXd residuals = ResidualsOf(held, study.models[0].holdouts[i]);
    VectorXd logs = VectorXd::Zero(plan.holdouts[i].repeats);
    const std::size_t folds =
        plan.holdouts[i].folds.size() / static_cast<std::size_t>(logs.size());
    for (Index draw = 0; draw < logs.size(); ++draw) {
      double squares = 0.0;
      double rows = 0.0;
      for (std::size_t k = 0; k < held.fold_of.size(); ++k) {
        if (static_cast<Index>(held.fold_of[k] / folds) != draw) continue;
        squares += std::pow(residuals[static_cast<Index>(k)], 2);
        rows += 1.0;
      }
      logs[draw] = 0.5 * std::log(squares / rows);
    }
    EXPECT_NEAR(std::log(curves[0].points[i].rmse), logs.mean(), 1e-9);
    if (logs.size() < 2) continue;
    // What the draws scatter bounds what is known of their mean.
    const double scatter =
        std::sqrt((logs.array() - logs.mean()).square().sum() /
                  static_cast<double>(logs.size() - 1) /
                  static_cast<double>(logs.size()));
    EXPECT_GE(curves[0].points[i].relative_error, scatter);
  }
}

// The data with a target made of some of its sensors.
data::Dataset WithTruthOf(
    const data::Dataset& days,
    const std::vector<std::pair<std::string, double>>& factors) {
  data::Dataset::Parts parts{.source = "made of sensors",
                             .inputs = days.inputs(),
                             .input_values = days.input_values(),
                             .target = days.target(),
                             .target_values = {},
                             .groups = days.groups(),
                             .weights = {},
                             .rows = days.rows(),
                             .log = days.log(),
                             .log_rows = days.log_rows()};
  stats::Random random(3);
  parts.target_values = VectorXd::NullaryExpr(
      days.num_rows(), [&] { return 0.05 * (random.Uniform() - 0.5); });
  for (const auto& [sensor, factor] : factors) {
    parts.target_values +=
        factor * days.input_values().col(days.FindInput(sensor));
  }
  return data::Dataset(std::move(parts));
}

std::set<std::string> NamesOfInLearning(const SensorCurve& curve) {
  std::set<std::string> names;
  for (const SensorCurve::Chosen& chosen : curve.chosen) {
    names.insert(chosen.sensor);
  }
  return names;
}

TEST(LearnSensors, FindsTheTwoSensorsThatTheTruthUses) {
  const data::Dataset days = WithTruthOf(
      SimulatedDays(4, 6, 8), {{"t12_degC", 1.0}, {"t27_degC", -1.5}});
  const SensorCurve curve = LearnSensors(days, {.most_sensors = 4});
  EXPECT_EQ(curve.enough, 2);
  EXPECT_EQ(NamesOfInLearning(curve),
            (std::set<std::string>{"t12_degC", "t27_degC"}));
  EXPECT_EQ(curve.chosen[0].stability, 1.0);
  for (const SensorCurve::Chosen& chosen : curve.chosen) {
    EXPECT_GT(chosen.replaced_cost, 0.1) << chosen.sensor;
  }
}

// Either is chosen in about half of the folds, and neither is missed.
TEST(LearnSensors, TellsThatASensorThatIsThereTwiceIsMissedByNobody) {
  const data::Dataset days = WithTruthOf(
      SimulatedDays(4, 6, 8), {{"t12_degC", 1.0}, {"t27_degC", -1.5}});
  data::Dataset::Parts parts{.source = "one sensor twice",
                             .inputs = days.inputs(),
                             .input_values = days.input_values(),
                             .target = days.target(),
                             .target_values = days.target_values(),
                             .groups = days.groups(),
                             .weights = {},
                             .rows = days.rows(),
                             .log = days.log(),
                             .log_rows = days.log_rows()};
  const Index p = days.num_inputs();
  stats::Random random(5);
  parts.inputs.push_back(
      {.name = "again_degC", .unit = data::UnitOfSymbol("degC")});
  parts.input_values.conservativeResize(Eigen::NoChange, p + 1);
  parts.input_values.col(p) =
      days.input_values().col(days.FindInput("t12_degC"));
  for (double& value : parts.input_values.col(p)) {
    value += 0.002 * (random.Uniform() - 0.5);
  }
  // The log's inputs would have to be as many.
  parts.log = nullptr;
  parts.log_rows.clear();
  const SensorCurve curve =
      LearnSensors(data::Dataset(std::move(parts)), {.most_sensors = 2});
  ASSERT_EQ(curve.chosen.size(), 2U);
  for (const SensorCurve::Chosen& chosen : curve.chosen) {
    if (chosen.sensor == "t27_degC") {
      EXPECT_GT(chosen.replaced_cost, 0.1);
    } else {
      EXPECT_LT(chosen.replaced_cost, 0.05) << chosen.sensor;
    }
  }
}

TEST(LearnSensors, FindsSensorsToWhichNoSingleStepLeads) {
  const std::vector<std::pair<std::string, double>> truth = {
      {"t00_degC", 1.0},
      {"t12_degC", -1.0},
      {"t27_degC", 1.0},
      {"t36_degC", -1.0}};
  const SensorCurve curve = LearnSensors(
      WithTruthOf(SimulatedDays(4, 6, 8), truth), {.most_sensors = 4});
  EXPECT_EQ(
      NamesOfInLearning(curve),
      (std::set<std::string>{"t00_degC", "t12_degC", "t27_degC", "t36_degC"}));
}

TEST(LearnSensors, EndsWhereItIsAskedTo) {
  const std::atomic<bool> stop = true;
  EXPECT_THROW(LearnSensors(SimulatedDays(4, 4, 4), {.stop = &stop}),
               fitting::Interrupted);
}

TEST(LearnSensors, DoesMostOfItWithAFew) {
  const SensorCurve curve =
      LearnSensors(SimulatedDays(3, 8, 8), {.most_sensors = 4, .jobs = 2});
  EXPECT_EQ(curve.all.sensors, 36);
  ASSERT_EQ(curve.points.size(), 5U);
  EXPECT_LT(curve.points.back().rmse, 0.3 * curve.points.front().rmse);
  EXPECT_LE(curve.enough, 4);
}

TEST(ChooseNext, PrefersTheStateThatNothingLikeItWasMeasured) {
  const data::Dataset days = SimulatedDays(5, 3, 6);
  MatrixXd candidates = days.input_values().topRows(20);
  // The last one is much warmer, in the pattern of the day's own warming.
  const Eigen::RowVectorXd warming =
      days.input_values().row(100) - days.input_values().row(0);
  candidates.row(19) = days.input_values().row(100) + 2.0 * warming;
  const std::vector<NextState> chosen = ChooseNext(days, candidates, 3);
  ASSERT_EQ(chosen.size(), 3U);
  EXPECT_EQ(chosen[0].row, 19);
  EXPECT_LT(chosen[0].variance_left, 1.0);
  EXPECT_LT(chosen[2].variance_left, chosen[0].variance_left);
  EXPECT_GT(chosen[0].distance, chosen[1].distance);
  EXPECT_THROW(ChooseNext(days, MatrixXd::Zero(2, 3), 1),
               std::invalid_argument);
}

TEST(ChooseNext, NeedsNoStateBesidesThePosition) {
  const data::Dataset days = SimulatedDays(5, 3, 6);
  const Index position = FindPosition(days, "");
  const data::Dataset along =
      days.WithInputs({days.inputs()[static_cast<std::size_t>(position)]},
                      days.input_values().col(position));
  MatrixXd candidates(2, 1);
  const double furthest = along.input_values().maxCoeff();
  candidates << along.input_values().mean(),
      2.0 * furthest - along.input_values().minCoeff();
  const std::vector<NextState> chosen = ChooseNext(along, candidates, 2);
  ASSERT_EQ(chosen.size(), 2U);
  EXPECT_EQ(chosen[0].row, 1);
  EXPECT_LT(chosen[0].variance_left, 1.0);
  EXPECT_EQ(chosen[0].distance, 0.0);
}

TEST(ChooseNext, RefusesACandidateBeyondAllNumbers) {
  const data::Dataset days = SimulatedDays(5, 3, 6);
  MatrixXd candidates = days.input_values().topRows(3);
  candidates(1, 0) = 1e200;
  EXPECT_THAT([&] { ChooseNext(days, candidates, 1); },
              ::testing::ThrowsMessage<std::invalid_argument>(
                  ::testing::HasSubstr("too far from the measured rows")));
}

}  // namespace
}  // namespace errmap::models
