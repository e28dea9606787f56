// blend and the penalised families with views: what they learn, from what, and
// what they leave behind.
#include "models/blend/blend_recipe.h"

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/averaged_model.h"
#include "models/blend/form_to_model.h"
#include "models/model_file.h"
#include "models/polynomial/polynomial_model.h"
#include "models/recipe_catalog.h"
#include "models/shared_work.h"
#include "models/study/judgement/judgement.h"
#include "stats/random.h"
#include "tests/models/history/history_data.h"
#include "tests/models/study/study_test_tools.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using errmap::testing::ColumnNamed;
using errmap::testing::WithLog;
using ::testing::HasSubstr;

// Six days of a body that follows the sensor with 600 s: the error is of that
// body, less its value at the start of the day, and a day begins where it
// likes.
data::Dataset LaggingDays(double noise, Index days = 6) {
  constexpr Index kRows = 60;
  constexpr double kStep = 60.0;
  constexpr double kLag = 600.0;
  stats::Random random(5);
  MatrixXd values(kRows * days, 2);
  VectorXd time(kRows * days);
  VectorXd error(kRows * days);
  std::vector<Index> codes;
  for (Index day = 0; day < days; ++day) {
    const double start = 20.0 + 4.0 * random.Uniform();
    const double heat = 4.0 + 6.0 * random.Uniform();
    double body = start;
    for (Index i = 0; i < kRows; ++i) {
      const Index row = day * kRows + i;
      const double k = static_cast<double>(i);
      const double sensor = start + heat * (1.0 - std::exp(-k / 12.0)) +
                            1.5 * std::sin(0.2 * k) * (k > 0.0 ? 1.0 : 0.0);
      if (i > 0) body += (1.0 - std::exp(-kStep / kLag)) * (sensor - body);
      values.row(row) << sensor, 20.0 + random.Uniform();
      time[row] = kStep * k;
      error[row] = 3.0 * (body - start) + noise * (random.Uniform() - 0.5);
      codes.push_back(day);
    }
    error[day * kRows] = 0.0;
  }
  data::Dataset made = WithLog(
      {ColumnNamed("t1_degC"), ColumnNamed("t2_degC")}, values, time, codes);
  return testing::WithTargets(made, error);
}

struct Days {
  data::Dataset first;
  data::Dataset last;
};

Days Split(const data::Dataset& all, Index days) {
  std::vector<Index> first;
  std::vector<Index> last;
  const std::vector<Index> codes = all.session_codes();
  for (Index row = 0; row < all.num_rows(); ++row) {
    (codes[static_cast<std::size_t>(row)] < days ? first : last).push_back(row);
  }
  return {all.SelectRows(first), all.SelectRows(last)};
}

double RmseOn(const FittedModel& fitted, const data::Dataset& rows) {
  const VectorXd residual = rows.target_values() - fitted.Predict(rows);
  return std::sqrt(residual.squaredNorm() /
                   static_cast<double>(residual.size()));
}

FittedModel Fitted(const std::string& spec, const data::Dataset& training) {
  return MakeRecipe(spec)->Fit(training, {.indifference = 0.02});
}

TEST(BlendRecipe, MapsWithAMemoryAndAZeroHoldOnADayTheyNeverSaw) {
  const auto [first, last] = Split(LaggingDays(0.2), 4);
  const double raw = RmseOn(Fitted("poly:ridge:view=raw", first), last);
  for (const char* spec :
       {"poly:ridge:view=auto", "poly:lasso:view=auto", "blend"}) {
    const double found = RmseOn(Fitted(spec, first), last);
    EXPECT_LT(found, 0.5 * raw) << spec;
  }
}

