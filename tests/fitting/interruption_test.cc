#include "fitting/interruption.h"

#include <atomic>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "fitting/least_squares/linear_least_squares.h"
#include "fitting/least_squares/triangular_reduction.h"
#include "fitting/parallel_for.h"
#include "tests/random_matrix.h"

namespace errmap::fitting {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(Interruption, IsThrownWhereTheTokenIsSetAndNowhereElse) {
  std::atomic<bool> stop{true};
  EXPECT_NO_THROW(ThrowIfInterrupted());
  {
    const InterruptionScope scope(&stop);
    EXPECT_THROW(ThrowIfInterrupted(), Interrupted);
    stop = false;
    EXPECT_NO_THROW(ThrowIfInterrupted());
    stop = true;
  }
  EXPECT_NO_THROW(ThrowIfInterrupted());
}

TEST(Interruption, ScopesLieInEachOther) {
  const std::atomic<bool> stop{true};
  const std::atomic<bool> go_on{false};
  const InterruptionScope outer(&stop);
  {
    const InterruptionScope inner(&go_on);
    EXPECT_NO_THROW(ThrowIfInterrupted());
    const InterruptionScope of_the_same(nullptr);
    EXPECT_NO_THROW(ThrowIfInterrupted());
  }
  const InterruptionScope of_the_outer(nullptr);
  EXPECT_THROW(ThrowIfInterrupted(), Interrupted);
}

// All wait until several threads are at it, or one has waited in vain.
TEST(Interruption, ReachesTheThreadsOfAParallelFor) {
  constexpr int kThreads = 3;
  const std::atomic<bool> stop{true};
  const InterruptionScope scope(&stop);
  std::atomic<int> begun{0};
  std::atomic<int> missed{0};
  ParallelFor(kThreads, kThreads, [&](int /*i*/) {
    ++begun;
    for (int tries = 0; begun < kThreads && tries < 1000; ++tries) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    try {
      ThrowIfInterrupted();
      ++missed;
    } catch (const Interrupted&) {
    }
  });
  EXPECT_EQ(begun, kThreads);
  EXPECT_EQ(missed, 0);
}

TEST(Interruption, BreaksRefinementAndFactorisationOff) {
  const MatrixXd design = errmap::testing::RandomMatrix(300, 5, 1);
  const VectorXd response = design.col(0);
  const std::atomic<bool> stop{true};
  const InterruptionScope scope(&stop);
  constexpr double kMostDigits = 15.0;
  EXPECT_THROW(
      SolveLeastSquares(design, response, VectorXd(), {.digits = kMostDigits}),
      Interrupted);
  MatrixXd triangle = MatrixXd::Zero(700, 700);
  MatrixXd block = errmap::testing::RandomMatrix(2000, 700, 1);
  EXPECT_THROW(FoldIntoTriangle(&triangle, block), Interrupted);
}

// In pieces where it lasts, and at once where it does not: the same triangle.
TEST(Interruption, LeavesAFactorisationInPiecesTheSame) {
  const MatrixXd all = errmap::testing::RandomMatrix(2000, 700, 1);
  MatrixXd at_once = MatrixXd::Zero(700, 700);
  for (Eigen::Index first = 0; first < all.rows(); first += 500) {
    MatrixXd block = all.middleRows(first, 500);
    FoldIntoTriangle(&at_once, block);
  }
  MatrixXd in_pieces = MatrixXd::Zero(700, 700);
  MatrixXd block = all;
  FoldIntoTriangle(&in_pieces, block);
  // Up to signs of rows, which are those of the first column folded.
  const MatrixXd products = all.transpose() * all;
  constexpr double kRoundings = 1e-13;
  for (const MatrixXd* triangle : {&at_once, &in_pieces}) {
    const MatrixXd r = triangle->triangularView<Eigen::Upper>();
    EXPECT_LE((r.transpose() * r - products).norm(),
              kRoundings * products.norm());
  }
}

}  // namespace
}  // namespace errmap::fitting
