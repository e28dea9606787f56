#include "fitting/matrix_product.h"

#include <cstdint>
#include <limits>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tests/random_matrix.h"

namespace errmap::fitting {
namespace {

using Eigen::Index;
using errmap::testing::RandomMatrix;

struct Size {
  Index m, k, n;
};

// Single numbers, vectors, and sides on either side of the widths of kernels.
const std::vector<Size> kSizes = {{1, 1, 1},
                                  {1, 7, 1},
                                  {5, 1, 9},
                                  {8, 38, 397},
                                  {33, 17, 65},
                                  {64, 38, 100},
                                  {64, 397, 38},
                                  {2, 1000, 3}};

template <typename Scalar>
using MatrixOf = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

template <typename Scalar>
class MatrixProduct : public ::testing::Test {
 protected:
  using Exact = MatrixOf<long double>;

  static MatrixOf<Scalar> Random(Index rows, Index cols, std::uint64_t seed) {
    return RandomMatrix(rows, cols, seed).cast<Scalar>();
  }

  // Sums of k products of numbers below 1 in any order.
  static void ExpectNear(const MatrixOf<Scalar>& found,
                         const Exact& expected,
                         Index k) {
    const auto bound = static_cast<long double>(k + 1) *
                       std::numeric_limits<Scalar>::epsilon();
    ASSERT_EQ(found.rows(), expected.rows());
    ASSERT_EQ(found.cols(), expected.cols());
    EXPECT_LE(
        (found.template cast<long double>() - expected).cwiseAbs().maxCoeff(),
        bound);
  }
};

using ProductScalars = ::testing::Types<double, float>;
TYPED_TEST_SUITE(MatrixProduct, ProductScalars);

TYPED_TEST(MatrixProduct, IsTheProduct) {
  using Matrix = MatrixOf<TypeParam>;
  for (const auto& [m, k, n] : kSizes) {
    SCOPED_TRACE(::testing::Message() << m << " x " << k << " x " << n);
    const Matrix a = this->Random(m, k, 1);
    const Matrix b = this->Random(k, n, 2);
    const Matrix transposed = b.transpose();
    const typename TestFixture::Exact expected =
        a.template cast<long double>() * b.template cast<long double>();
    // What stood there before has no part in it, not even NaN.
    Matrix c =
        Matrix::Constant(m, n, std::numeric_limits<TypeParam>::quiet_NaN());
    Multiply(a, b, c);
    this->ExpectNear(c, expected, k);
    c.setConstant(std::numeric_limits<TypeParam>::quiet_NaN());
    MultiplyTransposed(a, transposed, c);
    this->ExpectNear(c, expected, k);
  }
}

TYPED_TEST(MatrixProduct, AddsWhereAsked) {
  using Matrix = MatrixOf<TypeParam>;
  for (const auto& [m, k, n] : kSizes) {
    SCOPED_TRACE(::testing::Message() << m << " x " << k << " x " << n);
    const Matrix a = this->Random(m, k, 1);
    const Matrix b = this->Random(k, n, 2);
    const Matrix before = this->Random(m, n, 3);
    const typename TestFixture::Exact expected =
        before.template cast<long double>() +
        a.template cast<long double>() * b.template cast<long double>();
    Matrix c = before;
    Multiply(a, b, c, true);
    this->ExpectNear(c, expected, k);
    c = before;
    MultiplyTransposed(a, b.transpose().eval(), c, true);
    this->ExpectNear(c, expected, k);
  }
}

TYPED_TEST(MatrixProduct, TakesBlocksWhereTheyStandAndLeavesTheRest) {
  using Matrix = MatrixOf<TypeParam>;
  const auto [m, k, n] = Size{13, 9, 21};
  const Matrix a = this->Random(m + 5, k + 4, 1);
  const Matrix b = this->Random(k + 3, n + 2, 2);
  const Matrix b_transposed = b.transpose();
  const Matrix before = this->Random(m + 4, n + 6, 3);
  const auto a_block = a.block(2, 3, m, k);
  const auto b_block = b.block(1, 1, k, n);
  const typename TestFixture::Exact product =
      a_block.template cast<long double>() *
      b_block.template cast<long double>();
  const auto expect = [&](const Matrix& c) {
    this->ExpectNear(c.block(3, 4, m, n), product, k);
    Matrix rest = c;
    rest.block(3, 4, m, n) = before.block(3, 4, m, n);
    EXPECT_EQ(rest, before);
  };
  Matrix c = before;
  Multiply(a_block, b_block, c.block(3, 4, m, n));
  expect(c);
  c = before;
  MultiplyTransposed(
      a_block, b_transposed.block(1, 1, n, k), c.block(3, 4, m, n));
  expect(c);
}

TYPED_TEST(MatrixProduct, GivesTheSameBitsBesideAnyNumberOfOthers) {
  using Matrix = MatrixOf<TypeParam>;
  constexpr int kThreads = 8;
  constexpr int kRounds = 20;
  const Matrix a = this->Random(64, 397, 1);
  const Matrix b = this->Random(397, 38, 2);
  const Matrix transposed = b.transpose();
  Matrix alone(64, 38);
  Multiply(a, b, alone);
  Matrix alone_transposed(64, 38);
  MultiplyTransposed(a, transposed, alone_transposed);
  std::vector<int> differing(kThreads, 0);
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&, t] {
      Matrix c(64, 38);
      for (int round = 0; round < kRounds; ++round) {
        Multiply(a, b, c);
        if (c != alone) ++differing[static_cast<std::size_t>(t)];
        MultiplyTransposed(a, transposed, c);
        if (c != alone_transposed) ++differing[static_cast<std::size_t>(t)];
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(differing, std::vector<int>(kThreads, 0));
}

TEST(MultiplyByOwnTranspose, FillsTheLowerTriangleOnly) {
  constexpr double kAbove = 7.0;
  for (const Size& size : kSizes) {
    const Eigen::MatrixXd a = RandomMatrix(size.m, size.k, 1);
    // Sums of k squares below 1: k roundings of up to k.
    const double bound = static_cast<double>((size.k + 1) * (size.k + 1)) *
                         std::numeric_limits<double>::epsilon();
    Eigen::MatrixXd c = Eigen::MatrixXd::Constant(size.m, size.m, kAbove);
    MultiplyByOwnTranspose(a, c);
    Eigen::MatrixXd twice = c;
    MultiplyByOwnTranspose(a, twice, true);
    const Eigen::MatrixXd transposed = a.transpose();
    Eigen::MatrixXd turned = Eigen::MatrixXd::Constant(size.m, size.m, kAbove);
    MultiplyOwnTransposeBy(transposed, turned);
    Eigen::MatrixXd turned_twice = turned;
    MultiplyOwnTransposeBy(transposed, turned_twice, true);
    const Eigen::MatrixXd expected = a * a.transpose();
    for (Index j = 0; j < size.m; ++j) {
      for (Index i = 0; i < size.m; ++i) {
        EXPECT_NEAR(c(i, j), i < j ? kAbove : expected(i, j), bound);
        EXPECT_NEAR(
            twice(i, j), i < j ? kAbove : 2.0 * expected(i, j), 2.0 * bound);
        EXPECT_NEAR(turned(i, j), c(i, j), bound);
        EXPECT_NEAR(turned_twice(i, j), twice(i, j), 2.0 * bound);
      }
    }
  }
}

TEST(FactorizeCholesky, SolvesByTheLowerTriangleAlone) {
  constexpr double kTolerance = 1e-11;
  for (const Index size : {1, 2, 7, 64, 150}) {
    const Eigen::MatrixXd a = RandomMatrix(size, size, 1);
    const Eigen::MatrixXd matrix =
        a * a.transpose() + Eigen::MatrixXd::Identity(size, size);
    const Eigen::VectorXd x = RandomMatrix(size, 1, 2);
    Eigen::MatrixXd factor = matrix;
    factor.triangularView<Eigen::StrictlyUpper>().setConstant(
        std::numeric_limits<double>::quiet_NaN());
    ASSERT_TRUE(FactorizeCholesky(factor));
    Eigen::VectorXd solved = matrix * x;
    SolveCholesky(factor, &solved);
    EXPECT_LT((solved - x).norm(), kTolerance * x.norm());
  }
}

TEST(FactorizeCholesky, SaysThatAMatrixIsNotPositiveDefinite) {
  Eigen::MatrixXd indefinite{{1.0, 0.0}, {2.0, 1.0}};
  EXPECT_FALSE(FactorizeCholesky(indefinite));
  Eigen::MatrixXd singular{{1.0, 0.0}, {1.0, 1.0}};
  EXPECT_FALSE(FactorizeCholesky(singular));
}

}  // namespace
}  // namespace errmap::fitting
