#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/net/net_fit.h"
#include "models/recipe_catalog.h"
#include "tests/models/model_test_data.h"

namespace errmap::models {
namespace {

using errmap::testing::ChoicesAsOptions;
using errmap::testing::QuadraticData;
using errmap::testing::ShippedMeasurements;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Property;
using ::testing::SizeIs;
using ::testing::Throws;

FittedModel FitOfInNetTuning(const std::string& spec,
                             const data::Dataset& dataset,
                             const FitContext& context = {}) {
  return MakeRecipe(spec)->Fit(dataset, context);
}

data::Dataset OneInput(Eigen::Index rows, double (*target)(double)) {
  data::Dataset::Parts parts;
  parts.source = "curve";
  parts.inputs = {{"position_mm", {}}};
  parts.target = {"error_mm", {}};
  parts.input_values = Eigen::VectorXd::LinSpaced(rows, 0.0, 1.0);
  parts.target_values = parts.input_values.col(0).unaryExpr(target);
  return data::Dataset(std::move(parts));
}

TEST(NetTuning, TakesTheFewestNodesWithinFivePercentOfTheLeast) {
  const double nan = std::nan("");
  EXPECT_EQ(
      FewestGoodNodes({{5, 1.06}, {10, 1.05}, {20, 1.0}, {40, 1.2}}).first, 10);
  EXPECT_EQ(FewestGoodNodes({{5, 1.051}, {10, 1.2}, {20, 1.0}}).first, 20);
  EXPECT_EQ(FewestGoodNodes({{5, nan}, {10, 1.0}, {20, 0.96}}).second, 1.0);
  EXPECT_THROW(FewestGoodNodes({{5, nan}}), std::invalid_argument);
}

TEST(NetTuning, TriesAsManyNodesAsTheRowsAllow) {
  EXPECT_THAT(HiddenToTry(1), ElementsAre(5));
  EXPECT_THAT(HiddenToTry(39), ElementsAre(5));
  EXPECT_THAT(HiddenToTry(40), ElementsAre(5, 10));
  EXPECT_THAT(HiddenToTry(160), ElementsAre(5, 10, 20, 40));
  EXPECT_THAT(HiddenToTry(100'000), ElementsAre(5, 10, 20, 40, 60));
}

TEST(NetTuning, TakesTheFewestNodesThatDoAsWell) {
  // A straight line needs no more than the fewest.
  const FittedModel fitted =
      FitOfInNetTuning("net:scg:hidden=cv:output=linear:iterations=200",
                       OneInput(120, [](double x) { return 1.0 + 2.0 * x; }));
  ASSERT_THAT(fitted.choices, SizeIs(1));
  EXPECT_EQ(fitted.choices[0].key, "hidden");
  EXPECT_EQ(fitted.model->num_parameters(),
            3 * std::get<std::int64_t>(fitted.choices[0].value) + 1);
  EXPECT_THAT(fitted.remarks,
              ElementsAre(HasSubstr("hidden nodes by cross-validation over "
                                    "blocks:5: RMSE ")));
  EXPECT_THAT(fitted.remarks[0], HasSubstr("(tried 5: "));
  EXPECT_THAT(fitted.remarks[0], HasSubstr(", 20: "));
}

TEST(NetTuning, TakesMoreNodesWhereTheCurveNeedsThem) {
  const FittedModel fitted = FitOfInNetTuning(
      "net:scg:hidden=cv:scale=standard:output=linear:wfactor=1e-7:"
      "iterations=1500",
      OneInput(300, [](double x) { return std::sin(15.0 * x); }));
  EXPECT_GT(std::get<std::int64_t>(fitted.choices[0].value), 5);
}

TEST(NetTuning, ChoosesNodesAndWfactorTogetherInABoundedNumberOfFits) {
  const data::Dataset dataset = ShippedMeasurements();
  const std::string spec = "net:scg:hidden=cv:wfactor=cv:iterations=40";
  const FittedModel one = FitOfInNetTuning(spec, dataset, {.threads = 1});
  const FittedModel two = FitOfInNetTuning(spec, dataset, {.threads = 2});
  EXPECT_EQ(one.Predict(dataset), two.Predict(dataset));
  EXPECT_EQ(one.remarks, two.remarks);
  ASSERT_THAT(one.choices, SizeIs(3));
  EXPECT_EQ(one.choices[0].key, "hidden");
  EXPECT_EQ(one.choices[1].key, "wfactor");
  EXPECT_EQ(one.choices[2].key, "iterations");
  EXPECT_THAT(one.remarks,
              ElementsAre(HasSubstr("hidden nodes by cross-validation over "
                                    "groups:5 of cycle"),
                          HasSubstr("wfactor"),
                          HasSubstr("(tried 8: ")));
  // What was chosen, given as numbers, is the same map.
  EXPECT_EQ(FitOfInNetTuning("net:scg" + ChoicesAsOptions(one), dataset)
                .Predict(dataset),
            one.Predict(dataset));
}

TEST(NetTuning, TrainsAsLongAsRowsLeftOutGainFromIt) {
  // Without noise every step gains; where there is only noise, none does
  // (Wfactor.ByCrossValidationPrefersMuchOfItWhereThereIsOnlyNoise).
  const FittedModel fitted = FitOfInNetTuning(
      "net:scg:output=linear:iterations=1000:wfactor=cv",
      OneInput(200, [](double x) { return std::sin(15.0 * x); }),
      {.inner_holdout = InnerHoldout::kRows});
  EXPECT_EQ(std::get<std::int64_t>(fitted.choices.back().value), 1000);
  EXPECT_EQ(fitted.summary.iterations, 1000);
}

TEST(NetTuning, TriesNoFewerThanOneIteration) {
  const FittedModel fitted =
      FitOfInNetTuning("net:scg:iterations=1:wfactor=cv", QuadraticData(30));
  EXPECT_THAT(fitted.choices, SizeIs(1));
}

TEST(NetTuning, WalksDownThePathToAWfactor) {
  EXPECT_EQ(WfactorPath().front(), 1.0);
  EXPECT_NEAR(WfactorPath().back(), 1e-7, 1e-20);
  EXPECT_THAT(WfactorPath(), SizeIs(15));
  EXPECT_THAT(WfactorPathTo(3.0), ElementsAre(3.0));
  EXPECT_THAT(WfactorPathTo(0.2),
              ElementsAre(1.0, DoubleNear(0.316, 1e-3), 0.2));
}

TEST(NetTuning, TakesAPathWhereAsked) {
  const data::Dataset dataset = ShippedMeasurements();
  const FittedModel along =
      FitOfInNetTuning("net:scg:hidden=10:wfactor=cv:path=yes", dataset);
  EXPECT_THAT(along.choices, SizeIs(1));
  // All steps count.
  EXPECT_GT(along.summary.iterations, 200);
  EXPECT_LE(along.summary.iterations, 1500);
}

TEST(NetTuning, SaysWhereNothingCouldBeJudged) {
  // All folds but one lack a target that varies.
  data::Dataset::Parts parts;
  parts.source = "flat";
  parts.inputs = {{"position_mm", {}}};
  parts.target = {"error_mm", {}};
  parts.groups.column = "day";
  parts.groups.labels = {"1", "2"};
  parts.groups.codes = {0, 0, 1, 1};
  parts.input_values = Eigen::VectorXd::LinSpaced(4, 0.0, 1.0);
  parts.target_values = Eigen::Vector4d(1.0, 1.0, 2.0, 2.0);
  const data::Dataset flat(std::move(parts));
  for (const std::string key : {"hidden", "wfactor"}) {
    EXPECT_THAT(
        [&] { FitOfInNetTuning("net:scg:" + key + "=cv", flat); },
        Throws<std::invalid_argument>(Property(
            &std::exception::what, HasSubstr(key + "=cv: no inner hold-out"))));
  }
  // A start is taken by its cost then.
  const FittedModel fitted =
      FitOfInNetTuning("net:scg:starts=2:choose=cv", flat);
  EXPECT_THAT(fitted.remarks, ElementsAre(HasSubstr("the lowest cost")));
}

TEST(NetTuning, TakesTheStartThatErrsLeastOnInnerHoldOuts) {
  const data::Dataset dataset = ShippedMeasurements();
  const std::string spec = "net:scg:hidden=6:iterations=60:starts=6";
  const FittedModel by_cost = FitOfInNetTuning(spec + ":choose=cost", dataset);
  const FittedModel by_default = FitOfInNetTuning(spec, dataset);
  const FittedModel by_cv = FitOfInNetTuning(spec + ":choose=cv", dataset);
  EXPECT_EQ(by_cost.Predict(dataset), by_default.Predict(dataset));
  ASSERT_THAT(by_cv.starts, SizeIs(6));
  const StartResult* chosen = nullptr;
  for (const StartResult& start : by_cv.starts) {
    if (start.chosen) {
      EXPECT_EQ(chosen, nullptr);
      chosen = &start;
    }
  }
  ASSERT_NE(chosen, nullptr);
  for (const StartResult& start : by_cv.starts) {
    EXPECT_GE(start.holdout_rmse, chosen->holdout_rmse);
  }
  // Its seed alone gives the same map, and is told.
  const FittedModel again = FitOfInNetTuning(
      "net:scg:hidden=6:iterations=60", dataset, {.seed = chosen->seed});
  EXPECT_EQ(again.Predict(dataset), by_cv.Predict(dataset));
  ASSERT_THAT(by_cv.choices, SizeIs(1));
  EXPECT_EQ(by_cv.choices[0].key, "start_seed");
  EXPECT_EQ(std::get<std::int64_t>(by_cv.choices[0].value),
            static_cast<std::int64_t>(chosen->seed));
  EXPECT_THAT(by_cv.remarks,
              ElementsAre(HasSubstr("by cross-validation over groups:5 of "
                                    "cycle")));
}

TEST(NetTuning, RefusesOptionsThatContradict) {
  for (const auto& [spec, why] :
       std::vector<std::pair<std::string, std::string>>{
           {"net:scg:choose=cv", "give starts=N"},
           {"net:scg:starts=1:choose=cost", "give starts=N"},
           {"net:scg:starts=3:choose=best", "choose must be one of cost, cv"},
           {"net:scg:hidden=cv:discrepancy=1", "number of hidden nodes"},
           {"net:scg:hidden=auto", "hidden must be cv or a whole number"}}) {
    EXPECT_THAT([&] { MakeRecipe(spec); },
                Throws<std::invalid_argument>(
                    Property(&std::exception::what, HasSubstr(why))))
        << spec;
  }
}

TEST(NetTuning, IsTheOptionThatTookEffect) {
  const auto recipe = MakeRecipe("net:scg:hidden=cv:starts=2:choose=cv");
  std::string options;
  for (const EffectiveOption& option : recipe->options()) {
    if (const auto* text = std::get_if<std::string>(&option.value)) {
      options += option.key + "=" + *text + " ";
    }
  }
  EXPECT_THAT(options, HasSubstr("hidden=cv"));
  EXPECT_THAT(options, HasSubstr("choose=cv"));
  // How many weights is not known before the fit.
  EXPECT_EQ(recipe->NumCoefficients(QuadraticData(20)), std::nullopt);
}

TEST(NetTuning, GivesUpWhereARivalIsOutOfReach) {
  const data::Dataset dataset = QuadraticData(120);
  NetDesign design;
  design.hidden = 5;
  NetTrainers trainers;
  trainers.full = MakeNetTrainer(ScgTraining{}, {.iterations = 20});
  const auto tune = [&](double rival) {
    const NetTuning tuning{.wfactor = true, .along_path = true, .rival = rival};
    return TuneNet(design, tuning, trainers, dataset, {});
  };
  const auto tried = [](const TunedNet& net) {
    return std::ranges::count(net.chosen.front().scores, ':');
  };
  const TunedNet alone = tune(std::numeric_limits<double>::infinity());
  EXPECT_GT(tried(alone), 4);
  EXPECT_EQ(tried(tune(1e-3 * alone.rmse)), 3);
  EXPECT_EQ(tune(10.0 * alone.rmse).rmse, alone.rmse);
}

}  // namespace
}  // namespace errmap::models
