#include "fitting/least_squares/penalized_path.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include "fitting/least_squares/linear_least_squares.h"
#include "stats/random.h"
#include "tests/decompositions.h"
#include "tests/fitting/regression_test_data.h"

namespace errmap::fitting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using errmap::testing::UniformMatrix;

struct Sample {
  MatrixXd terms;
  VectorXd response;
  VectorXd weights;
};

// Collinear columns of different scales; more columns than rows where asked.
Sample MakeSample(Index rows, Index cols, bool weighted, std::uint64_t seed) {
  Sample sample;
  const VectorXd common = UniformMatrix(rows, 1, seed);
  sample.terms = UniformMatrix(rows, cols, seed + 1);
  sample.terms += 2.0 * common * VectorXd::Ones(cols).transpose();
  for (Index j = 0; j < cols; ++j) {
    sample.terms.col(j) *= 1.0 + 3.0 * static_cast<double>(j);
    sample.terms.col(j).array() += 10.0 * static_cast<double>(j);
  }
  sample.response = 4.0 + common.array() + 0.3 * sample.terms.col(1).array() +
                    0.2 * UniformMatrix(rows, 1, seed + 2).array();
  if (weighted) sample.weights = 1.5 + UniformMatrix(rows, 1, 9).array();
  return sample;
}

CrossProducts SumsOf(const Sample& sample) {
  return SumProducts(sample.terms, sample.response, sample.weights);
}

// Those ways of a ridge that a sample allows: by columns, and by rows.
std::vector<PenalizedPath> RidgesOf(const Sample& sample, bool intercept) {
  std::vector<PenalizedPath> paths{
      {Penalty::kRidge, SumsOf(sample), intercept}};
  if (sample.terms.rows() < sample.terms.cols()) {
    paths.push_back({SumsOf(sample),
                     intercept,
                     sample.terms,
                     sample.response,
                     sample.weights});
  }
  return paths;
}

// Weighted, centred columns of variance 1 and the residual, by definition.
void Standardise(const Sample& sample,
                 const VectorXd& coefficients,
                 MatrixXd* x,
                 VectorXd* residual,
                 VectorXd* w,
                 VectorXd* spread) {
  *w = sample.weights.size() != 0 ? sample.weights
                                  : VectorXd::Ones(sample.response.size());
  *w /= w->sum();
  *x = sample.terms;
  spread->resize(x->cols());
  for (Index j = 0; j < x->cols(); ++j) {
    x->col(j).array() -= w->dot(x->col(j));
    (*spread)[j] = std::sqrt(w->dot(x->col(j).cwiseAbs2()));
    if ((*spread)[j] > 0.0) x->col(j) /= (*spread)[j];
  }
  *residual = sample.response - sample.terms * coefficients;
  residual->array() -= w->dot(*residual);
}

TEST(PenalizedPath, LassoMeetsItsOptimalityConditionsAlongThePath) {
  constexpr double kSlack = 1e-10;
  for (const auto& [rows, cols, weighted] :
       {std::tuple<Index, Index, bool>{40, 8, false},
        {40, 8, true},
        {20, 50, false},
        {90, 120, true}}) {  // hundreds of knots, many where a column leaves
    const Sample sample = MakeSample(rows, cols, weighted, 20);
    const PenalizedPath path(Penalty::kLasso, SumsOf(sample), true);
    const double largest = path.Grid().front();
    const std::vector<double> strengths = {largest,
                                           0.9 * largest,
                                           0.3 * largest,
                                           0.05 * largest,
                                           0.01 * largest,
                                           1e-3 * largest,
                                           1e-4 * largest};
    const auto solutions = path.Solve(strengths);
    EXPECT_TRUE(solutions.coefficients.col(0).isZero());
    for (Index s = 1; s < solutions.coefficients.cols(); ++s) {
      const double strength = strengths[static_cast<std::size_t>(s)];
      const VectorXd coefficients = solutions.coefficients.col(s);
      MatrixXd x;
      VectorXd residual;
      VectorXd w;
      VectorXd spread;
      Standardise(sample, coefficients, &x, &residual, &w, &spread);
      const VectorXd gradient = x.transpose() * w.cwiseProduct(residual);
      for (Index j = 0; j < cols; ++j) {
        if (coefficients[j] == 0.0) {
          EXPECT_LE(std::abs(gradient[j]), strength + kSlack);
        } else {
          EXPECT_NEAR(
              gradient[j], std::copysign(strength, coefficients[j]), kSlack);
        }
      }
    }
  }
}

