// Directions, criteria, heredity and limits of SelectStepwise; the order of
// terms is compared with R's in stepwise_golden_test.cc.
#include <cmath>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fitting/least_squares/linear_least_squares.h"
#include "fitting/selection/stepwise_selection.h"
#include "tests/fitting/regression_test_data.h"
#include "tests/fitting/stepwise_data.h"

namespace errmap::fitting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using errmap::testing::UniformMatrix;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;
using ::testing::UnorderedElementsAre;

const VectorXd kStepwiseRulesEqual;

MatrixXd DesignOf(const MatrixXd& candidates,
                  const std::vector<Index>& chosen) {
  MatrixXd design(candidates.rows(), static_cast<Index>(chosen.size()) + 1);
  design << VectorXd::Ones(candidates.rows()), candidates(Eigen::all, chosen);
  return design;
}

// PRESS by leaving each row out in turn.
double PressByRefitting(const MatrixXd& design, const VectorXd& response) {
  double press = 0.0;
  for (Index left = 0; left < design.rows(); ++left) {
    std::vector<Index> rows;
    for (Index i = 0; i < design.rows(); ++i) {
      if (i != left) rows.push_back(i);
    }
    const VectorXd coefficients =
        SolveLeastSquares(design(rows, Eigen::all), response(rows))
            .coefficients;
    press += std::pow(response[left] - design.row(left).dot(coefficients), 2);
  }
  return press;
}

// As R's lm drops them. Their values are beyond all others.
TEST(StepwiseRules, RowsOfWeightZeroAreAsIfTheyWereNotThere) {
  constexpr double kRelative = 1e-9;
  constexpr Index kRows = 24;
  constexpr Index kNothing = 9;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    MatrixXd candidates = UniformMatrix(kRows + kNothing, 6, seed);
    VectorXd response = candidates.col(0) + 0.5 * candidates.col(3) +
                        0.3 * UniformMatrix(kRows + kNothing, 1, 50 + seed);
    VectorXd weights =
        1.5 + UniformMatrix(kRows + kNothing, 1, 90 + seed).array();
    std::vector<Index> kept;
    for (Index i = 0; i < kRows + kNothing; ++i) {
      if (i % 4 == 3 || i == 1) {
        weights[i] = 0.0;
        candidates.row(i) *= 100.0;
        response[i] = -50.0;
      } else {
        kept.push_back(i);
      }
    }
    ASSERT_EQ(kept.size(), kRows);
    const MatrixXd few_candidates = candidates(kept, Eigen::all);
    const VectorXd few_response = response(kept);
    const VectorXd few_weights = weights(kept);
    const RegressionProblem with_all{candidates, response, weights};
    const RegressionProblem with_few{few_candidates, few_response, few_weights};
    for (const Criterion criterion : {Criterion::kPValue,
                                      Criterion::kAic,
                                      Criterion::kAicc,
                                      Criterion::kBic,
                                      Criterion::kAdjustedR2,
                                      Criterion::kPress,
                                      Criterion::kCp}) {
      StepwiseOptions options;
      options.select = options.stop = options.choose = criterion;
      options.direction = Direction::kBoth;
      const SelectionResult found = SelectStepwise(with_all, {}, options);
      const SelectionResult expected = SelectStepwise(with_few, {}, options);
      EXPECT_EQ(found.chosen, expected.chosen);
      ASSERT_EQ(found.steps.size(), expected.steps.size());
      for (std::size_t i = 0; i < found.steps.size(); ++i) {
        const SelectionStep& one = found.steps[i];
        const SelectionStep& other = expected.steps[i];
        const auto expect_near = [&](double a, double b) {
          if (std::isnan(b)) {
            EXPECT_TRUE(std::isnan(a));
          } else {
            EXPECT_NEAR(a, b, kRelative * (1.0 + std::abs(b)));
          }
        };
        expect_near(one.bic, other.bic);
        expect_near(one.aic, other.aic);
        expect_near(one.aicc, other.aicc);
        expect_near(one.adjusted_r2, other.adjusted_r2);
        expect_near(one.press, other.press);
        expect_near(one.cp, other.cp);
        expect_near(one.f, other.f);
        expect_near(one.p, other.p);
      }
    }
    const auto judged = JudgeExcluded(with_all, {0});
    const auto judged_few = JudgeExcluded(with_few, {0});
    for (std::size_t i = 0; i < judged.size(); ++i) {
      EXPECT_NEAR(judged[i].f, judged_few[i].f, kRelative * judged_few[i].f);
    }
  }
}

