#include "fitting/parallel_for.h"

#include <atomic>
#include <stdexcept>
#include <vector>

#include <Eigen/Core>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace errmap::fitting {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

TEST(ParallelFor, DoesEachJobOnceWhateverTheThreads) {
  for (const int threads : {0, 1, 2, 7}) {
    for (const std::size_t count : {0U, 1U, 2U, 100U}) {
      std::vector<std::atomic<int>> done(count);
      ParallelFor(threads, count, [&](std::size_t i) { ++done[i]; });
      for (const std::atomic<int>& times : done) EXPECT_EQ(times, 1);
    }
  }
}

TEST(ParallelFor, GivesJobsTheTypeOfTheirCount) {
  std::vector<Eigen::Index> seen;
  ParallelFor(1, Eigen::Index{3}, [&](Eigen::Index i) { seen.push_back(i); });
  EXPECT_THAT(seen, ElementsAre(0, 1, 2));
}

// What begins is counted where it begins: none overtakes all those before it.
TEST(ParallelFor, BeginsJobsInTheirOrder) {
  constexpr std::size_t kThreads = 4;
  std::atomic<std::size_t> begun{0};
  std::vector<int> early(1000, 0);
  ParallelFor(static_cast<int>(kThreads), early.size(), [&](std::size_t i) {
    early[i] = begun++ + kThreads > i ? 0 : 1;
  });
  EXPECT_THAT(early, Each(0));
}

TEST(ParallelFor, ThrowsWhatWasThrownAndBeginsNoMore) {
  for (const int threads : {1, 3}) {
    std::atomic<int> begun{0};
    EXPECT_THROW(ParallelFor(threads,
                             1000000,
                             [&](int /*i*/) {
                               ++begun;
                               throw std::runtime_error("full");
                             }),
                 std::runtime_error);
    EXPECT_LE(begun, threads);
  }
}

TEST(ParallelFor, RunsInsideItself) {
  std::atomic<int> done{0};
  ParallelFor(
      3, 5, [&](int /*i*/) { ParallelFor(2, 7, [&](int /*j*/) { ++done; }); });
  EXPECT_EQ(done, 35);
}

}  // namespace
}  // namespace errmap::fitting