// How far solutions miss the conditions of a lasso's minimum, by the rows.
double WorstCondition(const Sample& sample,
                      const VectorXd& coefficients,
                      double strength) {
  MatrixXd x;
  VectorXd residual;
  VectorXd w;
  VectorXd spread;
  Standardise(sample, coefficients, &x, &residual, &w, &spread);
  const VectorXd gradient = x.transpose() * w.cwiseProduct(residual);
  double worst = 0.0;
  for (Index j = 0; j < gradient.size(); ++j) {
    const double miss =
        coefficients[j] == 0.0
            ? std::abs(gradient[j]) - strength
            : std::abs(gradient[j] - std::copysign(strength, coefficients[j]));
    worst = std::max(worst, miss);
  }
  return worst;
}

// Columns about the size of 1, of which some repeat others, nearly repeat them,
// are sums or differences of them, or do not vary.
Sample MakeDependentSample(std::uint64_t seed) {
  stats::Random random(seed);
  const auto rows = static_cast<Index>(5 + random.Below(40));
  const auto cols = static_cast<Index>(2 + random.Below(30));
  Sample sample;
  sample.terms = UniformMatrix(rows, cols, seed + 1);
  const auto column = [&] {
    return static_cast<Index>(random.Below(static_cast<std::uint64_t>(cols)));
  };
  for (Index j = 0; j < cols; ++j) {
    const VectorXd noise = UniformMatrix(rows, 1, seed + 2);
    const double apart = std::pow(10.0, -14.0 * random.Uniform());
    const VectorXd one = sample.terms.col(column());
    const VectorXd other = sample.terms.col(column());
    switch (random.Below(8)) {
      case 0:
        sample.terms.col(j) = one;
        break;
      case 1:
        sample.terms.col(j) = -one;
        break;
      case 2:
        sample.terms.col(j) = one + apart * noise;
        break;
      case 3:
        sample.terms.col(j) = one - other;
        break;
      case 4:
        sample.terms.col(j) = one + other + apart * noise;
        break;
      default:
        break;  // independent
    }
  }
  if (random.Below(4) == 0) sample.terms.col(column()).setConstant(0.3);
  if (random.Below(3) == 0)
    sample.terms = sample.terms.array().round();  // ties
  sample.response = UniformMatrix(rows, 1, seed + 3) +
                    sample.terms.col(column()) -
                    0.5 * sample.terms.col(column());
  if (random.Below(2) == 0) {
    sample.weights = 1.5 + UniformMatrix(rows, 1, seed + 4).array();
  }
  return sample;
}

TEST(PenalizedPath, LassoIsOptimalWhateverRepeatsWhat) {
  constexpr int kDesigns = 10'000;
  constexpr double kSlack = 1e-10;
  int missed = 0;
  for (std::uint64_t seed = 1; seed <= kDesigns; ++seed) {
    const Sample sample = MakeDependentSample(1000 * seed);
    const PenalizedPath path(Penalty::kLasso, SumsOf(sample), true);
    const double largest = path.Grid().front();
    std::vector<double> strengths = {largest,
                                     0.7 * largest,
                                     0.2 * largest,
                                     0.03 * largest,
                                     1e-3 * largest,
                                     1e-5 * largest};
    if (seed % 2 == 0) std::ranges::reverse(strengths);
    const auto solutions = path.Solve(strengths);
    for (std::size_t s = 0; s < strengths.size(); ++s) {
      const VectorXd b = solutions.coefficients.col(static_cast<Index>(s));
      const double miss = WorstCondition(sample, b, strengths[s]);
      if (!(miss <= kSlack)) {
        ++missed;
        if (missed < 10) {
          ADD_FAILURE() << "design " << seed << ", strength " << strengths[s]
                        << " of " << largest << ": " << miss;
        }
      }
    }
  }
  EXPECT_EQ(missed, 0);
}

