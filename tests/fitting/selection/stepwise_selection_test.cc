#include "fitting/selection/stepwise_selection.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fitting/least_squares/linear_least_squares.h"
#include "stats/random.h"
#include "tests/random_matrix.h"

namespace errmap::fitting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using errmap::testing::RandomMatrix;
using errmap::testing::RandomVector;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::ThrowsMessage;
using ::testing::UnorderedElementsAre;

// Forward by BIC.
SelectionResult SelectForward(const MatrixXd& candidates,
                              const VectorXd& response,
                              const VectorXd& weights,
                              const StepwiseOptions& options = {}) {
  return SelectStepwise({candidates, response, weights}, {}, options);
}

double Bic(double residual_sum_of_squares, Index rows, Index coefficients) {
  const double n = static_cast<double>(rows);
  return n * std::log(residual_sum_of_squares / n) +
         static_cast<double>(coefficients) * std::log(n);
}

LeastSquaresFit FitWithIntercept(const MatrixXd& candidates,
                                 const std::vector<Index>& columns,
                                 const VectorXd& response,
                                 const VectorXd& weights) {
  MatrixXd design(candidates.rows(), static_cast<Index>(columns.size()) + 1);
  design.col(0).setOnes();
  for (std::size_t j = 0; j < columns.size(); ++j) {
    design.col(static_cast<Index>(j) + 1) = candidates.col(columns[j]);
  }
  return SolveLeastSquares(design, response, weights);
}

// The definition, one least-squares fit per candidate and step.
SelectionResult BruteForce(const MatrixXd& candidates,
                           const VectorXd& response,
                           const VectorXd& weights) {
  const Index rows = response.size();
  SelectionResult result;
  const double start = FitWithIntercept(candidates, {}, response, weights)
                           .residual_sum_of_squares;
  result.steps.push_back({-1, start, Bic(start, rows, 1)});
  while (static_cast<Index>(result.chosen.size()) < rows - 2) {
    SelectionStep best;
    best.residual_sum_of_squares = std::numeric_limits<double>::infinity();
    for (Index j = 0; j < candidates.cols(); ++j) {
      if (std::find(result.chosen.begin(), result.chosen.end(), j) !=
          result.chosen.end()) {
        continue;
      }
      std::vector<Index> columns = result.chosen;
      columns.push_back(j);
      const double rss =
          FitWithIntercept(candidates, columns, response, weights)
              .residual_sum_of_squares;
      if (rss < best.residual_sum_of_squares) {
        best.candidate = j;
        best.residual_sum_of_squares = rss;
      }
    }
    if (best.candidate < 0) break;
    best.bic = Bic(best.residual_sum_of_squares,
                   rows,
                   static_cast<Index>(result.chosen.size()) + 2);
    if (best.bic >= result.steps.back().bic) break;
    result.chosen.push_back(best.candidate);
    result.steps.push_back(best);
  }
  return result;
}

void ExpectSame(const SelectionResult& found, const SelectionResult& expected) {
  constexpr double kRelative = 1e-9;  // two orthogonalisations' roundings
  EXPECT_EQ(found.chosen, expected.chosen);
  ASSERT_EQ(found.steps.size(), expected.steps.size());
  for (std::size_t i = 0; i < found.steps.size(); ++i) {
    EXPECT_EQ(found.steps[i].candidate, expected.steps[i].candidate);
    EXPECT_NEAR(found.steps[i].residual_sum_of_squares,
                expected.steps[i].residual_sum_of_squares,
                kRelative * expected.steps[i].residual_sum_of_squares);
    EXPECT_NEAR(found.steps[i].bic,
                expected.steps[i].bic,
                kRelative * std::abs(expected.steps[i].bic));
  }
}

void ExpectRefused(const MatrixXd& candidates,
                   const VectorXd& response,
                   const VectorXd& weights,
                   const std::string& message) {
  EXPECT_THAT([&] { SelectForward(candidates, response, weights); },
              ThrowsMessage<std::invalid_argument>(HasSubstr(message)));
}

TEST(StepwiseSelection, KeepsWhatMattersAndDropsTheRest) {
  constexpr double kNoise = 0.01;
  constexpr std::uint64_t kDraws = 50;
  // BIC lets a useless column in with probability P(chi2_1 > ln 200) = 2.1 %:
  // of 8 in 50 draws about 8.6, with a standard deviation of 2.9.
  constexpr std::size_t kMostUseless = 18;
  std::size_t useless = 0;
  for (std::uint64_t draw = 0; draw < kDraws; ++draw) {
    const MatrixXd candidates = RandomMatrix(200, 10, 2 * draw);
    const VectorXd response = 3.0 + 2.0 * candidates.col(7).array() -
                              0.5 * candidates.col(2).array() +
                              kNoise * RandomVector(200, 2 * draw + 1).array();
    const SelectionResult result = SelectForward(candidates, response, {});
    ASSERT_GE(result.chosen.size(), 2U);
    EXPECT_EQ(result.chosen[0], 7);
    EXPECT_EQ(result.chosen[1], 2);
    useless += result.chosen.size() - 2;
  }
  EXPECT_LE(useless, kMostUseless);
}

