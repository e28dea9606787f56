#include "models/net/net_recipe.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/column_header.h"
#include "fitting/interruption.h"
#include "models/model_file.h"
#include "models/model_spec.h"
#include "models/net/feedforward_net.h"
#include "models/recipe_catalog.h"
#include "tests/models/model_test_data.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using errmap::testing::QuadraticData;
using errmap::testing::ShippedMeasurements;
using fitting::Termination;
using ::testing::AllOf;
using ::testing::HasSubstr;

FittedModel FitSpecInNetRecipe(const std::string& spec,
                               const data::Dataset& dataset,
                               const FitContext& context = {}) {
  return MakeRecipe(spec)->Fit(dataset, context);
}

std::string MessageOfInNetRecipe(const std::string& spec) {
  try {
    MakeRecipe(spec);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

// The option that took effect as text, "-" where it is not among them.
std::string OptionOf(const std::string& spec, const std::string& key) {
  for (const EffectiveOption& option : MakeRecipe(spec)->options()) {
    if (option.key != key) continue;
    if (const auto* whole = std::get_if<std::int64_t>(&option.value)) {
      return std::to_string(*whole);
    }
    if (const auto* number = std::get_if<double>(&option.value)) {
      return ::testing::PrintToString(*number);
    }
    return std::get<std::string>(option.value);
  }
  return "-";
}

double TrainingRmse(const FittedModel& fitted, const data::Dataset& dataset) {
  return std::sqrt(
      (fitted.Predict(dataset) - dataset.target_values()).squaredNorm() /
      static_cast<double>(dataset.num_rows()));
}

// error = 1 + 2x over x in 0 .. 1, as one input.
data::Dataset Ramp(Index rows) {
  data::Dataset::Parts parts;
  parts.source = "ramp";
  parts.inputs = {{"position_mm", data::UnitOfColumn("position_mm")}};
  parts.target = {"error_mm", data::UnitOfColumn("error_mm")};
  parts.input_values = VectorXd::LinSpaced(rows, 0.0, 1.0);
  parts.target_values = 1.0 + 2.0 * parts.input_values.col(0).array();
  return data::Dataset(std::move(parts));
}

TEST(NetRecipe, IsMadeOfOptions) {
  const auto recipe =
      MakeRecipe(NetOptions{.method = CgTraining(), .hidden = 3});
  EXPECT_EQ(recipe->name(), "net:cg:hidden=3");
  EXPECT_EQ(recipe->kind(), ModelKind::kNet);
  const data::Dataset dataset = QuadraticData(40);
  EXPECT_EQ(recipe->Fit(dataset, {}).Predict(dataset),
            FitSpecInNetRecipe("net:cg:hidden=3", dataset).Predict(dataset));
}

TEST(NetRecipe, TellsTheOptionsThatTookEffect) {
  EXPECT_EQ(OptionOf("net:scg", "hidden"), "20");
  EXPECT_EQ(OptionOf("net:scg", "iterations"), "1500");
  EXPECT_EQ(OptionOf("net:scg", "variant"), "moller");
  EXPECT_EQ(OptionOf("net:scg", "precision"), "double");
  EXPECT_EQ(OptionOf("net:scg", "output"), "sigmoid");
  EXPECT_EQ(OptionOf("net:scg", "scale"), "standard");
  EXPECT_EQ(OptionOf("net:scg", "slope"), "1");
  // What has no limit is not told as a number.
  for (const char* key : {"evaluations", "seconds", "errdel", "nfreq"}) {
    EXPECT_EQ(OptionOf("net:scg", key), "-") << key;
  }
  // Those of one optimizer are not those of another.
  EXPECT_EQ(OptionOf("net:cg", "variant"), "-");
  EXPECT_EQ(OptionOf("net:backprop", "learning_rate"), "1");
  EXPECT_EQ(OptionOf("net:backprop", "momentum"), "0.9");

  const std::vector<std::pair<std::string, std::string>> given = {
      {"hidden", "7"},
      {"wfactor", "0.5"},
      {"iterations", "12"},
      {"evaluations", "345"},
      {"seconds", "2.5"},
      {"egoal", "0.25"},
      {"gwgoal", "0.125"},
      {"errdel", "0.75"},
      {"nfreq", "9"},
      {"scale", "range"},
      {"output", "linear"},
      {"slope", "2"},
      {"variant", "netcg"},
      {"precision", "single"}};
  std::string spec = "net:scg";
  for (const auto& [key, value] : given) spec += ":" + key + "=" + value;
  EXPECT_EQ(MakeRecipe(spec)->options().size(), given.size());
  for (const auto& [key, value] : given) EXPECT_EQ(OptionOf(spec, key), value);
}

TEST(NetRecipe, RefusesEachOptionOutOfRange) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"hidden=0",
       "hidden must be cv or a whole number from 1 to 10000, found '0'"},
      {"hidden=2.5", "hidden must be cv or a whole number"},
      {"hidden=", "hidden must be cv or a whole number"},
      {"wfactor=-1", "wfactor must be cv or a number from 0 to"},
      {"wfactor=nan", "wfactor must be cv or a number"},
      {"iterations=0", "iterations must be a whole number from 1 to"},
      {"evaluations=0", "evaluations must be a whole number from 1 on"},
      {"seconds=0", "seconds must be a number from 0.001 to"},
      {"seconds=inf", "seconds must be a number"},
      {"egoal=-0.1", "egoal must be a number from 0 to"},
      {"gwgoal=-0.1", "gwgoal must be a number from 0 to"},
      {"errdel=0", "errdel must be a number from"},
      {"nfreq=0", "nfreq must be a whole number from 1 to"},
      {"scale=minmax", "scale must be one of standard, range, none"},
      {"output=tanh", "output must be one of sigmoid, linear, found 'tanh'"},
      {"slope=0", "slope must be a number from 0.001 to 1000, found '0'"},
      {"slope=1e4", "slope must be a number from 0.001 to 1000"},
      {"variant=1995", "variant must be one of moller, netcg, found '1995'"},
      {"precision=half", "precision must be one of double, single"}};
  for (const auto& [option, message] : cases) {
    const std::string spec = "net:scg:" + option;
    EXPECT_THAT(MessageOfInNetRecipe(spec),
                AllOf(HasSubstr(spec), HasSubstr(message)));
  }
  for (const char* option : {"learning_rate=0", "momentum=1", "momentum=-1"}) {
    EXPECT_THAT(MessageOfInNetRecipe(std::string("net:backprop:") + option),
                HasSubstr("must be a number from"));
  }
}

