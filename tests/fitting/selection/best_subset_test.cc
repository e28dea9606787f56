#include "fitting/selection/best_subset.h"

#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fitting/least_squares/linear_least_squares.h"
#include "tests/fitting/regression_test_data.h"

namespace errmap::fitting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using errmap::testing::UniformMatrix;
using ::testing::ElementsAre;

// The definition: every subset fitted.
std::vector<Index> EverySubset(const MatrixXd& candidates,
                               const VectorXd& response,
                               const VectorXd& weights,
                               Criterion criterion,
                               Index most) {
  double lowest = std::numeric_limits<double>::infinity();
  std::vector<Index> best;
  const double n = static_cast<double>(response.size());
  double total = 0.0;
  for (unsigned set = 0; set < (1U << candidates.cols()); ++set) {
    std::vector<Index> columns;
    for (Index j = 0; j < candidates.cols(); ++j) {
      if ((set >> j & 1U) != 0) columns.push_back(j);
    }
    if (static_cast<Index>(columns.size()) > most) continue;
    MatrixXd design(candidates.rows(), static_cast<Index>(columns.size()) + 1);
    design << VectorXd::Ones(candidates.rows()),
        candidates(Eigen::all, columns);
    const double rss =
        SolveLeastSquares(design, response, weights).residual_sum_of_squares;
    if (set == 0) total = rss;
    const double k = static_cast<double>(columns.size()) + 1.0;
    const double value = criterion == Criterion::kAic    ? Aic(rss, n, k)
                         : criterion == Criterion::kAicc ? Aicc(rss, n, k)
                         : criterion == Criterion::kBic
                             ? Bic(rss, n, k)
                             : -AdjustedR2(rss, total, n, k);
    if (value < lowest) {
      lowest = value;
      best = columns;
    }
  }
  return best;
}

TEST(BestSubset, IsTheBestOfAllSubsetsByEveryCriterion) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const MatrixXd common = UniformMatrix(30, 1, 100 + seed);
    MatrixXd candidates = UniformMatrix(30, 8, seed);
    candidates += 0.9 * common * UniformMatrix(1, 8, 200 + seed);
    const VectorXd response = candidates.col(1) - 0.6 * candidates.col(4) +
                              0.4 * candidates.col(6) +
                              0.7 * UniformMatrix(30, 1, 300 + seed);
    const VectorXd weights =
        seed % 2 == 0 ? VectorXd(1.5 + UniformMatrix(30, 1, 400).array())
                      : VectorXd();
    for (const Criterion criterion : {Criterion::kAic,
                                      Criterion::kAicc,
                                      Criterion::kBic,
                                      Criterion::kAdjustedR2}) {
      BestSubsetOptions options;
      options.criterion = criterion;
      options.max_terms = seed % 3 == 0 ? 3 : -1;
      const BestSubsetResult best =
          SelectBestSubset({candidates, response, weights}, {}, {}, options);
      EXPECT_EQ(
          best.chosen,
          EverySubset(
              candidates, response, weights, criterion, seed % 3 == 0 ? 3 : 8))
          << "seed " << seed << " " << ToString(criterion);
      EXPECT_TRUE(best.complete);
    }
  }
}

TEST(BestSubset, KeepsWhatIsIncludedAndLeavesOutWhatIsExcluded) {
  const MatrixXd candidates = UniformMatrix(40, 6, 1);
  const VectorXd response =
      candidates.col(2) + candidates.col(3) + 0.1 * UniformMatrix(40, 1, 2);
  const VectorXd none;
  std::vector<bool> excluded(6, false);
  excluded[3] = true;
  const auto chosen =
      SelectBestSubset({candidates, response, none}, {5}, excluded, {}).chosen;
  EXPECT_THAT(chosen, ::testing::Contains(5));
  EXPECT_THAT(chosen, ::testing::Contains(2));
  EXPECT_THAT(chosen, ::testing::Not(::testing::Contains(3)));
}

TEST(BestSubset, NamesCopiesAndConstants) {
  MatrixXd candidates = UniformMatrix(20, 4, 3);
  candidates.col(2) = 1.0 - 2.0 * candidates.col(0).array();
  candidates.col(3).setConstant(7.0);
  const VectorXd response = candidates.col(0) + 0.1 * UniformMatrix(20, 1, 4);
  const VectorXd none;
  EXPECT_THAT(
      SelectBestSubset({candidates, response, none}, {}, {}, {}).aliased,
      ElementsAre(2, 3));
}

TEST(BestSubset, LooksAtFewOfTheSubsetsOfFortyTerms) {
  const MatrixXd candidates = UniformMatrix(300, 40, 5);
  const VectorXd response = candidates.leftCols(6) * VectorXd::Ones(6) +
                            0.5 * UniformMatrix(300, 1, 6);
  const VectorXd none;
  const BestSubsetResult best =
      SelectBestSubset({candidates, response, none}, {}, {}, {});
  for (Index j = 0; j < 6; ++j) {
    EXPECT_THAT(best.chosen, ::testing::Contains(j));
  }
  EXPECT_LT(best.nodes, 1'000'000);  // of 1.1e12 subsets
}

TEST(BestSubset, RefusesCriteriaThatNeedTheRows) {
  BestSubsetOptions options;
  EXPECT_NO_THROW(options.Validate());
  options.criterion = Criterion::kPress;
  EXPECT_THROW(options.Validate(), std::invalid_argument);
}

}  // namespace
}  // namespace errmap::fitting
