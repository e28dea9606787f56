#include "fitting/least_squares/linear_least_squares.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stats/random.h"
#include "tests/random_matrix.h"

namespace errmap::fitting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using errmap::testing::RandomMatrix;
using errmap::testing::RandomVector;
using stats::DoubleDouble;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

// Well-conditioned systems of some ten rows: a few roundings.
constexpr double kRounding = 1e-13;

// Powers 0 .. degree of x, as NIST's polynomial problems are written.
MatrixXd Powers(const VectorXd& x, Index degree) {
  MatrixXd design(x.size(), degree + 1);
  design.col(0).setOnes();
  for (Index j = 1; j <= degree; ++j) {
    design.col(j) = design.col(j - 1).cwiseProduct(x);
  }
  return design;
}

// -log10 of the largest relative error: NIST's log relative error.
double AgreeingDigits(const VectorXd& found, const VectorXd& certified) {
  const double worst =
      ((found - certified).array() / certified.array()).abs().maxCoeff();
  return worst > 0.0 ? -std::log10(worst) : 15.0;
}

void ExpectRefused(const MatrixXd& design,
                   const VectorXd& response,
                   const VectorXd& weights,
                   const std::string& message) {
  EXPECT_THAT([&] { SolveLeastSquares(design, response, weights); },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("SolveLeastSquares: " + message)));
}

TEST(LinearLeastSquares, SolvesASquareSystemExactly) {
  const MatrixXd design{{2.0, 1.0}, {1.0, 3.0}};
  const LeastSquaresFit fit = SolveLeastSquares(design, VectorXd{{5.0, 10.0}});
  EXPECT_NEAR(fit.coefficients[0], 1.0, kRounding);
  EXPECT_NEAR(fit.coefficients[1], 3.0, kRounding);
  EXPECT_EQ(fit.rank, 2);
  EXPECT_THAT(fit.aliased, IsEmpty());
  EXPECT_NEAR(fit.residual_sum_of_squares, 0.0, kRounding * kRounding);
}

TEST(LinearLeastSquares, FitsALineThroughPointsOffIt) {
  // By hand: through (0, 0), (1, 1), (2, 1): y = 1/6 + x / 2, RSS 1/6.
  const MatrixXd design{{1.0, 0.0}, {1.0, 1.0}, {1.0, 2.0}};
  const LeastSquaresFit fit =
      SolveLeastSquares(design, VectorXd{{0.0, 1.0, 1.0}});
  EXPECT_NEAR(fit.coefficients[0], 1.0 / 6.0, kRounding);
  EXPECT_NEAR(fit.coefficients[1], 0.5, kRounding);
  EXPECT_NEAR(fit.residual_sum_of_squares, 1.0 / 6.0, kRounding);
}

TEST(LinearLeastSquares, SolvesOneRowOfOneColumn) {
  const LeastSquaresFit fit =
      SolveLeastSquares(MatrixXd{{4.0}}, VectorXd{{2.0}});
  EXPECT_DOUBLE_EQ(fit.coefficients[0], 0.5);
  EXPECT_EQ(fit.rank, 1);
  EXPECT_DOUBLE_EQ(fit.condition, 1.0);
}

TEST(LinearLeastSquares, LeavesResidualsAtRightAnglesToEveryColumn) {
  const MatrixXd design = RandomMatrix(40, 6, 1);
  const VectorXd response = RandomVector(40, 2);
  const LeastSquaresFit fit = SolveLeastSquares(design, response);
  const VectorXd residuals = response - design * fit.coefficients;
  EXPECT_LT((design.transpose() * residuals).cwiseAbs().maxCoeff(), kRounding);
  EXPECT_NEAR(fit.residual_sum_of_squares, residuals.squaredNorm(), kRounding);
}