TEST(NetRecipe, RefusesAnOptionItDoesNotHaveAndSaysWhichItHas) {
  EXPECT_THAT(MessageOfInNetRecipe("net:scg:nodes=5"),
              AllOf(HasSubstr("no option 'nodes'"),
                    HasSubstr("hidden"),
                    HasSubstr("variant"),
                    HasSubstr("precision")));
  EXPECT_THAT(MessageOfInNetRecipe("net:cg:variant=netcg"),
              HasSubstr("no option 'variant'"));
  EXPECT_THAT(
      MessageOfInNetRecipe("net:backprop:precision=single"),
      AllOf(HasSubstr("no option 'precision'"), HasSubstr("learning_rate")));
  EXPECT_THAT(MessageOfInNetRecipe("net:scg:hidden=5:hidden=6"),
              HasSubstr("given twice"));
}

TEST(NetRecipe, NeedsAnInputAndCountsItsWeights) {
  const data::Dataset all = QuadraticData(20);
  EXPECT_EQ(MakeRecipe("net:scg:hidden=5")->NumCoefficients(all),
            5 * (3 + 1) + (5 + 1));
  data::Dataset::Parts parts;
  parts.source = "targets";
  parts.input_values.resize(20, 0);
  parts.target = all.target();
  parts.target_values = all.target_values();
  const data::Dataset none(std::move(parts));
  EXPECT_THAT(MakeRecipe("net:scg")->WhatIsMissing(none).value_or(""),
              HasSubstr("inputs"));
  EXPECT_THROW(FitSpecInNetRecipe("net:scg", none), std::invalid_argument);
}

