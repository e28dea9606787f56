// Nets as recipes: trainers, several starts, and how wfactor comes about.
#include "models/net/net_fit.h"

#include <cmath>
#include <set>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/net/feedforward_net.h"
#include "models/recipe_catalog.h"
#include "tests/models/model_test_data.h"

namespace errmap::models {
namespace {

using errmap::testing::QuadraticData;
using errmap::testing::ShippedMeasurements;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Property;
using ::testing::Throws;

FittedModel FitOf(const std::string& spec,
                  const data::Dataset& dataset,
                  const FitContext& context = {}) {
  return MakeRecipe(spec)->Fit(dataset, context);
}

double RmseOfInNetFit(const FittedModel& fitted, const data::Dataset& dataset) {
  return std::sqrt(
      (dataset.target_values() - fitted.Predict(dataset)).squaredNorm() /
      static_cast<double>(dataset.num_rows()));
}

TEST(ForeignNets, StartFromTheWeightsAndTheObjectiveOfScg) {
  const data::Dataset dataset = QuadraticData(60);
  const std::string options = ":hidden=4:iterations=20";
  const FittedModel scg = FitOf("net:scg" + options, dataset);
  for (const char* model : {"net:ceres",
                            "net:ceres:method=levenberg_marquardt",
                            "net:ceres:method=dogleg",
                            "net:ceres:method=bfgs",
                            "net:ceres:method=nonlinear_cg",
                            "net:nlopt",
                            "net:nlopt:method=var2",
                            "net:nlopt:method=slsqp",
                            "net:nlopt:method=tnewton_precond_restart",
                            "net:nlopt:method=mma",
                            "net:nlopt:method=sbplx",
                            "net:nlopt:method=crs2_lm"}) {
    const FittedModel fitted = FitOf(model + options, dataset);
    EXPECT_EQ(fitted.summary.initial_cost, scg.summary.initial_cost) << model;
    EXPECT_LT(fitted.summary.final_cost, fitted.summary.initial_cost) << model;
  }
}

TEST(ForeignNets, RefuseWhatTheyCannotDoInOneLine) {
  EXPECT_THAT([] { FitOf("net:nlopt:method=crs2_lm", QuadraticData(60)); },
              Throws<std::invalid_argument>(Property(
                  &std::exception::what, HasSubstr("at most 100 parameters"))));
  EXPECT_THAT([] { MakeRecipe("net:nlopt:method=newton"); },
              Throws<std::invalid_argument>(Property(
                  &std::exception::what, HasSubstr("method must be one of"))));
  EXPECT_THAT([] { MakeRecipe("net:ceres:memory=0"); },
              Throws<std::invalid_argument>(
                  Property(&std::exception::what, HasSubstr("memory"))));
}

TEST(Starts, TheLowestCostWinsAndTheFirstIsThePlainFit) {
  const data::Dataset dataset = QuadraticData(60);
  const std::string spec = "net:scg:hidden=4:iterations=30";
  const FittedModel plain = FitOf(spec, dataset, {.seed = 5});
  const FittedModel several = FitOf(spec + ":starts=6", dataset, {.seed = 5});
  EXPECT_TRUE(plain.starts.empty());
  ASSERT_EQ(several.starts.size(), 6U);
  EXPECT_EQ(several.starts[0].seed, 5U);
  EXPECT_EQ(several.starts[0].final_cost, plain.summary.final_cost);
  std::set<std::uint64_t> seeds;
  int chosen = 0;
  for (const StartResult& start : several.starts) {
    seeds.insert(start.seed);
    chosen += start.chosen ? 1 : 0;
    EXPECT_GE(start.final_cost, several.summary.final_cost);
    if (start.chosen) {
      EXPECT_EQ(start.final_cost, several.summary.final_cost);
      // Its seed alone gives the same map.
      const FittedModel again = FitOf(spec, dataset, {.seed = start.seed});
      EXPECT_EQ(again.Predict(dataset), several.Predict(dataset));
    }
    EXPECT_EQ(start.iterations, 30);
    EXPECT_TRUE(std::isnan(start.holdout_rmse));
  }
  EXPECT_EQ(seeds.size(), 6U);
  EXPECT_EQ(chosen, 1);
}

TEST(Starts, AreTheSameOnAnyNumberOfThreads) {
  const data::Dataset dataset = QuadraticData(60);
  const std::string spec = "net:scg:hidden=4:iterations=30:starts=5";
  const FittedModel one = FitOf(spec, dataset, {.explain = true, .threads = 1});
  const FittedModel two = FitOf(spec, dataset, {.explain = true, .threads = 2});
  EXPECT_EQ(one.Predict(dataset), two.Predict(dataset));
  ASSERT_EQ(one.starts.size(), two.starts.size());
  for (std::size_t i = 0; i < one.starts.size(); ++i) {
    EXPECT_EQ(one.starts[i].seed, two.starts[i].seed);
    EXPECT_EQ(one.starts[i].final_cost, two.starts[i].final_cost);
    EXPECT_EQ(one.starts[i].holdout_rmse, two.starts[i].holdout_rmse);
    EXPECT_GT(one.starts[i].holdout_rmse, 0.0);
  }
}

// Does nothing but take note of what it is to train on.
struct NotingTrainer {
  struct Step {
    double wfactor;
    Eigen::Index rows;
    bool operator==(const Step&) const = default;
  };
  fitting::Minimum operator()(const NetTraining& training,
                              const fitting::RunControl&) {
    steps.push_back({training.wfactor, training.inputs.rows()});
    EXPECT_EQ(training.targets.rows(), training.inputs.rows());
    EXPECT_EQ(training.row_weights.size(), training.inputs.rows());
    // Row i holds i, and weighs i + 1: whoever draws takes all of it.
    EXPECT_EQ(training.inputs.col(0), training.targets.col(0));
    const Eigen::VectorXd weights = training.targets.col(0).array() + 1.0;
    EXPECT_EQ(training.row_weights, weights);
    fitting::Minimum minimum;
    minimum.x = training.initial_weights.array() + 1.0;
    minimum.summary.termination = fitting::Termination::kIterationLimit;
    minimum.summary.iterations = 1;
    return minimum;
  }

