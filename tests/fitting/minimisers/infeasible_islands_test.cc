// Islands where cost or gradient is not finite, of which descent keeps clear.

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include "fitting/minimisers/scaled_conjugate_gradient.h"
#include "stats/random.h"
#include "tests/numbers.h"
#include "tests/random_matrix.h"

namespace errmap::fitting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using errmap::testing::RandomMatrix;

enum class Fault { kNoCost, kInfiniteCost, kNoGradient, kOneSlopeInfinite };

// sum of s_i g(u_i) with u = Q'x, g even and rising with |u_i|, so that descent
// lowers every |u_i|. An island is a corner: the points with u_i beyond a_i, on
// one side of 0, in some of the coordinates. A short enough step down from
// outside never enters one, while long steps do, also to lower costs.
class Islands final : public Objective {
 public:
  explicit Islands(std::uint64_t seed) : random_(seed) {
    const auto n = static_cast<Index>(2 + random_.Below(7));
    turn_ = RandomMatrix(n, n, seed).householderQr().householderQ();
    scales_ = RandomMatrix(n, 1, seed + 1).unaryExpr([](double u) {
      return std::pow(10.0, 1.5 * u);
    });
    shape_ = random_.Below(3);
    fault_ = static_cast<Fault>(random_.Below(4));
    const auto corners = 1 + random_.Below(6);
    for (std::uint64_t k = 0; k < corners; ++k) {
      VectorXd corner = VectorXd::Zero(n);  // 0: free in this coordinate
      for (double& edge : corner) {
        const double size = 0.02 + 2.0 * random_.Uniform();
        if (random_.Below(2) == 0) edge = random_.Below(2) == 0 ? size : -size;
      }
      if (!corner.isZero()) corners_.push_back(corner);
    }
  }

  Index num_parameters() const override { return scales_.size(); }

  bool IsInIsland(const VectorXd& x) const {
    const VectorXd u = turn_.transpose() * x;
    for (const VectorXd& corner : corners_) {
      bool inside = true;
      for (Index i = 0; i < u.size(); ++i) {
        if (corner[i] > 0.0) inside = inside && u[i] > corner[i];
        if (corner[i] < 0.0) inside = inside && u[i] < corner[i];
      }
      if (inside) return true;
    }
    return false;
  }

  double Evaluate(const VectorXd& x, VectorXd* gradient) const override {
    const VectorXd u = turn_.transpose() * x;
    double cost = 0.0;
    VectorXd slope(u.size());
    for (Index i = 0; i < u.size(); ++i) {
      cost += scales_[i] * Height(u[i]);
      slope[i] = scales_[i] * Slope(u[i]);
    }
    if (gradient != nullptr) *gradient = turn_ * slope;
    if (!IsInIsland(x)) return cost;
    has_landed_ = true;
    switch (fault_) {
      case Fault::kNoCost:
        return kNaN;
      case Fault::kInfiniteCost:
        return kInfinity;
      case Fault::kNoGradient:
        if (gradient != nullptr) gradient->setConstant(kNaN);
        return cost;
      case Fault::kOneSlopeInfinite:
        if (gradient != nullptr) (*gradient)[0] = kInfinity;
        return cost;
    }
    return cost;
  }

  // Outside all islands, at a distance.
  VectorXd Start() {
    VectorXd start;
    do {
      start = VectorXd(num_parameters()).unaryExpr([&](double) {
        return 6.0 * random_.Uniform() - 3.0;
      });
    } while (IsInIsland(start));
    return start;
  }

  bool has_landed() const { return has_landed_; }

 private:
  double Height(double u) const {
    if (shape_ == 0) return 0.5 * u * u;
    if (shape_ == 1) return std::sqrt(1.0 + u * u) - 1.0;
    return std::cosh(u) - 1.0;
  }
  double Slope(double u) const {
    if (shape_ == 0) return u;
    if (shape_ == 1) return u / std::sqrt(1.0 + u * u);
    return std::sinh(u);
  }

  stats::Random random_;
  MatrixXd turn_;
  VectorXd scales_;
  std::uint64_t shape_ = 0;
  Fault fault_ = Fault::kNoCost;
  std::vector<VectorXd> corners_;
  mutable bool has_landed_ = false;
};

TEST(InfeasibleIslands, MollerComesToTheMinimumWhereverDescentGoesOn) {
  constexpr int kProblems = 200;  // each with a step into an island
  constexpr double kNear = 1e-5;
  int met = 0;
  for (std::uint64_t seed = 1; met < kProblems; ++seed) {
    ASSERT_LT(seed, 100U * kProblems);
    Islands islands(seed);
    const Minimum minimum =
        ScaledConjugateGradient(
            {.stopping = {.iterations = 20'000, .gradient_goal = 1e-9}})
            .Minimize(islands, islands.Start());
    if (!islands.has_landed()) continue;
    ++met;
    EXPECT_TRUE(minimum.summary.converged())
        << "seed " << seed << ": " << minimum.summary.message;
    EXPECT_LT(minimum.x.norm(), kNear) << "seed " << seed;
  }
}

// Steepest descent runs into a ring without gradient: up to its shore.
TEST(InfeasibleIslands, MollerComesToTheShoreWhereDescentEndsThere) {
  class Ring final : public Objective {
   public:
    Index num_parameters() const override { return 2; }
    double Evaluate(const VectorXd& x, VectorXd* gradient) const override {
      if (gradient != nullptr) {
        *gradient = x.norm() > 0.5 ? x : VectorXd::Constant(2, kNaN);
      }
      return 0.5 * x.squaredNorm();
    }
  };
  const Minimum minimum =
      ScaledConjugateGradient({}).Minimize(Ring(), VectorXd{{1.0, 2.0}});
  EXPECT_EQ(minimum.summary.termination, Termination::kNoDescent);
  EXPECT_NEAR(minimum.x.norm(), 0.5, 1e-6);
}

}  // namespace
}  // namespace errmap::fitting