TEST(LinearLeastSquares, WholeWeightsEqualRepeatedRows) {
  const MatrixXd design = RandomMatrix(8, 3, 3);
  const VectorXd response = RandomVector(8, 4);
  const VectorXd weights{{1.0, 3.0, 2.0, 1.0, 0.0, 5.0, 1.0, 2.0}};
  const Index total = static_cast<Index>(weights.sum());
  MatrixXd repeated(total, 3);
  VectorXd repeated_response(total);
  Index next = 0;
  for (Index row = 0; row < 8; ++row) {
    for (double w = 0.0; w < weights[row]; w += 1.0, ++next) {
      repeated.row(next) = design.row(row);
      repeated_response[next] = response[row];
    }
  }
  const LeastSquaresFit weighted = SolveLeastSquares(design, response, weights);
  const LeastSquaresFit plain = SolveLeastSquares(repeated, repeated_response);
  EXPECT_LT((weighted.coefficients - plain.coefficients).norm(), kRounding);
  EXPECT_NEAR(weighted.residual_sum_of_squares,
              plain.residual_sum_of_squares,
              kRounding);
}

TEST(LinearLeastSquares, EqualWeightsChangeNoCoefficient) {
  constexpr double kWeight = 7.0;
  const MatrixXd design = RandomMatrix(12, 4, 5);
  const VectorXd response = RandomVector(12, 6);
  const LeastSquaresFit plain = SolveLeastSquares(design, response);
  const LeastSquaresFit weighted =
      SolveLeastSquares(design, response, VectorXd::Constant(12, kWeight));
  EXPECT_LT((weighted.coefficients - plain.coefficients).norm(), kRounding);
  EXPECT_NEAR(weighted.residual_sum_of_squares,
              kWeight * plain.residual_sum_of_squares,
              kWeight * kRounding);
}

TEST(LinearLeastSquares, RowOrderAndColumnScaleDoNotMatter) {
  const MatrixXd design = RandomMatrix(20, 4, 7);
  const VectorXd response = RandomVector(20, 8);
  const LeastSquaresFit plain = SolveLeastSquares(design, response);
  const LeastSquaresFit reversed =
      SolveLeastSquares(design.colwise().reverse(), response.reverse());
  EXPECT_LT((reversed.coefficients - plain.coefficients).norm(), kRounding);
  // Powers of two from 2^-400 to 2^400: the squares would over- and underflow.
  VectorXd scales(4);
  scales << 0x1.0p400, 1.0, 0x1.0p-400, 0x1.0p-30;
  const LeastSquaresFit scaled =
      SolveLeastSquares(design * scales.asDiagonal(), response);
  EXPECT_EQ(scaled.rank, 4);
  EXPECT_LT(
      (scaled.coefficients.cwiseProduct(scales) - plain.coefficients).norm(),
      kRounding);
  EXPECT_NEAR(scaled.condition, plain.condition, kRounding * plain.condition);
}

TEST(LinearLeastSquares, NamesAColumnThatTheOthersDetermine) {
  MatrixXd design = RandomMatrix(15, 4, 9);
  design.col(2) = 2.0 * design.col(0) - 0.5 * design.col(3);
  const VectorXd response = RandomVector(15, 10);
  const LeastSquaresFit fit = SolveLeastSquares(design, response);
  EXPECT_EQ(fit.rank, 3);
  ASSERT_EQ(fit.aliased.size(), 1U);
  // The last of the three that depend on each other.
  EXPECT_EQ(fit.aliased[0], 3);
  EXPECT_EQ(fit.coefficients[fit.aliased[0]], 0.0);
  const LeastSquaresFit without = SolveLeastSquares(
      MatrixXd{design(Eigen::all, std::vector<Index>{0, 1, 2})}, response);
  EXPECT_NEAR(
      fit.residual_sum_of_squares, without.residual_sum_of_squares, kRounding);
}