// Cyclic coordinate descent (Friedman, Hastie and Tibshirani 2010) on centred
// columns of variance 1: slow, but with nothing that could go wrong.
VectorXd CoordinateDescent(const MatrixXd& x,
                           const VectorXd& w,
                           VectorXd residual,
                           double strength) {
  constexpr int kMostSweeps = 20'000;
  constexpr double kStill = 1e-14;
  VectorXd b = VectorXd::Zero(x.cols());
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    double largest = 0.0;
    for (Index j = 0; j < x.cols(); ++j) {
      if (x.col(j).isZero()) continue;
      const double along = x.col(j).dot(w.cwiseProduct(residual)) + b[j];
      const double shrunk = std::max(0.0, std::abs(along) - strength);
      const double next = std::copysign(shrunk, along);
      residual -= (next - b[j]) * x.col(j);
      largest = std::max(largest, std::abs(next - b[j]));
      b[j] = next;
    }
    if (largest < kStill) break;
  }
  return b;
}

// Of columns that nearly repeat each other the descent does not come to its
// end: it then is to be no lower.
TEST(PenalizedPath, LassoIsThatOfCoordinateDescent) {
  constexpr int kDesigns = 300;
  constexpr double kSlack = 1e-10;
  int ended = 0;
  for (std::uint64_t seed = 1; seed <= kDesigns; ++seed) {
    const Sample sample = MakeDependentSample(77 * seed);
    const PenalizedPath path(Penalty::kLasso, SumsOf(sample), true);
    const double strength = 0.1 * path.Grid().front();
    const VectorXd found = path.Solve({strength}).coefficients.col(0);
    MatrixXd x;
    VectorXd residual;
    VectorXd w;
    VectorXd spread;
    Standardise(
        sample, VectorXd::Zero(found.size()), &x, &residual, &w, &spread);
    const auto objective = [&](const VectorXd& b) {
      return 0.5 * w.dot((residual - x * b).cwiseAbs2()) +
             strength * b.lpNorm<1>();
    };
    const VectorXd b = CoordinateDescent(x, w, residual, strength);
    const VectorXd ours = found.cwiseProduct(spread);
    EXPECT_LT(objective(ours), objective(b) + kSlack) << "design " << seed;
    const VectorXd as_given =
        (spread.array() > 0.0).select(b.array() / spread.array(), 0.0);
    if (WorstCondition(sample, as_given, strength) > kSlack) continue;
    ++ended;
    EXPECT_NEAR(objective(ours), objective(b), kSlack) << "design " << seed;
    // Which of repeated columns has the coefficient is not determined; what
    // they predict is.
    EXPECT_LT(std::sqrt(w.dot((x * (ours - b)).cwiseAbs2())), 1e-8)
        << "design " << seed;
  }
  EXPECT_GT(ended, 4 * kDesigns / 5);
}

TEST(PenalizedPath, RidgeSolvesItsNormalEquations) {
  constexpr double kSlack = 1e-10;
  for (const auto& [rows, cols, weighted] :
       {std::tuple<Index, Index, bool>{40, 8, false},
        {40, 8, true},
        {20, 50, false},
        {20, 50, true}}) {
    const Sample sample = MakeSample(rows, cols, weighted, 30);
    const std::vector<double> strengths = {10.0, 0.1, 1e-4};
    for (const PenalizedPath& path : RidgesOf(sample, true)) {
      const auto solutions = path.Solve(strengths);
      for (Index s = 0; s < solutions.coefficients.cols(); ++s) {
        const double strength = strengths[static_cast<std::size_t>(s)];
        const VectorXd coefficients = solutions.coefficients.col(s);
        MatrixXd x;
        VectorXd residual;
        VectorXd w;
        VectorXd spread;
        Standardise(sample, coefficients, &x, &residual, &w, &spread);
        const VectorXd gradient = x.transpose() * w.cwiseProduct(residual) -
                                  strength * coefficients.cwiseProduct(spread);
        EXPECT_LT(gradient.cwiseAbs().maxCoeff(), kSlack);
      }
    }
  }
}

TEST(PenalizedPath, RidgeInTheSpaceOfTheRowsIsThatOfTheColumns) {
  constexpr double kSlack = 1e-9;  // of the largest
  const std::vector<double> strengths = {10.0, 0.1, 1e-3};
  for (const Index rows : {2, 7, 20}) {
    for (const bool weighted : {false, true}) {
      for (const bool intercept : {false, true}) {
        Sample sample = MakeSample(rows, 30, weighted, 60);
        sample.terms.col(2).setConstant(3.0);
        sample.terms.col(3).setZero();
        sample.terms.col(4) = sample.terms.col(5);
        const std::vector<PenalizedPath> paths = RidgesOf(sample, intercept);
        const auto columns = paths[0].Solve(strengths);
        const auto in_rows = paths[1].Solve(strengths);
        EXPECT_LT((in_rows.coefficients - columns.coefficients).norm(),
                  kSlack * columns.coefficients.norm());
        EXPECT_LT((in_rows.intercepts - columns.intercepts).norm(),
                  kSlack * (1.0 + columns.intercepts.norm()));
      }
    }
  }
}

