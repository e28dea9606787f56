// poly:stepwise, poly:best, poly:ridge, poly:lasso and poly:formula as recipes.
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/column_header.h"
#include "fitting/least_squares/regression_diagnostics.h"
#include "models/polynomial/polynomial_basis.h"
#include "models/polynomial/polynomial_model.h"
#include "models/polynomial/polynomial_options.h"
#include "models/polynomial/term_set.h"
#include "models/recipe_catalog.h"
#include "models/regression_record.h"
#include "models/shared_work.h"
#include "tests/fitting/regression_test_data.h"
#include "tests/models/model_test_data.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using errmap::testing::QuadraticData;
using errmap::testing::ShippedMeasurements;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

constexpr FitContext kExplain{.explain = true};

std::string RefusalOfInSelectionRecipe(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

std::string RefusalOfSpec(const std::string& spec) {
  return RefusalOfInSelectionRecipe([&] { MakeRecipe(spec); });
}

// Rows of six inputs in 12 groups, with weights where asked for.
data::Dataset ManyRows(bool weighted, Index rows = 2000) {
  data::Dataset::Parts parts;
  parts.source = "many";
  for (const char* name :
       {"position_mm", "t1_degC", "t2_degC", "t3_degC", "t4_degC", "t5_degC"}) {
    parts.inputs.push_back({name, data::UnitOfColumn(name)});
  }
  parts.input_values = errmap::testing::UniformMatrix(rows, 6, 1);
  parts.input_values.col(0) *= 200.0;
  for (Index j = 1; j < 6; ++j) parts.input_values.col(j).array() += 22.0;
  parts.target = {"error_mm", data::UnitOfColumn("error_mm")};
  const auto& x = parts.input_values;
  parts.target_values =
      1e-4 * x.col(0).array() + 2e-3 * x.col(1).array() +
      1e-5 * x.col(0).array() * x.col(3).array() +
      1e-3 * x.col(2).array().square() +
      1e-3 * errmap::testing::UniformMatrix(rows, 1, 2).array();
  if (weighted) {
    parts.weights = 1.5 + errmap::testing::UniformMatrix(rows, 1, 3).array();
  }
  parts.groups.column = "cycle";
  for (int group = 0; group < 12; ++group) {
    parts.groups.labels.push_back(std::to_string(group));
  }
  for (Index i = 0; i < rows; ++i) parts.groups.codes.push_back(i % 12);
  return data::Dataset(std::move(parts));
}

// 60 rows of 100 sensors and a target, all of them noise.
data::Dataset Noise() {
  constexpr Index kRows = 60;
  constexpr Index kSensors = 100;
  data::Dataset::Parts parts;
  parts.source = "noise";
  for (Index j = 0; j < kSensors; ++j) {
    const std::string name = "t" + std::to_string(j) + "_degC";
    parts.inputs.push_back({name, data::UnitOfColumn(name)});
  }
  parts.input_values = errmap::testing::UniformMatrix(kRows, kSensors, 60);
  parts.target = {"error_mm", data::UnitOfColumn("error_mm")};
  parts.target_values = errmap::testing::UniformMatrix(kRows, 1, 61);
  return data::Dataset(std::move(parts));
}

const LeastSquaresRecord& LeastSquaresOf(const FittedModel& fitted) {
  return *fitted.regression->least_squares.value;
}

// Of the terms, without the intercept.
std::vector<double> InclusionsOf(const FittedModel& fitted) {
  std::vector<double> shares;
  for (const CoefficientRecord& line : fitted.regression->coefficients) {
    if (const auto& term = line.of_term.value) {
      shares.push_back(term->bootstrap_inclusion);
    }
  }
  return shares;
}

TEST(SelectionRecipe, TakesNoMoreTermsThanAFifthOfTheRows) {
  const data::Dataset noise = Noise();
  const auto fit = [&](const std::string& options) {
    return MakeRecipe("poly:stepwise:degree=1" + options)->Fit(noise, {});
  };
  const auto size = [](const FittedModel& fitted) {
    return std::get<PolynomialForm>(fitted.model->Describe()).terms.size();
  };
  const FittedModel fifth = fit("");
  EXPECT_EQ(size(fifth), 12U);
  EXPECT_THAT(fifth.remarks,
              Contains("max_terms ends the selection at 12 terms, a fifth of "
                       "60 rows; max_terms=none continues like R's step()"));
  EXPECT_THAT(fifth.remarks, Not(Contains(HasSubstr("to estimate the error"))));
  // What the limit is there for: as many terms as degrees of freedom.
  const FittedModel all = fit(":max_terms=none");
  EXPECT_EQ(size(all), 58U);
  EXPECT_THAT(all.remarks,
              Contains("59 coefficients leave only 1 of 60 rows to estimate "
                       "the error: the fit says little about other rows"));
  EXPECT_THAT(fit(":max_terms=3").remarks,
              Contains(HasSubstr("at 3 terms; a larger one")));
  // Where it does not bind nothing is said, nor is anything else chosen.
  const data::Dataset shipped = ShippedMeasurements();
  const FittedModel free =
      MakeRecipe("poly:stepwise:degree=4:max_terms=none")->Fit(shipped, {});
  const FittedModel bound =
      MakeRecipe("poly:stepwise:degree=4")->Fit(shipped, {});
  EXPECT_EQ(free.remarks, bound.remarks);
  EXPECT_THAT(bound.remarks, Not(Contains(HasSubstr("max_terms"))));
  EXPECT_THAT(RefusalOfSpec("poly:stepwise:max_terms=few"),
              HasSubstr("max_terms"));
}

// t1 tells the error in one cycle of three and nothing in the others: a
// bootstrap of whole cycles misses it in (2/3)^3 = 30 % of the draws, one of
// rows never.
TEST(SelectionRecipe, BootstrapOfTermsDrawsWholeCycles) {
  constexpr Index kRows = 90;
  data::Dataset::Parts parts;
  parts.source = "cycles";
  parts.inputs = {{"t1_degC", data::UnitOfColumn("t1_degC")}};
  parts.input_values = errmap::testing::UniformMatrix(kRows, 1, 7);
  parts.target = {"error_mm", data::UnitOfColumn("error_mm")};
  parts.target_values = 1e-3 * errmap::testing::UniformMatrix(kRows, 1, 8);
  parts.groups = {"cycle", {"1", "2", "3"}, {}};
  for (Index i = 0; i < kRows; ++i) {
    parts.groups.codes.push_back(i / 30);
    if (i >= 30) {
      parts.input_values(i, 0) = 0.5;
    } else {
      parts.target_values[i] += parts.input_values(i, 0);
    }
  }
  const FittedModel fitted =
      MakeRecipe("poly:stepwise:degree=1:bootstrap=200")
          ->Fit(data::Dataset(std::move(parts)), kExplain);
  ASSERT_EQ(fitted.regression->coefficients.size(), 2U);
  EXPECT_EQ(LeastSquaresOf(fitted).bootstrap.unit, "cycle");
  EXPECT_NEAR(InclusionsOf(fitted)[0], 0.70, 0.12);
}

TEST(SelectionRecipe, ChoosesAmongTheTermsOfEverySet) {
  const data::Dataset dataset = QuadraticData(120);
  for (const TermSet set :
       {TermSet::kLinear, TermSet::kSquares, TermSet::kAxis, TermSet::kFull}) {
    const std::string terms = ":degree=2:terms=" + std::string(ToString(set));
    const Index count = *CountTerms(set, {true, false, false}, 2);
    for (const char* family : {"poly:stepwise", "poly:best"}) {
      SCOPED_TRACE(family + terms);
      const FittedModel fitted =
          MakeRecipe(family + terms)->Fit(dataset, kExplain);
      const LeastSquaresRecord& fit = LeastSquaresOf(fitted);
      EXPECT_EQ(fitted.regression->candidates, count);
      EXPECT_EQ(std::ssize(InclusionsOf(fitted)) + std::ssize(fit.excluded) +
                    std::ssize(fit.aliased),
                count);
    }
  }
}

TEST(SelectionRecipe, SaysWhatLimitsTheTerms) {
  const auto option = [](const std::string& spec) {
    for (const EffectiveOption& one : MakeRecipe(spec)->options()) {
      if (one.key == "max_terms") return one.value;
    }
    return decltype(EffectiveOption::value)();
  };
  using Value = decltype(EffectiveOption::value);
  EXPECT_EQ(option("poly:stepwise"), Value(std::string("rows/5")));
  EXPECT_EQ(option("poly:stepwise:max_terms=none"), Value(std::string("none")));
  EXPECT_EQ(option("poly:stepwise:max_terms=7"), Value(std::int64_t{7}));
}

TEST(SelectionRecipe, TrianglesGiveWhatTheRowsGive) {
  constexpr double kRelative = 1e-9;
  for (const bool weighted : {false, true}) {
    const data::Dataset dataset = ManyRows(weighted);
    for (const char* spec : {"poly:stepwise:degree=2",
                             "poly:stepwise:degree=3:criterion=aic:max_terms=9",
                             "poly:stepwise:degree=2:criterion=cv",
                             "poly:best:degree=2:exclude=t5_degC^2",
                             "poly:full:degree=2",
                             "poly:ridge:degree=2",
                             "poly:lasso:degree=2",
                             "poly:formula=position_mm*t3_degC+t2_degC^2"}) {
      SCOPED_TRACE(spec);
      FitContext reduced = kExplain;
      reduced.most_design_values = 1000.0;
      reduced.threads = 2;
      const auto recipe = MakeRecipe(spec);
      const FittedModel rows = recipe->Fit(dataset, kExplain);
      const FittedModel triangles = recipe->Fit(dataset, reduced);
      ASSERT_EQ(rows.inputs.size(), triangles.inputs.size());
      const auto form = [](const FittedModel& fitted) {
        return std::get<PolynomialForm>(fitted.model->Describe());
      };
      const PolynomialForm by_rows = form(rows);
      const PolynomialForm by_triangles = form(triangles);
      ASSERT_EQ(by_rows.terms.size(), by_triangles.terms.size());
      double largest = 0.0;
      for (const PolynomialTerm& term : by_rows.terms) {
        largest = std::max(largest, std::abs(term.coefficient));
      }
      for (std::size_t i = 0; i < by_rows.terms.size(); ++i) {
        EXPECT_EQ(by_rows.terms[i].powers, by_triangles.terms[i].powers);
        EXPECT_NEAR(by_rows.terms[i].coefficient,
                    by_triangles.terms[i].coefficient,
                    kRelative * largest);
      }
      if (rows.regression->penalised.value) continue;
      const LeastSquaresRecord& of_rows = LeastSquaresOf(rows);
      const LeastSquaresRecord& of_triangles = LeastSquaresOf(triangles);
      EXPECT_NEAR(of_rows.s, of_triangles.s, kRelative * of_rows.s);
      EXPECT_NEAR(of_rows.press, of_triangles.press, kRelative * of_rows.press);
    }
  }
}

TEST(SelectionRecipe, TrianglesAreMadeOnceForAllThatShareTheWorkOfTheRows) {
  FitContext alone;
  alone.most_design_values = 1000.0;
  const auto predicted = [&](const std::string& spec,
                             const data::Dataset& dataset,
                             SharedWork* shared) {
    FitContext context = alone;
    context.shared = shared;
    return MakeRecipe(spec)->Fit(dataset, context).Predict(ManyRows(false));
  };
  const data::Dataset dataset = ManyRows(true);
  SharedWork shared;
  for (const std::string spec : {"poly:full:degree=2",
                                 "poly:stepwise:degree=2",
                                 "poly:stepwise:degree=2:centred=no",
                                 "poly:full:degree=1",
                                 "poly:best:degree=1",
                                 "poly:stepwise:degree=2:criterion=cv"}) {
    EXPECT_EQ(predicted(spec, dataset, &shared),
              predicted(spec, dataset, nullptr))
        << spec;
  }
  // Rows that are not the same betray who made the triangle.
  EXPECT_EQ(predicted("poly:full:degree=1", ManyRows(false), &shared),
            predicted("poly:full:degree=1", dataset, nullptr));
}

TEST(SelectionRecipe, BootstrapOverGroupTrianglesIsThatOverTheirRows) {
  const data::Dataset dataset = ManyRows(false);
  const auto recipe = MakeRecipe("poly:stepwise:degree=2:bootstrap=20");
  FitContext reduced = kExplain;
  reduced.most_design_values = 1000.0;
  const FittedModel rows = recipe->Fit(dataset, kExplain);
  const FittedModel triangles = recipe->Fit(dataset, reduced);
  EXPECT_EQ(LeastSquaresOf(rows).bootstrap.unit, "cycle");
  EXPECT_EQ(InclusionsOf(rows), InclusionsOf(triangles));
}

TEST(SelectionRecipe, BootstrapsManyRowsOnlyWhereAsked) {
  // Nine terms: just above a million values.
  const auto report_of = [](const std::string& options, Eigen::Index rows) {
    return LeastSquaresOf(
        MakeRecipe("poly:stepwise:degree=2:max_terms=2" + options)
            ->Fit(QuadraticData(rows), kExplain));
  };
  const LeastSquaresRecord many = report_of("", 111'112);
  EXPECT_EQ(many.bootstrap.repetitions, 0);
  EXPECT_THAT(many.notes, Contains(HasSubstr("no bootstrap at this size")));
  EXPECT_EQ(report_of(":bootstrap=2", 111'112).bootstrap.repetitions, 2);
  EXPECT_THAT(report_of(":bootstrap=0", 111'112).notes,
              Not(Contains(HasSubstr("no bootstrap"))));
}

// Bootstraps and PRESS need the rows; without them one triangle is quicker.
TEST(SelectionRecipe, TermsOfMoreValuesThanCachesHoldAreChosenFromATriangle) {
  constexpr double kRelative = 1e-9;
  constexpr Index kRows = 37'100;  // of 27 terms: just above a million values
  for (const bool weighted : {false, true}) {
    const data::Dataset dataset = ManyRows(weighted, kRows);
    const auto report_of = [&](const std::string& options) {
      return *MakeRecipe("poly:stepwise:degree=2" + options)
                  ->Fit(dataset, kExplain)
                  .regression;
    };
    const RegressionRecord by_triangle = report_of("");
    const RegressionRecord by_rows = report_of(":bootstrap=1");
    EXPECT_EQ(by_triangle.ended, by_rows.ended);
    EXPECT_EQ(by_triangle.chosen_step, by_rows.chosen_step);
    ASSERT_EQ(by_triangle.steps.size(), by_rows.steps.size());
    for (std::size_t i = 0; i < by_rows.steps.size(); ++i) {
      EXPECT_EQ(by_triangle.steps[i].term, by_rows.steps[i].term);
    }
    const auto& of_triangle = by_triangle.least_squares.value->excluded;
    const auto& of_rows = by_rows.least_squares.value->excluded;
    ASSERT_EQ(of_triangle.size(), of_rows.size());
    for (std::size_t i = 0; i < of_rows.size(); ++i) {
      EXPECT_EQ(of_triangle[i].term, of_rows[i].term);
      EXPECT_NEAR(of_triangle[i].f, of_rows[i].f, kRelative);
    }
    EXPECT_NE(of_triangle.front().f, of_rows.front().f)
        << "the roundings of two ways";
    EXPECT_FALSE(report_of(":criterion=press").steps.empty());
  }
}

// More values than are asked for further digits: by a triangle, unless terms
// depend on each other.
TEST(SelectionRecipe, FitsOfMoreValuesThanAreRefinedKeepTheirDigits) {
  constexpr Index kRows = 74'100;  // of 27 terms: just above two millions
  constexpr double kRelative = 1e-11;
  const data::Dataset dataset = ManyRows(false, kRows);
  FitContext reduced = kExplain;
  reduced.most_design_values = 1000.0;
  const auto recipe = MakeRecipe("poly:full:degree=2");
  const FittedModel fitted = recipe->Fit(dataset, kExplain);
  EXPECT_EQ(fitted.Predict(dataset),
            recipe->Fit(dataset, reduced).Predict(dataset));
  const auto form = std::get<PolynomialForm>(fitted.model->Describe());
  Eigen::MatrixXd scaled = dataset.input_values();
  for (Index j = 0; j < scaled.cols(); ++j) {
    scaled.col(j) =
        (scaled.col(j).array() - form.input_offset[j]) * form.input_scale[j];
  }
  std::vector<TermPowers> powers;
  for (const PolynomialTerm& term : form.terms) powers.push_back(term.powers);
  const Eigen::MatrixXd terms = TermMatrix(scaled, powers);
  const Eigen::VectorXd equal;
  const fitting::LeastSquaresFit expected =
      fitting::SolveRegression({terms, dataset.target_values(), equal});
  const double largest = expected.coefficients.cwiseAbs().maxCoeff();
  EXPECT_NEAR(form.intercept, expected.coefficients[0], kRelative * largest);
  for (std::size_t i = 0; i < form.terms.size(); ++i) {
    EXPECT_NEAR(form.terms[i].coefficient,
                expected.coefficients[static_cast<Index>(i) + 1],
                kRelative * largest);
  }
}

TEST(SelectionRecipe, RefusesPressWhereTheRowsAreNotHeld) {
  FitContext reduced;
  reduced.most_design_values = 1000.0;
  const data::Dataset dataset = ManyRows(false);
  EXPECT_THAT(
      RefusalOfInSelectionRecipe([&] {
        MakeRecipe("poly:stepwise:criterion=press")->Fit(dataset, reduced);
      }),
      HasSubstr("PRESS of every step needs the rows"));
}

TEST(SelectionRecipe, ReportReproducesTheMap) {
  const data::Dataset dataset = ShippedMeasurements();
  const FittedModel fitted =
      MakeRecipe("poly:stepwise:degree=4")->Fit(dataset, kExplain);
  const RegressionRecord& report = *fitted.regression;
  const LeastSquaresRecord& fit = LeastSquaresOf(fitted);
  EXPECT_EQ(report.coefficients.size(),
            static_cast<std::size_t>(fitted.model->num_parameters()));
  EXPECT_EQ(fit.bootstrap.repetitions, 200);
  EXPECT_EQ(fit.bootstrap.unit, "cycle");
  EXPECT_EQ(report.coefficients.size() + fit.excluded.size(), 15U);
  for (const double inclusion : InclusionsOf(fitted)) {
    EXPECT_GE(inclusion, 0.0);
    EXPECT_LE(inclusion, 1.0);
  }
  // Table and centres alone give the first row's prediction.
  ASSERT_EQ(report.centres.size(), 2U);
  double sum = 0.0;
  const double x = dataset.input_values()(0, 0) - report.centres[0].second;
  const double c = dataset.input_values()(0, 1) - report.centres[1].second;
  for (const CoefficientRecord& term : report.coefficients) {
    double value = term.estimate;
    for (int i = 0; i <= 4; ++i) {
      for (int j = 0; i + j <= 4; ++j) {
        if (i + j > 0 &&
            TermName({i, j}, {"position_mm", "elapsed_cycles"}) == term.term) {
          value *= std::pow(x, i) * std::pow(c, j);
        }
      }
    }
    sum += value;
  }
  EXPECT_NEAR(sum, fitted.Predict(dataset)[0], 1e-15);
}

TEST(SelectionRecipe, SameSeedAndAnyThreadsGiveTheSameReport) {
  const data::Dataset dataset = ShippedMeasurements();
  const auto recipe = MakeRecipe("poly:stepwise:degree=4:bootstrap=40");
  const auto inclusion = [&](std::uint64_t seed, int threads) {
    FitContext context = kExplain;
    context.seed = seed;
    context.threads = threads;
    return InclusionsOf(recipe->Fit(dataset, context));
  };
  EXPECT_EQ(inclusion(1, 1), inclusion(1, 2));
  EXPECT_NE(inclusion(1, 1), inclusion(2, 1));
}

TEST(SelectionRecipe, BestSubsetIsNotWorseThanStepwise) {
  const data::Dataset dataset = ShippedMeasurements();
  const auto bic = [&](const std::string& spec) {
    const auto fitted = MakeRecipe(spec)->Fit(dataset, kExplain);
    return fitting::Bic(LeastSquaresOf(fitted).anova.residual_ss,
                        397.0,
                        static_cast<double>(fitted.model->num_parameters()));
  };
  EXPECT_LE(bic("poly:best:degree=4"), bic("poly:stepwise:degree=4"));
  EXPECT_THAT(RefusalOfInSelectionRecipe([&] {
                MakeRecipe("poly:best:degree=4")->Fit(ManyRows(false), {});
              }),
              HasSubstr("best subset is practical up to about 40 candidate "
                        "terms, and degree 4 in 6 inputs makes 209"));
}

TEST(SelectionRecipe, FormulaMeansProductsOfTheInputsAsTheyAre) {
  // Without the main effects a product of moved inputs is another map.
  const data::Dataset dataset = QuadraticData(60);
  const FittedModel fitted =
      MakeRecipe("poly:formula=position_mm*t1_degC")->Fit(dataset, kExplain);
  const auto form = std::get<PolynomialForm>(fitted.model->Describe());
  EXPECT_TRUE(form.input_offset.isZero());
  EXPECT_EQ(ExpandToPhysicalUnits(form).size(), 2U);
  // With them it is the same map, and centring keeps the digits.
  const FittedModel closed =
      MakeRecipe("poly:formula=position_mm+t1_degC+position_mm*t1_degC")
          ->Fit(dataset, kExplain);
  EXPECT_FALSE(
      std::get<PolynomialForm>(closed.model->Describe()).input_offset.isZero());
  const FittedModel plain =
      MakeRecipe(
          "poly:formula=position_mm+t1_degC+position_mm*t1_degC:"
          "centred=no")
          ->Fit(dataset, kExplain);
  EXPECT_TRUE(closed.Predict(dataset).isApprox(plain.Predict(dataset), 1e-9));
}

TEST(SelectionRecipe, RidgeAndLassoShrinkAndStayNearTheData) {
  const data::Dataset dataset = ShippedMeasurements();
  for (const char* spec : {"poly:ridge", "poly:lasso", "poly:lasso:rule=1se"}) {
    const FittedModel fitted = MakeRecipe(spec)->Fit(dataset, kExplain);
    ASSERT_TRUE(fitted.regression->penalised.value);
    EXPECT_EQ(fitted.regression->penalised.value->cross_validation.holdout,
              "groups:5 of cycle");
    EXPECT_LT((fitted.Predict(dataset) - dataset.target_values()).norm(),
              0.5 * dataset.target_values().norm());
  }
  const FittedModel nothing =
      MakeRecipe("poly:lasso:penalty=1e9")->Fit(dataset, {});
  EXPECT_EQ(nothing.model->num_parameters(), 1);
  EXPECT_NEAR(
      nothing.Predict(dataset)[0], dataset.target_values().mean(), 1e-15);
}

TEST(SelectionRecipe, RefusesBadOptionsInOneLine) {
  EXPECT_THAT(RefusalOfSpec("poly:stepwise:degree=0"),
              HasSubstr("degree must be a whole number from 1 to 4"));
  EXPECT_THAT(RefusalOfSpec("poly:stepwise:criterion=p:enter=1.5"),
              HasSubstr("enter must be a number from 0 to 1"));
  EXPECT_THAT(RefusalOfSpec("poly:stepwise:criterion=p:enter=0"),
              HasSubstr("enter must be above 0 and below 1"));
  EXPECT_THAT(RefusalOfSpec("poly:stepwise:criterion=p:enter=0.1:remove=0.05"),
              HasSubstr("remove (0.05) is below enter (0.1)"));
  EXPECT_THAT(RefusalOfSpec("poly:stepwise:enter=0.1"),
              HasSubstr("they need criterion=p"));
  EXPECT_THAT(RefusalOfSpec("poly:stepwise:criterion=dic"),
              HasSubstr("criterion must be one of p, aic"));
  EXPECT_THAT(RefusalOfSpec("poly:stepwise:include=position_mm++t1"),
              HasSubstr("position 13"));
  EXPECT_THAT(RefusalOfSpec("poly:formula=a*"), HasSubstr("position 3"));
  EXPECT_THAT(RefusalOfSpec("poly:best:criterion=press"),
              HasSubstr("criterion must be one of aic"));
  EXPECT_THAT(RefusalOfSpec("poly:ridge:penalty=1:rule=1se"),
              HasSubstr("which penalty= fixes"));
  const data::Dataset dataset = QuadraticData(40);
  const auto refusal = [&](const std::string& spec) {
    return RefusalOfInSelectionRecipe(
        [&] { MakeRecipe(spec)->Fit(dataset, {}); });
  };
  EXPECT_THAT(refusal("poly:stepwise:include=t9_degC"),
              HasSubstr("'t9_degC' is not an input"));
  EXPECT_THAT(refusal("poly:stepwise:degree=2:exclude=t1_degC^3"),
              HasSubstr("t1_degC^3 is not among the terms up to degree 2"));
  EXPECT_THAT(refusal("poly:stepwise:include=t1_degC:exclude=t1_degC"),
              HasSubstr("both included and excluded"));
  EXPECT_THAT(refusal("poly:formula=nothing_here"),
              HasSubstr("'nothing_here' is not an input"));
}

TEST(SelectionRecipe, NamesAliasedTerms) {
  const data::Dataset all = QuadraticData(50);
  data::Dataset::Parts parts;
  parts.source = "copies";
  parts.inputs = all.inputs();
  parts.input_values = all.input_values();
  parts.input_values.col(2) = all.input_values().col(1);  // t2 repeats t1
  parts.target = all.target();
  parts.target_values = all.target_values();
  const FittedModel fitted =
      MakeRecipe("poly:stepwise:degree=2")
          ->Fit(data::Dataset(std::move(parts)), kExplain);
  bool named = false;
  for (const AliasedRecord& alias : LeastSquaresOf(fitted).aliased) {
    named =
        named || (alias.term == "t2_degC" && alias.why == "repeats t1_degC");
  }
  EXPECT_TRUE(named);
}

}  // namespace
}  // namespace errmap::models