TEST(NetRecipe, EveryOptimizerLearnsTheTrainingRows) {
  const data::Dataset dataset = QuadraticData(60);
  const double spread =
      TrainingRmse(FitSpecInNetRecipe("mean", dataset), dataset);
  const std::vector<std::pair<std::string, double>> shares = {
      {"net:scg:hidden=6", 0.02},
      {"net:scg:hidden=6:variant=netcg", 0.05},
      {"net:scg:hidden=6:precision=single", 0.05},
      {"net:scg:hidden=6:variant=netcg:precision=single", 0.1},
      {"net:scg:hidden=6:output=linear", 0.02},
      {"net:scg:hidden=6:slope=2", 0.02},
      {"net:cg:hidden=6", 0.5},
      {"net:backprop:hidden=6", 0.5}};
  for (const auto& [spec, share] : shares) {
    const FittedModel fitted = FitSpecInNetRecipe(spec, dataset);
    EXPECT_LT(TrainingRmse(fitted, dataset), share * spread) << spec;
    EXPECT_EQ(fitted.name, spec);
    EXPECT_EQ(fitted.inputs.size(), 3U);
  }
}

// Each goal and limit ends a fit for its own reason, and none is convergence.
TEST(NetRecipe, EachStopReachesTheOptimizer) {
  const data::Dataset dataset = QuadraticData(60);
  const auto termination = [&](const std::string& options) {
    const fitting::FitSummary summary =
        FitSpecInNetRecipe("net:scg:hidden=6:" + options, dataset).summary;
    EXPECT_EQ(summary.converged(),
              summary.termination == Termination::kGradient);
    return summary.termination;
  };
  EXPECT_EQ(termination("iterations=5"), Termination::kIterationLimit);
  EXPECT_EQ(termination("evaluations=30"), Termination::kEvaluationLimit);
  EXPECT_EQ(termination("iterations=1000000:gwgoal=0:seconds=0.001"),
            Termination::kTimeLimit);
  EXPECT_EQ(termination("egoal=0.1"), Termination::kCostGoal);
  EXPECT_EQ(termination("gwgoal=0.01"), Termination::kGradient);
  EXPECT_EQ(termination("errdel=0.5:nfreq=3"), Termination::kSlowProgress);
}

// With no decay the cost is half the mean squared scaled residual: only the
// right weights, with the slope in them, give it back in the target's unit.
TEST(NetRecipe, TheSlopeIsInTheWeightsOfTheModel) {
  constexpr double kRounding = 1e-12;
  const data::Dataset dataset = QuadraticData(60);
  for (const std::string slope : {"0.5", "1", "2"}) {
    for (const std::string output : {"sigmoid", "linear"}) {
      const FittedModel fitted = FitSpecInNetRecipe(
          "net:scg:hidden=5:wfactor=0:iterations=50:slope=" + slope +
              ":output=" + output,
          dataset);
      const auto* net = dynamic_cast<const FeedforwardNet*>(fitted.model.get());
      ASSERT_NE(net, nullptr);
      const double scaled_rmse = std::sqrt(2.0 * fitted.summary.final_cost);
      EXPECT_NEAR(TrainingRmse(fitted, dataset) * net->form().target_slope[0],
                  scaled_rmse,
                  kRounding)
          << slope << " " << output;
      // And the model file knows no slope.
      const FittedModel loaded =
          ModelFromJson(ModelToJson(fitted, {}), "saved");
      EXPECT_EQ(loaded.Predict(dataset), fitted.Predict(dataset));
    }
  }
}

TEST(NetRecipe, TheSlopeMattersToTheFit) {
  const data::Dataset dataset = QuadraticData(60);
  EXPECT_NE(
      FitSpecInNetRecipe("net:scg:hidden=5:iterations=20", dataset)
          .Predict(dataset),
      FitSpecInNetRecipe("net:scg:hidden=5:iterations=20:slope=2", dataset)
          .Predict(dataset));
}

TEST(NetRecipe, ALinearOutputExtrapolatesWhereASigmoidSaturates) {
  const data::Dataset ramp = Ramp(41);  // error 1 .. 3
  const Eigen::MatrixXd beyond = Eigen::MatrixXd::Constant(1, 1, 1.5);
  const double truth = 4.0;
  const auto predict = [&](const std::string& output) {
    return FitSpecInNetRecipe(
               "net:scg:hidden=4:iterations=300:output=" + output, ramp)
        .model->Predict(beyond)[0];
  };
  // A sigmoid ends at 1 where the trained range ends at 0.99.
  const double end = 3.0 + 0.01 / 0.98 * 2.0;
  EXPECT_LE(predict("sigmoid"), end);
  EXPECT_GT(predict("linear"), 3.5);
  EXPECT_NEAR(predict("linear"), truth, 0.5);
}