TEST(BlendRecipe, OneEquationForTheMembersOfOneBasisAndWeightsOfSumOne) {
  const FittedModel fitted = Fitted("blend", Split(LaggingDays(0.2), 4).first);
  const auto form = std::get<BlendForm>(fitted.model->Describe());
  double sum = 0.0;
  std::size_t polynomials = 0;
  for (const BlendForm::Member& member : form.members) {
    sum += member.weight;
    polynomials += std::holds_alternative<PolynomialForm>(member.form) ? 1 : 0;
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  // Three views, of two or four inputs: linear, squares and full at most.
  EXPECT_LE(polynomials, 9U);
  EXPECT_NE(fitted.history, nullptr);
  EXPECT_TRUE(fitted.guards.has_value());
}

// The weight of straight lines in a blend of maps of the sensor as it is, which
// the error follows to this power.
double ShareOfLines(double power) {
  const data::Dataset days = LaggingDays(0.0, 4);
  stats::Random random(11);
  const VectorXd targets =
      (0.1 * (days.input_values().col(0).array() - 20.0))
          .pow(power)
          .unaryExpr([&](double error) { return error + random.Uniform(); });
  const FittedModel fitted =
      Fitted("blend:view=raw", testing::WithTargets(days, targets));
  double share = 0.0;
  const auto form = std::get<BlendForm>(fitted.model->Describe());
  for (const BlendForm::Member& member : form.members) {
    if (member.name.starts_with("lines from ")) share += member.weight;
  }
  return share;
}

TEST(BlendRecipe, LinesHaveHalfOfItUnlessABendErrsLess) {
  EXPECT_GT(ShareOfLines(1.0), 0.6);
  EXPECT_LT(ShareOfLines(6.0), 0.1);
}

TEST(BlendRecipe, TheMoreDaysItIsFittedToTheMoreTheirErrorsDecide) {
  for (const auto& [days, rule] : std::vector<std::pair<Index, std::string>>{
           {3, "error^-3"}, {4, "error^-3"}, {6, "error^-5"}}) {
    const FittedModel fitted = MakeRecipe("blend")->Fit(
        LaggingDays(0.2, days),
        {.inner_holdout = InnerHoldout::kWholeSessions});
    EXPECT_THAT(fitted.summary.message, HasSubstr(rule));
  }
}

TEST(BlendRecipe, EveryChoiceOfMembersIsAsGoodAsItsPartsAlone) {
  const auto [first, last] = Split(LaggingDays(1.0), 4);
  const double mean = RmseOn(Fitted("mean", first), last);
  for (const char* spec : {"blend", "blend:net=yes"}) {
    EXPECT_LT(RmseOn(Fitted(spec, first), last), 0.3 * mean) << spec;
  }
}

TEST(BlendRecipe, ReadBackFromItsFileItPredictsTheSameBits) {
  const auto [first, last] = Split(LaggingDays(0.2), 4);
  for (const char* spec : {"blend",
                           "net:scg:view=history:hidden=3:iterations=20:"
                           "members=2"}) {
    const FittedModel fitted = Fitted(spec, first);
    const FittedModel read =
        ModelFromJson(ModelToJson(fitted, {}), "model.json");
    EXPECT_EQ(fitted.Predict(last), read.Predict(last)) << spec;
    EXPECT_EQ(read.kind, fitted.kind);
  }
}

TEST(BlendRecipe, WhatIsSharedIsWhatEachWouldHaveMadeAlone) {
  const auto [first, last] = Split(LaggingDays(0.2), 4);
  SharedWork shared;
  FitContext together{.indifference = 0.02, .shared = &shared};
  for (const char* spec : {"poly:lasso:view=auto",
                           "poly:ridge:view=auto",
                           "blend:net=yes",
                           "net:scg:view=auto"}) {
    EXPECT_EQ(MakeRecipe(spec)->Fit(first, together).Predict(last),
              Fitted(spec, first).Predict(last))
        << spec;
  }
}

TEST(BlendRecipe, ItsNetIsFittedOnceForItselfAndForTheBlend) {
  const auto [first, last] = Split(LaggingDays(0.2), 4);
  SharedWork shared;
  FitContext together{.indifference = 0.02, .shared = &shared};
  MakeRecipe("blend:net=yes")->Fit(first, together);
  const auto net = shared.Get<FittedModel>(
      "net:scg:view=auto", [&]() -> std::shared_ptr<const FittedModel> {
        ADD_FAILURE() << "the blend left none";
        return std::make_shared<const FittedModel>();
      });
  // Whoever wants its error-reduction curve has it, and nobody else.
  const auto trace = [&] {
    return MakeRecipe("net:scg:view=auto")
        ->Fit(first, together)
        .summary.trace.size();
  };
  EXPECT_EQ(trace(), 0U);
  together.keep_trace = true;
  EXPECT_EQ(trace(), net->summary.trace.size());
  EXPECT_GT(trace(), 0U);
}

TEST(BlendRecipe, ALaterColumnThatHardlyMovedInTrainingDoesNotExplode) {
  const data::Dataset days = LaggingDays(0.2);
  // The second sensor hardly moves on the first days and by 30 K later.
  data::Dataset::Parts parts{.source = "days",
                             .inputs = days.inputs(),
                             .input_values = days.input_values(),
                             .target = days.target(),
                             .target_values = days.target_values(),
                             .groups = {},
                             .weights = {},
                             .rows = {},
                             .log = {},
                             .log_rows = days.log_rows()};
  auto log = std::make_shared<data::SessionLog>(*days.log());
  stats::Random random(3);
  for (Index row = 0; row < days.num_rows(); ++row) {
    const double value = log->sessions.codes[static_cast<std::size_t>(row)] < 2
                             ? 20.0 + 1e-6 * random.Uniform()
                             : 50.0;
    parts.input_values(row, 1) = value;
    log->input_values(row, 1) = value;
  }
  parts.log = std::move(log);
  const auto [first, last] = Split(data::Dataset(std::move(parts)), 2);
  const double mean = RmseOn(Fitted("mean", first), last);
  for (const char* spec :
       {"poly:ridge:view=auto", "poly:lasso:view=auto", "blend"}) {
    EXPECT_LT(RmseOn(Fitted(spec, first), last), 2.0 * mean) << spec;
  }
}

TEST(BlendRecipe, IsRecommendedWhereDaysAreTooFewToTellMapsApart) {
  const data::Dataset days = Split(LaggingDays(2.0), 4).first;
  const auto holdouts =
      errmap::testing::MakeHoldouts(days, {"every:3", "sessions:4"});
  const auto recipes = errmap::testing::MakeRecipes(
      {"mean", "poly:ridge:view=auto", "poly:lasso:view=auto", "blend"});
  const StudyResult study = RunStudy(days, holdouts, recipes, {});
  const Judgement judgement =
      JudgeStudy(days, holdouts, study, {.indifference = 0.02});
  ASSERT_TRUE(judgement.recommendation.has_value());
  EXPECT_EQ(judgement.recommendation->holdout, 1U);
  EXPECT_EQ(study.models[judgement.recommendation->model].name, "blend");
  const auto single = judgement.recommendation->single;
  ASSERT_TRUE(single.has_value());
  EXPECT_NE(study.models[*single].name, "blend");
}

TEST(BlendRecipe, RefusesWhatItDoesNotKnow) {
  EXPECT_THROW(MakeRecipe("blend:rule=stack"), std::invalid_argument);
  EXPECT_THROW(MakeRecipe("blend:net=maybe"), std::invalid_argument);
  EXPECT_THROW(MakeRecipe("blend:hidden=3"), std::invalid_argument);
  EXPECT_THROW(MakeRecipe("poly:ridge:view=auto:penalty=1"),
               std::invalid_argument);
}

TEST(AveragedModel, OfItsOwnDescriptionPredictsTheSameBits) {
  stats::Random random(5);
  for (int members = 1; members <= 20; ++members) {
    std::vector<AveragedMember> averaged;
    for (int i = 0; i < members; ++i) {
      averaged.push_back({.name = "mean",
                          .weight = 0.001 + random.Uniform(),
                          .inputs = {},
                          .lowest = -10.0,
                          .highest = 10.0,
                          .model = std::make_shared<PolynomialModel>(
                              PolynomialForm{.input_offset = {},
                                             .input_scale = {},
                                             .intercept = random.Uniform(),
                                             .terms = {}},
                              1)});
    }
    const AveragedModel model(0, "equal", std::move(averaged));
    const auto again = ModelOfForm(model.Describe(), members);
    EXPECT_EQ(again->PredictRow({}), model.PredictRow({})) << members;
  }
}

}  // namespace
}  // namespace errmap::models