TEST(PenalizedPath, RefinesARidgeOfColumnsNearDependence) {
  using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  constexpr double kStrength = 1e-9;
  for (const auto& [rows, cols, weighted] :
       {std::tuple<Index, Index, bool>{60, 8, false},
        {60, 8, true},
        {20, 30, true}}) {
    Sample sample = MakeSample(rows, cols, weighted, 70);
    for (Index j = 4; j < cols; ++j) {
      sample.terms.col(j) =
          sample.terms.col(j - 4) +
          1e-4 * UniformMatrix(rows, 1, 90 + static_cast<std::uint64_t>(j));
    }
    MatrixXd x;
    VectorXd residual;
    VectorXd w;
    VectorXd spread;
    Standardise(sample, VectorXd::Zero(cols), &x, &residual, &w, &spread);
    // Rows for the penalty below the others: no product of columns.
    LongMatrix stacked = LongMatrix::Zero(rows + cols, cols + 1);
    stacked.topLeftCorner(rows, cols) =
        (w.cwiseSqrt().asDiagonal() * x).cast<long double>();
    stacked.topRightCorner(rows, 1) =
        w.cwiseSqrt().cwiseProduct(residual).cast<long double>();
    stacked.bottomLeftCorner(cols, cols)
        .diagonal()
        .setConstant(std::sqrt(static_cast<long double>(kStrength)));
    const VectorXd expected = stacked.leftCols(cols)
                                  .householderQr()
                                  .solve(stacked.col(cols))
                                  .cast<double>()
                                  .cwiseQuotient(spread.cast<double>());
    for (const PenalizedPath& path : RidgesOf(sample, true)) {
      auto solution = path.Solve({kStrength});
      const auto error = [&] {
        return (solution.coefficients.col(0) - expected).norm() /
               expected.norm();
      };
      EXPECT_GT(error(), 1e-9);  // what there is to mend
      const VectorXd left =
          (sample.response - sample.terms * solution.coefficients.col(0))
              .array() -
          solution.intercepts[0];
      const VectorXd weights =
          weighted ? sample.weights : VectorXd(VectorXd::Ones(rows));
      const VectorXd weighed = left.cwiseProduct(weights);
      path.Refine(kStrength,
                  weighed.sum(),
                  sample.terms.transpose() * weighed,
                  &solution);
      EXPECT_LT(error(), 1e-10);
    }
  }
}

TEST(PenalizedPath, RefinesNothingWhereThePenaltyIsLostInRoundings) {
  Sample sample = MakeSample(60, 6, false, 70);
  sample.terms.col(4) = sample.terms.col(0);
  sample.terms.col(5) = sample.terms.col(1) + sample.terms.col(2);
  constexpr double kLost = 1e-30;
  const PenalizedPath path(Penalty::kRidge, SumsOf(sample), true);
  auto solution = path.Solve({kLost});
  const auto residual = [&] {
    return VectorXd(
        (sample.response - sample.terms * solution.coefficients.col(0))
            .array() -
        solution.intercepts[0]);
  };
  const VectorXd before = residual();
  path.Refine(
      kLost, before.sum(), sample.terms.transpose() * before, &solution);
  EXPECT_LT((residual() - before).norm(), 1e-6 * before.norm());
}

TEST(PenalizedPath, RidgeHasTheDegreesOfFreedomOfItsEigenvalues) {
  constexpr double kSlack = 1e-6;
  for (const auto& [rows, cols] :
       {std::pair<Index, Index>{40, 8}, {20, 50}, {60, 30}}) {
    Sample sample = MakeSample(rows, cols, true, 40);
    sample.terms.col(2).setConstant(3.0);
    MatrixXd x;
    VectorXd residual;
    VectorXd w;
    VectorXd spread;
    Standardise(sample, VectorXd::Zero(cols), &x, &residual, &w, &spread);
    const VectorXd squares =
        testing::SingularValues(w.cwiseSqrt().asDiagonal() * x).cwiseAbs2();
    for (const double strength : {10.0, 0.1, 1e-4, 1e-9}) {
      const double expected =
          1.0 + (squares.array() / (squares.array() + strength)).sum();
      for (const PenalizedPath& path : RidgesOf(sample, true)) {
        EXPECT_NEAR(path.DegreesOfFreedom(strength, VectorXd()),
                    expected,
                    kSlack * expected)
            << strength;
      }
    }
    // Without a penalty: a constant adds none, nor does a column that depends
    // on the others.
    const auto rank = static_cast<double>((squares.array() > kSlack).count());
    for (const PenalizedPath& path : RidgesOf(sample, true)) {
      EXPECT_EQ(path.DegreesOfFreedom(0.0, VectorXd()), 1.0 + rank);
    }
  }
}