TEST(StepwiseRules, SelectsByPressAsRefittingWould) {
  constexpr double kRelative = 1e-9;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const MatrixXd candidates = UniformMatrix(18, 6, seed);
    const VectorXd response = candidates.col(0) + candidates.col(3) +
                              0.5 * UniformMatrix(18, 1, 50 + seed);
    StepwiseOptions options;
    options.select = options.stop = options.choose = Criterion::kPress;
    options.direction = Direction::kBoth;
    const SelectionResult result = SelectStepwise(
        {candidates, response, kStepwiseRulesEqual}, {}, options);
    std::vector<Index> chosen;
    for (std::size_t i = 0; i < result.steps.size(); ++i) {
      const SelectionStep& step = result.steps[i];
      if (i > 0 && step.entered) chosen.push_back(step.candidate);
      if (i > 0 && !step.entered) std::erase(chosen, step.candidate);
      const double press =
          PressByRefitting(DesignOf(candidates, chosen), response);
      EXPECT_NEAR(step.press, press, kRelative * press);
      // No single move leads to less than the next step.
      for (Index j = 0; i + 1 < result.steps.size() && j < 6; ++j) {
        std::vector<Index> other = chosen;
        if (std::erase(other, j) == 0) other.push_back(j);
        EXPECT_GE(PressByRefitting(DesignOf(candidates, other), response),
                  result.steps[i + 1].press * (1.0 - kRelative));
      }
    }
  }
}

TEST(StepwiseRules, SelectsByCrossValidationAsRefittingWould) {
  constexpr double kRelative = 1e-9;
  const MatrixXd candidates = UniformMatrix(25, 6, 3);
  const VectorXd response =
      candidates.col(2) - candidates.col(5) + 0.5 * UniformMatrix(25, 1, 4);
  TermRules rules;
  for (Index i = 0; i < 25; ++i) rules.folds.codes.push_back(i / 5);
  StepwiseOptions options;
  options.select = options.stop = options.choose = Criterion::kCv;
  const SelectionResult result = SelectStepwise(
      {candidates, response, kStepwiseRulesEqual}, rules, options);
  std::vector<Index> chosen;
  for (std::size_t i = 1; i < result.steps.size(); ++i) {
    for (Index j = 0; j < 6; ++j) {
      if (std::find(chosen.begin(), chosen.end(), j) != chosen.end()) continue;
      std::vector<Index> other = chosen;
      other.push_back(j);
      const double cv = CrossValidatedError(
          DesignOf(candidates, other), response, rules.folds);
      EXPECT_GE(cv, result.steps[i].cv * (1.0 - kRelative));
      if (j == result.steps[i].candidate) {
        EXPECT_NEAR(cv, result.steps[i].cv, kRelative * cv);
      }
    }
    chosen.push_back(result.steps[i].candidate);
  }
  EXPECT_THAT(chosen, Contains(2));
  EXPECT_THAT(chosen, Contains(5));
}