TEST(LinearLeastSquares, NamesACopyAndAColumnOfZeros) {
  MatrixXd design = RandomMatrix(10, 4, 11);
  design.col(1).setZero();
  design.col(3) = design.col(0);
  const LeastSquaresFit fit = SolveLeastSquares(design, RandomVector(10, 12));
  EXPECT_EQ(fit.rank, 2);
  ASSERT_EQ(fit.aliased.size(), 2U);
  EXPECT_TRUE(std::is_sorted(fit.aliased.begin(), fit.aliased.end()));
  EXPECT_THAT(fit.aliased, ElementsAre(1, 3));
  for (const Index column : fit.aliased) {
    EXPECT_EQ(fit.coefficients[column], 0.0);
  }
}

// Coefficients that are set to 0 must be those of the problem without their
// columns: a solution with all pivots divides by what rounding left of them.
TEST(LinearLeastSquares, DependentColumnsChangeNoFit) {
  constexpr double kSame = 1e-11;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    stats::Random random(seed);
    const auto below = [&](std::uint64_t bound) {
      return static_cast<Index>(random.Below(bound));
    };
    const Index rows = 12 + below(60);
    const Index free = 1 + below(6);
    const Index dependent = 1 + below(5);
    const MatrixXd base = RandomMatrix(rows, free, 1000 + seed);
    const MatrixXd mixed = base * RandomMatrix(free, dependent, 2000 + seed);
    MatrixXd design(rows, free + dependent);
    design << base, mixed;
    for (Index j = 0; j < design.cols(); ++j) {
      design.col(j) *= std::pow(10.0, static_cast<double>(below(13)) - 6.0);
    }
    const VectorXd response = RandomVector(rows, 3000 + seed);
    const LeastSquaresFit fit = SolveLeastSquares(design, response);
    const LeastSquaresFit without = SolveLeastSquares(base, response);
    ASSERT_EQ(fit.rank, free) << seed;
    ASSERT_EQ(fit.aliased.size(), static_cast<std::size_t>(dependent));
    EXPECT_EQ(fit.aliased.front(), free) << seed;
    EXPECT_THAT(fit.nearly_aliased, IsEmpty());
    EXPECT_LT((design * fit.coefficients - base * without.coefficients)
                  .cwiseAbs()
                  .maxCoeff(),
              kSame)
        << seed;
    EXPECT_NEAR(
        fit.residual_sum_of_squares, without.residual_sum_of_squares, kSame);
    const MatrixXd basis = OrthonormalColumns(design);
    ASSERT_EQ(basis.cols(), free);
    EXPECT_LT(
        (basis.transpose() * basis - MatrixXd::Identity(free, free)).norm(),
        kSame);
    EXPECT_LT((design - basis * (basis.transpose() * design)).norm(),
              kSame * design.norm());
  }
}

// A column that R's lm would drop is kept where 106 bits tell it apart, and
// then they give the solution.
TEST(LinearLeastSquares, KeepsWhatOnly106BitsTellApart) {
  constexpr double kApart = 1e-10;
  const VectorXd z = RandomVector(30, 21);
  MatrixXd design(30, 3);
  design.col(0).setOnes();
  design.col(1) = 1.0 + kApart * z.array();
  design.col(2) = RandomVector(30, 22);
  const LeastSquaresFit fit =
      SolveLeastSquares(design, design * VectorXd{{1.0, 2.0, 3.0}});
  EXPECT_EQ(fit.rank, 3);
  EXPECT_THAT(fit.aliased, IsEmpty());
  EXPECT_THAT(fit.nearly_aliased, ElementsAre(1));
  EXPECT_EQ(fit.bits, 106);
  EXPECT_GT(fit.condition, 1e9);
  // The response is rounded, which the condition makes the more of.
  EXPECT_NEAR(fit.coefficients[0] + fit.coefficients[1], 3.0, 1e-12);
  EXPECT_NEAR(fit.coefficients[1], 2.0, 1e-4);
  EXPECT_NEAR(fit.coefficients[2], 3.0, 1e-12);
  // What rounding may leave is not a column.
  LeastSquaresOptions options;
  options.noise = [&](const VectorXd& combination) {
    return kApart * combination.norm();
  };
  EXPECT_THAT(SolveLeastSquares(design, design.col(2), {}, options).aliased,
              ElementsAre(1));
}