TEST(StepwiseSelection, ChoosesNothingWhereNothingHelps) {
  // Columns at right angles to the response once its mean is gone.
  const MatrixXd candidates{{1.0, 1.0}, {1.0, -1.0}, {-1.0, 1.0}, {-1.0, -1.0}};
  const VectorXd response{{1.0, -1.0, -1.0, 1.0}};
  const SelectionResult result = SelectForward(candidates, response, {});
  EXPECT_THAT(result.chosen, IsEmpty());
  ASSERT_THAT(result.steps, SizeIs(1));
  EXPECT_EQ(result.steps[0].candidate, -1);
  EXPECT_DOUBLE_EQ(result.steps[0].residual_sum_of_squares, 4.0);
  EXPECT_DOUBLE_EQ(result.steps[0].bic, std::log(4.0));
}

TEST(StepwiseSelection, EntersTheSameTermsAsBruteForce) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Index rows = 12 + static_cast<Index>(seed);
    const MatrixXd candidates = RandomMatrix(rows, 7, 100 + seed);
    const VectorXd response = candidates * RandomVector(7, 200 + seed) +
                              0.5 * RandomVector(rows, 300 + seed);
    SCOPED_TRACE("seed " + std::to_string(seed));
    ExpectSame(SelectForward(candidates, response, {}),
               BruteForce(candidates, response, {}));
  }
}

TEST(StepwiseSelection, EntersTheSameTermsAsBruteForceOnCorrelatedColumns) {
  constexpr double kOwnShare = 0.1;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const VectorXd common = RandomVector(30, 400 + seed);
    MatrixXd candidates = kOwnShare * RandomMatrix(30, 6, 500 + seed);
    candidates.colwise() += common;
    candidates.rowwise() += RandomVector(6, 600 + seed).transpose() * 10.0;
    const VectorXd response = candidates.col(1) - candidates.col(4) + common +
                              0.05 * RandomVector(30, 700 + seed);
    SCOPED_TRACE("seed " + std::to_string(seed));
    ExpectSame(SelectForward(candidates, response, {}),
               BruteForce(candidates, response, {}));
  }
}

TEST(StepwiseSelection, EntersTheSameTermsAsBruteForceWithWeights) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Index rows = 25;
    const MatrixXd candidates = RandomMatrix(rows, 6, 800 + seed);
    const VectorXd response = candidates * RandomVector(6, 900 + seed) +
                              0.5 * RandomVector(rows, 1000 + seed);
    const VectorXd weights = 1.2 + RandomVector(rows, 1100 + seed).array();
    SCOPED_TRACE("seed " + std::to_string(seed));
    ExpectSame(SelectForward(candidates, response, weights),
               BruteForce(candidates, response, weights));
  }
}

TEST(StepwiseSelection, EqualWeightsOfOneChangeNothing) {
  const MatrixXd candidates = RandomMatrix(30, 5, 3);
  const VectorXd response = candidates.col(3) + 0.3 * RandomVector(30, 4);
  ExpectSame(SelectForward(candidates, response, VectorXd::Ones(30)),
             SelectForward(candidates, response, {}));
}

TEST(StepwiseSelection, RowOrderShiftAndScaleOfColumnsDoNotMatter) {
  const MatrixXd candidates = RandomMatrix(40, 5, 5);
  const VectorXd response =
      candidates.col(0) - 2.0 * candidates.col(4) + 0.3 * RandomVector(40, 6);
  const SelectionResult plain = SelectForward(candidates, response, {});
  ExpectSame(
      SelectForward(candidates.colwise().reverse(), response.reverse(), {}),
      plain);
  MatrixXd moved = candidates;
  const VectorXd scales{{1e3, 1e-6, -1.0, 1.0, 1e8}};
  moved = moved * scales.asDiagonal();
  moved.rowwise() += scales.transpose();
  ExpectSame(SelectForward(moved, response.array() + 5.0, {}), plain);
}

TEST(StepwiseSelection, PassesOverACollinearCandidate) {
  MatrixXd candidates = RandomMatrix(30, 4, 7);
  candidates.col(1) = 2.0 * candidates.col(0).array() + 1.0;
  candidates.col(3).setConstant(5.0);  // the intercept again
  const VectorXd response =
      candidates.col(0) + 0.5 * candidates.col(2) + 1e-3 * RandomVector(30, 8);
  const SelectionResult result = SelectForward(candidates, response, {});
  EXPECT_THAT(result.chosen, SizeIs(2));
  EXPECT_THAT(result.chosen, ::testing::Contains(2));
  EXPECT_THAT(result.chosen, ::testing::Not(::testing::Contains(3)));
}