TEST(NetRecipe, FreeBiasesKeepTheMeanWhereDecayIsStrong) {
  const data::Dataset ramp = Ramp(50);  // errors of 1 to 3, mean 2
  for (const std::string decay : {"weights", "all"}) {
    const FittedModel fitted = FitSpecInNetRecipe(
        "net:scg:hidden=4:output=linear:wfactor=1e6:decay=" + decay, ramp);
    const double mean = fitted.Predict(ramp).mean();
    if (decay == "weights") {
      EXPECT_NEAR(mean, 2.0, 1e-6);
    } else {
      EXPECT_LT(mean, 1.1);  // all weights 0: the least error of the ramp
    }
  }
  EXPECT_EQ(OptionOf("net:scg:view=auto", "decay"), "weights");
  EXPECT_EQ(OptionOf("net:scg:view=auto:decay=all", "decay"), "-");
  EXPECT_EQ(OptionOf("net:scg:wfactor=cv", "decay"), "-");
  EXPECT_EQ(OptionOf("net:lm:view=auto", "decay"), "-");
}

TEST(NetRecipe, TheSameSeedGivesTheSameBits) {
  const data::Dataset dataset = QuadraticData(60);
  for (const char* spec : {"net:scg:hidden=5:iterations=40",
                           "net:scg:hidden=5:iterations=40:precision=single",
                           "net:scg:hidden=5:iterations=40:variant=netcg",
                           "net:cg:hidden=5:iterations=40",
                           "net:backprop:hidden=5:iterations=40"}) {
    const auto predict = [&](std::uint64_t seed) {
      return FitSpecInNetRecipe(spec, dataset, {.seed = seed}).Predict(dataset);
    };
    EXPECT_EQ(predict(7), predict(7)) << spec;
    EXPECT_NE(predict(7), predict(8)) << spec;
  }
}