// Wampler's polynomial with its x in tenths, decimals that doubles round.
struct Tenths {
  VectorXd x = VectorXd::LinSpaced(21, 0.0, 2.0);
  ExtendedSystem exact;
  LeastSquaresOptions options{.digits = 13.0};
  // Residuals as large as Wampler5's, at right angles to all columns.
  explicit Tenths(double scatter) {
    ExtendedVector tenths(21);
    ExtendedVector differences(21);
    DoubleDouble binomial = 1.0;
    for (Index i = 0; i < 21; ++i) {
      tenths[i] = stats::DoubleDouble(static_cast<double>(i)) / 10.0;
      differences[i] = i % 2 == 0 ? binomial : -binomial;
      binomial =
          binomial * static_cast<double>(20 - i) / static_cast<double>(i + 1);
    }
    exact.design = ExtendedMatrix::Constant(21, 6, 1.0);
    for (Index k = 1; k < 6; ++k) {
      exact.design.col(k) = exact.design.col(k - 1).cwiseProduct(tenths);
    }
    exact.response = exact.design * ExtendedVector::Constant(6, 1.0);
    for (Index i = 0; i < 21; ++i) {
      exact.response[i] += scatter * differences[i];
    }
    options.exact = [this] { return exact; };
  }
};

TEST(LinearLeastSquares, GivesTheDigitsAskedForFromTheExactNumbers) {
  for (const double scatter : {0.0, 1.0}) {
    Tenths tenths(scatter);
    const MatrixXd design = Powers(tenths.x, 5);
    const VectorXd response = tenths.exact.response.cast<double>();
    const LeastSquaresFit plain = SolveLeastSquares(design, response);
    const LeastSquaresFit fit =
        SolveLeastSquares(design, response, {}, tenths.options);
    EXPECT_GE(AgreeingDigits(fit.coefficients, VectorXd::Ones(6)), 15.0);
    EXPECT_LT(AgreeingDigits(plain.coefficients, VectorXd::Ones(6)), 14.0);
    EXPECT_EQ(fit.bits, 106);
    EXPECT_EQ(plain.bits, 53);
  }
}

// Whether they are read or not, coefficients have the same bits.
TEST(LinearLeastSquares, GivesDeviationsWithoutChangingTheSolution) {
  Tenths tenths(1.0);
  const MatrixXd design = Powers(tenths.x, 5);
  const VectorXd response = tenths.exact.response.cast<double>();
  const LeastSquaresFit fit =
      SolveLeastSquares(design, response, {}, tenths.options);
  EXPECT_EQ(fit.standard_deviations.size(), 0);
  tenths.options.with_deviations = true;
  const LeastSquaresFit read =
      SolveLeastSquares(design, response, {}, tenths.options);
  EXPECT_EQ(read.standard_deviations.size(), 6);
  EXPECT_EQ(read.coefficients, fit.coefficients);
  EXPECT_EQ(read.residual_sum_of_squares, fit.residual_sum_of_squares);
}

TEST(LinearLeastSquares, StaysInDoubleWhereTheConditionLeavesTheDigits) {
  LeastSquaresOptions options{.digits = 13.0, .with_deviations = true};
  options.exact = []() -> ExtendedSystem {
    throw std::logic_error("not needed");
  };
  const LeastSquaresFit fit = SolveLeastSquares(
      RandomMatrix(30, 5, 15), RandomVector(30, 16), {}, options);
  EXPECT_EQ(fit.bits, 53);
  EXPECT_EQ(fit.standard_deviations.size(), 0);
}