  std::vector<Step> steps;
};

NetRows NumberedRows(Eigen::Index count) {
  NetRows rows;
  rows.training.shape = {.inputs = 1, .hidden = 1};
  rows.training.targets =
      Eigen::VectorXd::LinSpaced(count, 0.0, static_cast<double>(count - 1));
  rows.training.inputs = rows.training.targets;
  rows.training.row_weights = rows.training.targets.array() + 1.0;
  return rows;
}

TEST(TrainAlong, WalksOnFewOfManyRowsAndThenOnAllInAsManySteps) {
  using Step = NotingTrainer::Step;
  const auto walk = [](Eigen::Index count, std::vector<double> wfactors) {
    NotingTrainer trainer;
    const fitting::Minimum minimum =
        TrainAlong(NumberedRows(count), std::ref(trainer), wfactors, 1, {});
    EXPECT_EQ(trainer.steps.size(), wfactors.size());
    EXPECT_EQ(minimum.summary.iterations,
              static_cast<std::int64_t>(wfactors.size()));
    // Each went on from the one before.
    const Eigen::VectorXd start = InitialWeights({1, 1, 1}, 1);
    EXPECT_NEAR(
        (minimum.x - start).mean(), static_cast<double>(wfactors.size()), 1e-9);
    return trainer.steps;
  };
  constexpr Eigen::Index kFew = kMostTuningRows;
  EXPECT_THAT(walk(kFew, {1.0, 0.1, 0.01}),
              ElementsAre(Step{1.0, kFew}, Step{0.1, kFew}, Step{0.01, kFew}));
  EXPECT_THAT(
      walk(kFew + 1, {1.0, 0.1, 0.01}),
      ElementsAre(Step{0.1, kFew}, Step{0.01, kFew}, Step{0.01, kFew + 1}));
  EXPECT_THAT(walk(kFew + 1, {0.01}), ElementsAre(Step{0.01, kFew + 1}));
}

TEST(Wfactor, ByDiscrepancyGivesTheWantedRms) {
  const data::Dataset dataset = ShippedMeasurements();
  constexpr double kDelta = 0.0005;  // mm
  const FittedModel fitted = FitOf("net:scg:discrepancy=0.0005", dataset);
  EXPECT_LE(RmseOfInNetFit(fitted, dataset), kDelta * (1.0 + 1e-9));
  EXPECT_GT(RmseOfInNetFit(fitted, dataset), 0.97 * kDelta);
  ASSERT_EQ(fitted.choices.size(), 2U);
  EXPECT_EQ(fitted.choices[0].key, "wfactor");
  EXPECT_GT(std::get<double>(fitted.choices[0].value), 0.0);
  EXPECT_EQ(std::get<std::string>(fitted.choices[1].value), "yes");
  EXPECT_THAT(fitted.remarks, ElementsAre(HasSubstr("wanted 0.0005 mm")));
}

TEST(Wfactor, ByDiscrepancySaysWhereItIsNotReached) {
  const FittedModel fitted = FitOf(
      "net:scg:discrepancy=1e-9:hidden=2:iterations=50", QuadraticData(60));
  EXPECT_EQ(std::get<std::string>(fitted.choices[1].value), "no");
  EXPECT_THAT(fitted.remarks, ElementsAre(HasSubstr("not reached")));
}

TEST(Wfactor, ByCrossValidationIsTheSameOnAnyNumberOfThreads) {
  const data::Dataset dataset = ShippedMeasurements();
  const std::string spec = "net:scg:hidden=6:iterations=60:wfactor=cv";
  const FittedModel one = FitOf(spec, dataset, {.threads = 1});
  const FittedModel two = FitOf(spec, dataset, {.threads = 2});
  EXPECT_EQ(one.Predict(dataset), two.Predict(dataset));
  EXPECT_EQ(one.remarks, two.remarks);
  EXPECT_THAT(one.remarks,
              Each(HasSubstr("cross-validation over groups:5 of cycle")));
  ASSERT_EQ(one.choices.size(), 2U);
  const double wfactor = std::get<double>(one.choices[0].value);
  EXPECT_GE(wfactor, 1e-8);
  EXPECT_LE(wfactor, 10.0);
}

// A target as good as random: nothing can be learnt, and the less
// the net bends the better it does on rows left out.
TEST(Wfactor, ByCrossValidationPrefersMuchOfItWhereThereIsOnlyNoise) {
  data::Dataset::Parts parts;
  parts.source = "noise";
  parts.inputs = {{"position_mm", {}}};
  parts.target = {"error_mm", {}};
  parts.input_values.resize(40, 1);
  parts.target_values.resize(40);
  for (Eigen::Index i = 0; i < 40; ++i) {
    parts.input_values(i, 0) = static_cast<double>(i);
    parts.target_values[i] =
        std::sin(7919.0 * static_cast<double>(i * i));  // as good as random
  }
  const FittedModel fitted = FitOf("net:scg:hidden=8:iterations=300:wfactor=cv",
                                   data::Dataset(std::move(parts)));
  EXPECT_GE(std::get<double>(fitted.choices[0].value), 1e-3);
  EXPECT_EQ(std::get<std::int64_t>(fitted.choices[1].value), 60);
  EXPECT_THAT(fitted.remarks, Each(HasSubstr("blocks:5")));
}

TEST(Wfactor, RefusesOptionsThatContradict) {
  for (const auto& [spec, why] :
       std::vector<std::pair<std::string, std::string>>{
           {"net:scg:wfactor=1:discrepancy=1", "discrepancy= finds"},
           {"net:scg:starts=2:discrepancy=1", "follows one start"},
           {"net:scg:starts=0", "starts must be"},
           {"net:scg:discrepancy=0", "discrepancy must be"},
           {"net:scg:wfactor=auto", "wfactor must be cv or a number"}}) {
    EXPECT_THAT([&] { MakeRecipe(spec); },
                Throws<std::invalid_argument>(
                    Property(&std::exception::what, HasSubstr(why))))
        << spec;
  }
}

}  // namespace
}  // namespace errmap::models
