#include "fitting/least_squares/triangular_reduction.h"

#include <stdexcept>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "tests/decompositions.h"
#include "tests/fitting/regression_test_data.h"

namespace errmap::fitting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using errmap::testing::UniformMatrix;

MatrixXd Reduce(const MatrixXd& matrix, const ReductionOptions& options) {
  return ReduceToTriangle(
      matrix.rows(),
      matrix.cols(),
      [&](Index first, Eigen::Ref<MatrixXd> block) {
        block = matrix.middleRows(first, block.rows());
      },
      options);
}

TEST(TriangularReduction, KeepsTheProductsOfTheColumns) {
  constexpr double kRelative = 1e-13;
  const MatrixXd matrix = UniformMatrix(1003, 60, 1);
  for (const Index block : {1, 7, 100, 5000}) {
    for (const Index chains : {1, 3, 4}) {
      const MatrixXd triangle =
          Reduce(matrix, {.block_rows = block, .chains = chains});
      EXPECT_TRUE(triangle.isUpperTriangular(0.0));
      EXPECT_TRUE((triangle.transpose() * triangle)
                      .isApprox(matrix.transpose() * matrix, kRelative))
          << block << " rows a block, " << chains << " chains";
    }
  }
}

TEST(TriangularReduction, KeepsSingularValuesThatTheProductsWouldLose) {
  // A column that differs from another by 1e-10: squared, that is rounding.
  MatrixXd matrix = UniformMatrix(500, 3, 2);
  matrix.col(2) = matrix.col(0) + 1e-10 * matrix.col(2);
  const auto smallest = [](const MatrixXd& of) {
    return testing::SingularValues(of)[2];
  };
  EXPECT_NEAR(smallest(Reduce(matrix, {.block_rows = 50})) / smallest(matrix),
              1.0,
              1e-4);
}

TEST(TriangularReduction, ThreadsChangeNoBit) {
  const MatrixXd matrix = UniformMatrix(900, 20, 3);
  EXPECT_EQ(Reduce(matrix, {.block_rows = 64, .threads = 1}),
            Reduce(matrix, {.block_rows = 64, .threads = 4}));
}

TEST(TriangularReduction, FewerRowsThanColumnsLeaveZeroRows) {
  const MatrixXd matrix = UniformMatrix(4, 9, 4);
  const MatrixXd triangle = Reduce(matrix, {});
  EXPECT_TRUE((triangle.transpose() * triangle)
                  .isApprox(matrix.transpose() * matrix, 1e-13));
  EXPECT_TRUE(Reduce(MatrixXd(0, 3), {}).isZero());
}

TEST(TriangularReduction, RefusesBadSizes) {
  EXPECT_THROW(Reduce(MatrixXd(3, 0), {}), std::invalid_argument);
  EXPECT_THROW(Reduce(MatrixXd(3, 2), {.block_rows = 0}),
               std::invalid_argument);
}

}  // namespace
}  // namespace errmap::fitting