// Refined or solved in 106 bits throughout: the same to the last digit or two.
TEST(LinearLeastSquares, RefinesToTheSolutionIn106Bits) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    MatrixXd design = RandomMatrix(40, 6, 100 + seed);
    // Each column follows from that before it to 1e-2 or 1e-3.
    for (Index j = 1; j < 6; ++j) {
      design.col(j) =
          design.col(j - 1) + (seed % 2 == 0 ? 0.01 : 0.001) * design.col(j);
    }
    const VectorXd response = RandomVector(40, 200 + seed);
    const LeastSquaresFit fit =
        SolveLeastSquares(design, response, {}, {.digits = 13.0});
    const ExtendedLeastSquaresFit solved = SolveExtendedLeastSquares(
        design.cast<DoubleDouble>(), response.cast<DoubleDouble>());
    ASSERT_EQ(fit.bits, 106) << fit.condition;
    for (Index j = 0; j < 6; ++j) {
      EXPECT_NEAR(fit.coefficients[j] / solved.coefficients[j].hi, 1.0, 1e-15);
    }
    EXPECT_NEAR(fit.residual_sum_of_squares / solved.residual_sum_of_squares.hi,
                1.0,
                1e-15);
  }
}

TEST(LinearLeastSquares, NothingButZerosHasRankZero) {
  const LeastSquaresFit fit =
      SolveLeastSquares(MatrixXd::Zero(3, 2), VectorXd{{1.0, 2.0, 2.0}});
  EXPECT_EQ(fit.rank, 0);
  EXPECT_THAT(fit.aliased, ElementsAre(0, 1));
  EXPECT_EQ(fit.coefficients, VectorXd::Zero(2));
  EXPECT_DOUBLE_EQ(fit.residual_sum_of_squares, 9.0);
  const LeastSquaresFit weightless = SolveLeastSquares(
      MatrixXd::Ones(3, 1), VectorXd::Ones(3), VectorXd::Zero(3));
  EXPECT_EQ(weightless.rank, 0);
  EXPECT_EQ(weightless.residual_sum_of_squares, 0.0);
}

TEST(LinearLeastSquares, FewerRowsThanColumnsFitExactlyWithRankOfTheRows) {
  const MatrixXd design = RandomMatrix(3, 5, 13);
  const VectorXd response = RandomVector(3, 14);
  const LeastSquaresFit fit = SolveLeastSquares(design, response);
  EXPECT_EQ(fit.rank, 3);
  EXPECT_EQ(fit.aliased.size(), 2U);
  EXPECT_LT((design * fit.coefficients - response).norm(), kRounding);
  EXPECT_NEAR(fit.residual_sum_of_squares, 0.0, kRounding);
  for (const Index column : fit.aliased) {
    EXPECT_EQ(fit.coefficients[column], 0.0);
  }
}

TEST(LinearLeastSquares, ConditionBoundsTheTrueOneFromBelow) {
  // Columns at an angle a: singular values sqrt(1 +- cos a).
  for (const double angle : {1.5, 0.1, 1e-3, 1e-6}) {
    const MatrixXd design{{1.0, std::cos(angle)}, {0.0, std::sin(angle)}};
    const double condition = 1.0 / std::tan(0.5 * angle);
    const double found = SolveLeastSquares(design, VectorXd::Ones(2)).condition;
    EXPECT_LE(found, condition * (1.0 + 1e-9)) << angle;
    EXPECT_GE(found, 0.4 * condition) << angle;
  }
}

// NIST StRD, linear regression (www.itl.nist.gov/div898/strd): x = 0 .. 20;
// Wampler1: y = sum x^j, all six coefficients 1; Wampler2: y = sum (x / 10)^j,
// coefficients 10^-j; both fit exactly, RSS 0.
TEST(LinearLeastSquares, SolvesTheExactWamplerPolynomials) {
  constexpr double kDigits = 9.0;      // condition about 1e5 when scaled
  constexpr double kDigitsOfTwo = 11;  // its y are rounded, but smaller
  const VectorXd x = VectorXd::LinSpaced(21, 0.0, 20.0);
  const MatrixXd design = Powers(x, 5);
  const VectorXd ones = VectorXd::Ones(6);
  const LeastSquaresFit first = SolveLeastSquares(design, design * ones);
  EXPECT_EQ(first.rank, 6);
  EXPECT_GE(AgreeingDigits(first.coefficients, ones), kDigits);
  EXPECT_LT(std::sqrt(first.residual_sum_of_squares / 15.0), 1e-8);

  VectorXd tenths(6);
  for (Index j = 0; j < 6; ++j) {
    tenths[j] = std::pow(10.0, -static_cast<double>(j));
  }
  const LeastSquaresFit second = SolveLeastSquares(design, design * tenths);
  EXPECT_GE(AgreeingDigits(second.coefficients, tenths), kDigitsOfTwo);
}