TEST(StepwiseRules, EfroymsonLetsATermLeaveThatOthersReplace) {
  // x2 is nearly x0 + x1: it comes first and goes once both are in.
  MatrixXd candidates = UniformMatrix(200, 3, 5);
  candidates.col(2) =
      candidates.col(0) + candidates.col(1) + 0.2 * candidates.col(2);
  const VectorXd response =
      candidates.col(0) + candidates.col(1) + 0.05 * UniformMatrix(200, 1, 6);
  StepwiseOptions options;
  options.direction = Direction::kBoth;
  options.select = options.stop = options.choose = Criterion::kPValue;
  const SelectionResult result =
      SelectStepwise({candidates, response, kStepwiseRulesEqual}, {}, options);
  EXPECT_EQ(result.steps[1].candidate, 2);
  EXPECT_THAT(result.chosen, UnorderedElementsAre(0, 1));
  EXPECT_FALSE(result.steps.back().entered);
}

// Columns x, y, x^2, x y, y^2 with a response in x y alone.
TEST(StepwiseRules, HeredityAdmitsAProductAfterItsParents) {
  const MatrixXd inputs = UniformMatrix(80, 2, 7);
  const MatrixXd candidates = errmap::testing::QuadraticTerms(inputs);
  const VectorXd response = inputs.col(0).cwiseProduct(inputs.col(1)) +
                            0.2 * inputs.col(0) +
                            0.01 * UniformMatrix(80, 1, 8);
  TermRules rules;
  rules.parents = {{}, {}, {0}, {0, 1}, {1}};
  StepwiseOptions options;
  const auto chosen = [&](Heredity heredity) {
    options.heredity = heredity;
    return SelectStepwise(
               {candidates, response, kStepwiseRulesEqual}, rules, options)
        .chosen;
  };
  EXPECT_EQ(chosen(Heredity::kNone).front(), 3);
  // One parent is enough: y lets x y in before x, and comes first because it
  // alone leaves less than x alone does.
  const auto alone = [&](Index input) {
    return SolveLeastSquares(DesignOf(inputs, {input}), response)
        .residual_sum_of_squares;
  };
  ASSERT_LT(alone(1), alone(0));
  EXPECT_THAT(chosen(Heredity::kWeak), ElementsAre(1, 3, 0));
  const std::vector<Index> strong = chosen(Heredity::kStrong);
  for (const Index term : strong) {
    for (const Index parent : rules.parents[static_cast<std::size_t>(term)]) {
      EXPECT_THAT(strong, Contains(parent));
    }
  }
  options.direction = Direction::kBackward;
  EXPECT_THAT(chosen(Heredity::kStrong), UnorderedElementsAre(0, 1, 3));
}

TEST(StepwiseRules, IncludedStayAndExcludedStayOut) {
  const MatrixXd candidates = UniformMatrix(60, 5, 9);
  const VectorXd response =
      candidates.col(0) + candidates.col(1) + 0.1 * UniformMatrix(60, 1, 10);
  TermRules rules;
  rules.include = {4};
  rules.excluded = {true, false, false, false, false};
  for (const Direction direction :
       {Direction::kForward, Direction::kBackward, Direction::kBoth}) {
    StepwiseOptions options;
    options.direction = direction;
    const auto chosen =
        SelectStepwise(
            {candidates, response, kStepwiseRulesEqual}, rules, options)
            .chosen;
    EXPECT_THAT(chosen, Contains(4));
    EXPECT_THAT(chosen, Contains(1));
    EXPECT_THAT(chosen, Not(Contains(0)));
  }
}

TEST(StepwiseRules, MoreCandidatesThanRowsAndCopiesAreNoTrouble) {
  MatrixXd candidates = UniformMatrix(20, 200, 11);
  candidates.rightCols(100) = candidates.leftCols(100);
  const VectorXd response =
      candidates.col(3) - candidates.col(9) + 1e-3 * UniformMatrix(20, 1, 12);
  StepwiseOptions options;
  options.stop = Criterion::kNone;
  options.choose = Criterion::kBic;
  const SelectionResult result =
      SelectStepwise({candidates, response, kStepwiseRulesEqual}, {}, options);
  EXPECT_EQ(result.steps.back().terms, 18);  // one degree of freedom is left
  for (const SelectionStep& step : result.steps) {
    EXPECT_LT(step.candidate, 100);  // never the copy
    EXPECT_TRUE(std::isfinite(step.residual_sum_of_squares));
  }
  const auto excluded =
      JudgeExcluded({candidates, response, kStepwiseRulesEqual}, {3, 9});
  ASSERT_EQ(excluded.size(), 198U);
  EXPECT_TRUE(excluded[101].aliased);  // column 103, the copy of 3
  EXPECT_FALSE(excluded[0].aliased);
  EXPECT_GE(excluded[0].f, 0.0);
}