TEST(NetRecipe, FitsInSeveralThreadsGiveTheBitsOfOne) {
  constexpr int kThreads = 4;
  const data::Dataset dataset = ShippedMeasurements();
  const auto recipe = MakeRecipe("net:scg:hidden=10:iterations=60");
  const VectorXd alone = recipe->Fit(dataset, {}).Predict(dataset);
  std::vector<VectorXd> beside(kThreads);
  std::vector<std::thread> threads;
  for (VectorXd& predicted : beside) {
    threads.emplace_back([&recipe, &dataset, &predicted] {
      predicted = recipe->Fit(dataset, {}).Predict(dataset);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const VectorXd& predicted : beside) EXPECT_EQ(predicted, alone);
}

TEST(NetRecipe, SinglePrecisionFitsAsWellAsDouble) {
  // Trajectories part early: what counts is where they get to. That spreads
  // over seeds by 6 %, so the difference of two medians of 11 by 3 %: thrice
  // that, for machines whose last digits differ.
  constexpr double kShare = 0.1;
  constexpr std::uint64_t kSeeds = 11;
  const data::Dataset dataset = ShippedMeasurements();
  const auto median = [&](const std::string& spec) {
    std::vector<double> found;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      found.push_back(TrainingRmse(
          FitSpecInNetRecipe(spec, dataset, {.seed = seed}), dataset));
    }
    std::ranges::sort(found);
    return found[kSeeds / 2];
  };
  const std::string spec = "net:scg:hidden=20:iterations=400";
  const double in_double = median(spec);
  const double in_single = median(spec + ":precision=single");
  EXPECT_NEAR(in_single, in_double, kShare * in_double);
  EXPECT_NE(in_single, in_double);
}

TEST(NetRecipe, AnInterruptedFitGivesAUsableModelMarkedSo) {
  const data::Dataset dataset = ShippedMeasurements();
  for (const char* type : {"net:scg", "net:cg", "net:backprop"}) {
    const std::atomic<bool> stop = true;
    const fitting::InterruptionScope interrupted(&stop);
    const FittedModel fitted = FitSpecInNetRecipe(type, dataset, {});
    EXPECT_EQ(fitted.summary.termination, Termination::kInterrupted) << type;
    EXPECT_FALSE(fitted.summary.converged());
    EXPECT_THAT(fitted.summary.message, HasSubstr("interrupted"));
    EXPECT_TRUE(fitted.Predict(dataset).allFinite());
  }
}

TEST(NetRecipe, AnInterruptKeepsTheBestPointSoFar) {
  constexpr auto kPause = std::chrono::milliseconds(100);
  const data::Dataset dataset = ShippedMeasurements();
  std::atomic<bool> stop = false;
  std::thread interrupter([&] {
    std::this_thread::sleep_for(kPause);
    stop = true;
  });
  const fitting::InterruptionScope interruptible(&stop);
  const FittedModel fitted = FitSpecInNetRecipe(
      "net:scg:hidden=60:iterations=1000000000:gwgoal=0", dataset, {});
  interrupter.join();
  EXPECT_EQ(fitted.summary.termination, Termination::kInterrupted);
  EXPECT_GT(fitted.summary.iterations, 0);
  EXPECT_LT(fitted.summary.final_cost, fitted.summary.initial_cost);
  EXPECT_TRUE(fitted.Predict(dataset).allFinite());
}

TEST(NetRecipe, KeepsATraceWhenAsked) {
  const data::Dataset dataset = QuadraticData(60);
  for (const char* type : {"net:scg", "net:cg", "net:backprop"}) {
    const std::string spec = std::string(type) + ":hidden=4:iterations=25";
    const fitting::FitSummary summary =
        FitSpecInNetRecipe(spec, dataset, {.keep_trace = true}).summary;
    EXPECT_EQ(summary.trace.size(),
              static_cast<std::size_t>(summary.iterations) + 1)
        << spec;
    EXPECT_TRUE(FitSpecInNetRecipe(spec, dataset).summary.trace.empty())
        << spec;
  }
}

TEST(NetRecipe, CountsARowOfWeightTwoAsTwoRows) {
  constexpr double kRounding = 1e-9;  // amplified by the iterations
  const data::Dataset all = QuadraticData(30);
  std::vector<Index> rows;
  data::Dataset::Parts weighted;
  weighted.source = "weighted";
  weighted.inputs = all.inputs();
  weighted.input_values = all.input_values();
  weighted.target = all.target();
  weighted.target_values = all.target_values();
  weighted.weights = VectorXd::Ones(30);
  for (Index i = 0; i < 30; ++i) {
    rows.push_back(i);
    if (i % 3 == 0) {
      weighted.weights[i] = 2.0;
      rows.push_back(i);
    }
  }
  // Inputs as they are: a scaling by mean and sd would tell the two apart.
  const std::string spec = "net:scg:hidden=3:iterations=10:scale=range";
  const VectorXd a =
      FitSpecInNetRecipe(spec, data::Dataset(std::move(weighted))).Predict(all);
  const VectorXd b =
      FitSpecInNetRecipe(spec, all.SelectRows(rows)).Predict(all);
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(),
            kRounding * all.target_values().cwiseAbs().maxCoeff());
}

TEST(NetRecipe, TrainsOnAShareOfManyRows) {
  const data::Dataset dataset = ShippedMeasurements();
  const FittedModel some =
      FitSpecInNetRecipe("net:scg:rows=100:iterations=5:hidden=2", dataset);
  EXPECT_THAT(some.remarks,
              ::testing::Contains(HasSubstr("trained on 100 of 397 rows")));
  ASSERT_THAT(some.choices, ::testing::SizeIs(1));
  EXPECT_EQ(some.choices[0].key, "rows");
  EXPECT_EQ(std::get<std::int64_t>(some.choices[0].value), 100);
  // What it was trained for is the range of all rows.
  const FittedModel all =
      FitSpecInNetRecipe("net:scg:rows=all:iterations=5:hidden=2", dataset);
  EXPECT_THAT(all.remarks, ::testing::IsEmpty());
  for (std::size_t i = 0; i < all.inputs.size(); ++i) {
    EXPECT_EQ(some.inputs[i].min, all.inputs[i].min);
    EXPECT_EQ(some.inputs[i].max, all.inputs[i].max);
  }
  EXPECT_EQ(OptionOf("net:scg:rows=all", "rows"), "all");
  EXPECT_EQ(OptionOf("net:scg", "rows"), "-");
  EXPECT_THAT(MessageOfInNetRecipe("net:scg:rows=7"), HasSubstr("rows"));
}

}  // namespace
}  // namespace errmap::models