// NIST StRD NoInt1: y = 130 .. 140 on x = 60 .. 70 through the origin;
// certified 2.07438016528926, RSS 127.272727272727. NoInt2: (4, 3), (5, 4),
// (6, 4); certified 0.727272727272727, RSS 0.272727272727273. Both follow
// exactly from sum xy / sum xx in fractions.
TEST(LinearLeastSquares, SolvesTheRegressionsThroughTheOrigin) {
  constexpr double kLastCertifiedDigit = 5e-15;
  const VectorXd x = VectorXd::LinSpaced(11, 60.0, 70.0);
  const VectorXd y = x.array() + 70.0;
  const LeastSquaresFit first = SolveLeastSquares(x, y);
  EXPECT_NEAR(first.coefficients[0], 2.07438016528926, kLastCertifiedDigit);
  EXPECT_NEAR(first.residual_sum_of_squares, 127.272727272727, 1e-12);
  const LeastSquaresFit second =
      SolveLeastSquares(VectorXd{{4.0, 5.0, 6.0}}, VectorXd{{3.0, 4.0, 4.0}});
  EXPECT_NEAR(second.coefficients[0], 0.727272727272727, kLastCertifiedDigit);
  EXPECT_NEAR(second.residual_sum_of_squares, 0.272727272727273, 1e-14);
}

TEST(LinearLeastSquares, RefusesAnEmptyDesign) {
  ExpectRefused(MatrixXd(0, 2), VectorXd(), {}, "empty design matrix (0 x 2)");
  ExpectRefused(
      MatrixXd(2, 0), VectorXd::Zero(2), {}, "empty design matrix (2 x 0)");
}

TEST(LinearLeastSquares, RefusesShapesThatDoNotAgree) {
  ExpectRefused(MatrixXd::Ones(3, 2),
                VectorXd::Ones(4),
                {},
                "design has 3 rows, response 4, weights 0");
  ExpectRefused(MatrixXd::Ones(3, 2),
                VectorXd::Ones(3),
                VectorXd::Ones(2),
                "design has 3 rows, response 3, weights 2");
}

TEST(LinearLeastSquares, RefusesValuesThatAreNotFinite) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    MatrixXd design = MatrixXd::Ones(3, 2);
    VectorXd ones = VectorXd::Ones(3);
    VectorXd spoilt = ones;
    spoilt[1] = bad;
    design(2, 1) = bad;
    ExpectRefused(design, ones, {}, "values must be finite");
    ExpectRefused(MatrixXd::Ones(3, 2), spoilt, {}, "values must be finite");
    ExpectRefused(MatrixXd::Ones(3, 2), ones, spoilt, "values must be finite");
  }
}

TEST(LeastSquaresOptions, RefuseEachValueOutOfRange) {
  const auto refuse = [](LeastSquaresOptions options,
                         const std::string& message) {
    EXPECT_THAT([&] { options.Validate(); },
                ThrowsMessage<std::invalid_argument>(HasSubstr(message)));
  };
  LeastSquaresOptions().Validate();
  refuse({.digits = 16.0}, "digits must be 0 to 15");
}

TEST(LinearLeastSquares, RefusesNegativeWeights) {
  ExpectRefused(MatrixXd::Ones(2, 1),
                VectorXd::Ones(2),
                VectorXd{{1.0, -1e-9}},
                "weights must not be negative");
}

}  // namespace
}  // namespace errmap::fitting