TEST(StepwiseRules, ExcludedTermsHaveTheFOfARefit) {
  constexpr double kRelative = 1e-9;
  const MatrixXd candidates = UniformMatrix(30, 5, 13);
  const VectorXd response = UniformMatrix(30, 1, 14);
  const double rss = SolveLeastSquares(DesignOf(candidates, {1, 2}), response)
                         .residual_sum_of_squares;
  for (const ExcludedTerm& term :
       JudgeExcluded({candidates, response, kStepwiseRulesEqual}, {1, 2})) {
    const double less =
        SolveLeastSquares(DesignOf(candidates, {1, 2, term.candidate}),
                          response)
            .residual_sum_of_squares;
    const double f = (rss - less) / (less / 26.0);
    EXPECT_NEAR(term.f, f, kRelative * (1.0 + f));
  }
}

TEST(StepwiseRules, RefusesWhatCannotWork) {
  const MatrixXd candidates = UniformMatrix(10, 30, 15);
  const VectorXd response = UniformMatrix(10, 1, 16);
  const auto expect = [&](const StepwiseOptions& options,
                          const std::string& message) {
    EXPECT_THAT(
        [&] {
          SelectStepwise(
              {candidates, response, kStepwiseRulesEqual}, {}, options);
        },
        ThrowsMessage<std::invalid_argument>(HasSubstr(message)));
  };
  StepwiseOptions options;
  options.remove = 0.01;
  expect(options, "must not be below enter");
  options = {};
  options.enter = 0.0;
  expect(options, "enter must be above 0 and below 1");
  options = {};
  options.direction = Direction::kBackward;
  expect(options, "needs more rows than terms; there are 10 rows");
  options = {};
  options.choose = Criterion::kCp;
  expect(options, "Cp needs sigma2= or more rows than candidate terms");
  options = {};
  options.stop = Criterion::kCv;
  expect(options, "CV needs folds");
  options = {};
  options.heredity = Heredity::kStrong;
  expect(options, "heredity needs the parents");
}

// Hurvich and Tsai (1989): AIC + 2 K (K + 1) / (n - K - 1), K = k + 1 with the
// error variance.
TEST(InformationCriteria, AiccAddsThePenaltyOfASmallSample) {
  constexpr double kRss = 2.0;
  constexpr double kRows = 20.0;
  const double aic = kRows * std::log(kRss / kRows) + 2.0 * 3.0;
  EXPECT_DOUBLE_EQ(Aic(kRss, kRows, 3.0), aic);
  EXPECT_DOUBLE_EQ(Aicc(kRss, kRows, 3.0), aic + 2.0 * 4.0 * 5.0 / 15.0);
  EXPECT_EQ(Aicc(kRss, 5.0, 3.0), std::numeric_limits<double>::infinity());
}

// As R's summary.lm has it, and Mallows (1973).
TEST(InformationCriteria, AdjustedR2AndCpCountColumnsOnce) {
  // 1 - (2 / 8) / (10 / 10); 6 / 2 - 11 + 2 * 3.
  EXPECT_DOUBLE_EQ(AdjustedR2(2.0, 10.0, 11.0, 3.0), 0.75);
  EXPECT_DOUBLE_EQ(MallowsCp(6.0, 2.0, 11.0, 3.0), -2.0);
  EXPECT_EQ(AdjustedR2(2.0, 10.0, 3.0, 3.0),
            -std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace errmap::fitting