TEST(PenalizedPath, NoPenaltyIsLeastSquares) {
  constexpr double kRelative = 1e-8;
  const Sample sample = MakeSample(60, 5, true, 40);
  MatrixXd design(60, 6);
  design << VectorXd::Ones(60), sample.terms;
  const VectorXd expected =
      SolveLeastSquares(design, sample.response, sample.weights).coefficients;
  for (const Penalty penalty : {Penalty::kRidge, Penalty::kLasso}) {
    const auto fit = PenalizedPath(penalty, SumsOf(sample), true).Solve({0.0});
    EXPECT_TRUE(fit.coefficients.col(0).isApprox(expected.tail(5), kRelative));
    EXPECT_NEAR(fit.intercepts[0],
                expected[0],
                100.0 * kRelative * std::abs(expected[0]));
  }
}

TEST(PenalizedPath, CopiesAndConstantsDoNoHarm) {
  Sample sample = MakeSample(30, 4, false, 50);
  sample.terms.col(2) = sample.terms.col(1);
  sample.terms.col(3).setConstant(3.0);
  for (const Penalty penalty : {Penalty::kRidge, Penalty::kLasso}) {
    const PenalizedPath path(penalty, SumsOf(sample), true);
    const VectorXd coefficients =
        path.Solve({0.01 * path.Grid().front()}).coefficients.col(0);
    EXPECT_TRUE(coefficients.allFinite());
    EXPECT_EQ(coefficients[3], 0.0);
  }
}

TEST(PenalizedPath, FoldsAreTakenAwayFromTheSumsOfAllRows) {
  constexpr double kRelative = 1e-10;
  const Sample sample = MakeSample(50, 6, true, 60);
  CrossProducts others =
      SumProducts(sample.terms, sample.response, sample.weights);
  others -= SumProducts(MatrixXd(sample.terms.topRows(10)),
                        sample.response.head(10),
                        sample.weights.head(10));
  const CrossProducts alone = SumProducts(MatrixXd(sample.terms.bottomRows(40)),
                                          sample.response.tail(40),
                                          sample.weights.tail(40));
  for (const Penalty penalty : {Penalty::kRidge, Penalty::kLasso}) {
    const std::vector<double> strengths = {0.1, 1e-3};
    const auto left =
        PenalizedPath(penalty, others, true).Solve(strengths).coefficients;
    const auto made =
        PenalizedPath(penalty, alone, true).Solve(strengths).coefficients;
    EXPECT_TRUE(left.isApprox(made, kRelative));
  }
}

TEST(PenalizedPath, HasTheInterceptAloneWithoutColumns) {
  const Sample sample = MakeSample(20, 2, false, 71);
  const CrossProducts sums = SumProducts(
      MatrixXd(sample.terms.rows(), 0), sample.response, sample.weights);
  for (const Penalty penalty : {Penalty::kRidge, Penalty::kLasso}) {
    const PenalizedPath path(penalty, sums, true);
    EXPECT_EQ(path.DegreesOfFreedom(1.0, VectorXd()), 1.0);
  }
}

TEST(PenalizedPath, GoesThroughZeroWithoutAnIntercept) {
  const Sample sample = MakeSample(40, 3, false, 70);
  const CrossProducts sums =
      SumProducts(sample.terms, sample.response, sample.weights);
  const PenalizedPath path(Penalty::kRidge, sums, false);
  const auto solutions = path.Solve({1e-12});
  EXPECT_EQ(solutions.intercepts[0], 0.0);
  const VectorXd expected =
      SolveLeastSquares(sample.terms, sample.response, {}).coefficients;
  EXPECT_TRUE(solutions.coefficients.col(0).isApprox(expected, 1e-6));
}

}  // namespace
}  // namespace errmap::fitting
