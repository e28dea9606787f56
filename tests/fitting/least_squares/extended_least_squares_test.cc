#include "fitting/least_squares/extended_least_squares.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace errmap::fitting {
namespace {

using stats::DoubleDouble;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// x of 9.0, 9.05 ... 10: powers to the tenth are as good as dependent.
ExtendedVector NarrowGrid(Eigen::Index n) {
  ExtendedVector x(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    x[i] = DoubleDouble(9.0) +
           DoubleDouble(static_cast<double>(i)) / static_cast<double>(n - 1);
  }
  return x;
}

// 1, x, ..., x^degree, formed in 106 bits.
ExtendedMatrix PowersDesign(const ExtendedVector& x, int degree) {
  ExtendedMatrix design(x.size(), degree + 1);
  design.col(0).setConstant(1.0);
  for (int k = 1; k <= degree; ++k) {
    design.col(k) = design.col(k - 1).cwiseProduct(x);
  }
  return design;
}

TEST(ExtendedLeastSquares, RecoversAPolynomialThatDoublesCannot) {
  constexpr int kDegree = 10;
  const ExtendedMatrix design = PowersDesign(NarrowGrid(41), kDegree);
  const ExtendedVector response =
      design * ExtendedVector::Constant(kDegree + 1, 1.0);
  const ExtendedLeastSquaresFit fit =
      SolveExtendedLeastSquares(design, response);
  EXPECT_TRUE(fit.full_rank);
  EXPECT_GT(fit.condition, 1e13);
  // 106 bits are 32 digits, of which the condition eats about 25.
  constexpr double kLeft = 1e-6;
  for (const DoubleDouble& b : fit.coefficients) EXPECT_NEAR(b.hi, 1.0, kLeft);
}

TEST(ExtendedLeastSquares, GivesWhatNistCertifies) {
  ExtendedMatrix design(3, 1);
  design << 4.0, 5.0, 6.0;
  ExtendedVector response(3);
  response << 3.0, 4.0, 4.0;
  const ExtendedLeastSquaresFit fit =
      SolveExtendedLeastSquares(design, response);
  EXPECT_DOUBLE_EQ(fit.condition, 1.0);
  EXPECT_EQ(fit.degrees_of_freedom, 2);
  // NIST's NoInt2.
  EXPECT_NEAR(fit.coefficients[0].hi, 0.727272727272727, 1e-15);
  EXPECT_NEAR(fit.standard_deviations[0].hi, 0.0420827318078432, 1e-15);
  EXPECT_NEAR(fit.residual_sum_of_squares.hi, 0.272727272727273, 1e-15);
}

TEST(ExtendedLeastSquares, ScaleOfAColumnChangesNothingElse) {
  ExtendedMatrix design = PowersDesign(NarrowGrid(9), 2);
  ExtendedVector response(9);
  for (Eigen::Index i = 0; i < 9; ++i) response[i] = static_cast<double>(i * i);
  const ExtendedLeastSquaresFit fit =
      SolveExtendedLeastSquares(design, response);
  constexpr double kScale = 1e-12;
  for (DoubleDouble& value : design.col(1)) value *= kScale;
  const ExtendedLeastSquaresFit scaled =
      SolveExtendedLeastSquares(design, response);
  EXPECT_NEAR(scaled.condition, fit.condition, 1e-9 * fit.condition);
  EXPECT_NEAR(scaled.coefficients[1].hi * kScale,
              fit.coefficients[1].hi,
              1e-12 * std::abs(fit.coefficients[1].hi));
}

TEST(ExtendedLeastSquares, SaysThatColumnsDependOnEachOther) {
  ExtendedMatrix design(4, 2);
  design << 1.0, 2.0, 2.0, 4.0, 3.0, 6.0, 4.0, 8.0;
  const ExtendedLeastSquaresFit fit =
      SolveExtendedLeastSquares(design, ExtendedVector::Constant(4, 1.0));
  EXPECT_FALSE(fit.full_rank);
  ExtendedMatrix zero = design;
  zero.col(1).setZero();
  EXPECT_FALSE(SolveExtendedLeastSquares(zero, ExtendedVector::Constant(4, 1.0))
                   .full_rank);
}

TEST(ExtendedLeastSquares, HasNoDeviationsWithoutDegreesOfFreedom) {
  const ExtendedMatrix design = PowersDesign(NarrowGrid(2), 1);
  const ExtendedLeastSquaresFit fit =
      SolveExtendedLeastSquares(design, ExtendedVector::Constant(2, 3.0));
  EXPECT_NEAR(fit.coefficients[0].hi, 3.0, 1e-15);
  EXPECT_TRUE(std::isnan(fit.standard_deviations[0].hi));
}

TEST(ExtendedLeastSquares, RefusesWhatHasNoAnswer) {
  const ExtendedMatrix design = PowersDesign(NarrowGrid(3), 3);
  EXPECT_THAT(
      [&] {
        SolveExtendedLeastSquares(design, ExtendedVector::Constant(3, 1.0));
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("design is 3 x 4")));
  ExtendedVector response = ExtendedVector::Constant(3, 1.0);
  response[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT([&] { SolveExtendedLeastSquares(design.leftCols(1), response); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("finite")));
}

}  // namespace
}  // namespace errmap::fitting