TEST(StepwiseSelection, TiesGoToTheLowestColumn) {
  MatrixXd candidates = RandomMatrix(20, 3, 9);
  candidates.col(2) = candidates.col(1);
  const VectorXd response = candidates.col(1) + 0.1 * RandomVector(20, 10);
  const SelectionResult result = SelectForward(candidates, response, {});
  ASSERT_FALSE(result.chosen.empty());
  EXPECT_EQ(result.chosen[0], 1);
  EXPECT_THAT(result.chosen, ::testing::Not(::testing::Contains(2)));
}

TEST(StepwiseSelection, TakesACopyOnlyIfItDiffersByMoreThanRounding) {
  const MatrixXd parts = RandomMatrix(30, 2, 11);
  const VectorXd response = parts.rowwise().sum();
  const auto with_copy = [&](double difference) {
    MatrixXd candidates = parts;
    candidates.col(1) = parts.col(0) + difference * parts.col(1);
    return SelectForward(candidates, response, {}).chosen;
  };
  EXPECT_THAT(with_copy(0.01 * kCollinear), SizeIs(1));
  EXPECT_THAT(with_copy(100.0 * kCollinear), UnorderedElementsAre(0, 1));
}

TEST(StepwiseSelection, StopsAtAPerfectFit) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const MatrixXd candidates = RandomMatrix(25, 8, 1200 + seed);
    const VectorXd response = 2.0 + 3.0 * candidates.col(5).array();
    EXPECT_THAT(SelectForward(candidates, response, {}).chosen, ElementsAre(5))
        << "seed " << seed;
  }
}

TEST(StepwiseSelection, AConstantResponseNeedsNoTerm) {
  for (const double value : {0.0, 0.1, -3.7e5}) {
    const SelectionResult result = SelectForward(
        RandomMatrix(12, 4, 12), VectorXd::Constant(12, value), {});
    EXPECT_THAT(result.chosen, IsEmpty()) << value;
    EXPECT_THAT(result.steps, SizeIs(1)) << value;
  }
}

TEST(StepwiseSelection, KeepsToTheMostTermsAllowed) {
  const MatrixXd candidates = RandomMatrix(50, 6, 13);
  const VectorXd response =
      candidates * VectorXd{{1.0, 2.0, 3.0, 4.0, 5.0, 6.0}};
  const SelectionResult all = SelectForward(candidates, response, {});
  ASSERT_THAT(all.chosen, SizeIs(6));
  for (Index most = 0; most <= 6; ++most) {
    StepwiseOptions options;
    options.max_terms = most;
    const SelectionResult result =
        SelectForward(candidates, response, {}, options);
    EXPECT_EQ(
        result.chosen,
        std::vector<Index>(all.chosen.begin(), all.chosen.begin() + most));
    EXPECT_THAT(result.steps, SizeIs(result.chosen.size() + 1));
  }
}

TEST(StepwiseSelection, LeavesADegreeOfFreedom) {
  // Rows less the intercept less one: three rows take one term at most.
  for (const Index rows : {2, 3, 4, 5}) {
    const SelectionResult result =
        SelectForward(RandomMatrix(rows, 10, 14), RandomVector(rows, 15), {});
    EXPECT_LE(static_cast<Index>(result.chosen.size()), rows - 2);
  }
}

TEST(StepwiseSelection, NoCandidatesLeaveTheIntercept) {
  const SelectionResult result =
      SelectForward(MatrixXd(5, 0), RandomVector(5, 16), {});
  EXPECT_THAT(result.chosen, IsEmpty());
  EXPECT_THAT(result.steps, SizeIs(1));
}

TEST(StepwiseSelection, BicFallsAtEveryStep) {
  const MatrixXd candidates = RandomMatrix(60, 12, 17);
  const VectorXd response =
      candidates * RandomVector(12, 18) + 0.2 * RandomVector(60, 19);
  const SelectionResult result = SelectForward(candidates, response, {});
  ASSERT_THAT(result.steps, SizeIs(result.chosen.size() + 1));
  for (std::size_t i = 1; i < result.steps.size(); ++i) {
    EXPECT_EQ(result.steps[i].candidate, result.chosen[i - 1]);
    EXPECT_LT(result.steps[i].bic, result.steps[i - 1].bic);
    EXPECT_LT(result.steps[i].residual_sum_of_squares,
              result.steps[i - 1].residual_sum_of_squares);
  }
}

TEST(StepwiseSelection, RefusesShapesThatDoNotAgree) {
  ExpectRefused(
      MatrixXd::Ones(3, 2),
      VectorXd::Ones(4),
      {},
      "SelectStepwise: candidates have 3 rows, response 4, weights 0");
  ExpectRefused(
      MatrixXd::Ones(4, 2),
      VectorXd::Ones(4),
      VectorXd::Ones(3),
      "SelectStepwise: candidates have 4 rows, response 4, weights 3");
  ExpectRefused(MatrixXd::Ones(1, 2),
                VectorXd::Ones(1),
                {},
                "response 1, weights 0; at least 2 equal are needed");
}

}  // namespace
}  // namespace errmap::fitting
