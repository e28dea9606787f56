// What a path along a direction claims is checked by the objective itself.

#include <cstdint>
#include <memory>

#include <gtest/gtest.h>

#include "fitting/minimisers/scaled_conjugate_gradient.h"

namespace errmap::fitting {
namespace {

// A quadratic whose path tells of a share of its gradient or cost.
class LyingPathObjective final : public Objective {
 public:
  LyingPathObjective(double gradient_share, double cost_share)
      : gradient_share_(gradient_share), cost_share_(cost_share) {}

  Eigen::Index num_parameters() const override { return 3; }
  double Evaluate(const Vector& x, Vector* gradient) const override {
    if (gradient != nullptr) *gradient = scales_.cwiseProduct(x);
    return 0.5 * x.dot(scales_.cwiseProduct(x));
  }
  std::unique_ptr<Path<double>> NewPath(const Vector& x) const override {
    return std::make_unique<LyingPath>(*this, x);
  }

 private:
  class LyingPath final : public Path<double> {
   public:
    LyingPath(const LyingPathObjective& owner, const Vector& x)
        : owner_(owner), x_(x) {}
    void SetDirection(const Vector& p) override { p_ = p; }
    double Curvature() override {
      return p_.dot(owner_.scales_.cwiseProduct(p_));
    }
    double Value(double a) override {
      return owner_.cost_share_ * owner_.Evaluate(x_ + a * p_, nullptr);
    }
    void Accept(double a) override { x_ += a * p_; }
    const Vector& Gradient() override {
      owner_.Evaluate(x_, &gradient_);
      gradient_ *= owner_.gradient_share_;
      return gradient_;
    }

   private:
    const LyingPathObjective& owner_;
    Vector x_;
    Vector p_;
    Vector gradient_;
  };

  const Eigen::Vector3d scales_{1.0, 10.0, 100.0};
  double gradient_share_;
  double cost_share_;
};

TEST(ScgLyingPath, BelievesNoPathThatClaimsAMinimum) {
  constexpr double kGoal = 1e-3;
  const LyingPathObjective f(1e-9, 1.0);
  ScaledConjugateGradientOptions options;
  options.stopping.gradient_goal = kGoal;
  for (const std::int64_t iterations : {1, 2, 3}) {
    options.stopping.iterations = iterations;
    const Minimum early = ScaledConjugateGradient(options).Minimize(
        f, Eigen::Vector3d(1.0, 2.0, 3.0));
    EXPECT_EQ(early.summary.termination, Termination::kIterationLimit);
    Eigen::VectorXd gradient;
    EXPECT_EQ(early.summary.final_cost, f.Evaluate(early.x, &gradient));
    EXPECT_EQ(early.summary.final_gradient_norm, gradient.norm());
    EXPECT_GT(gradient.norm(), kGoal);
  }
  // From steepest descent each time it gets there all the same.
  options.stopping.iterations = 10'000;
  const Minimum minimum = ScaledConjugateGradient(options).Minimize(
      f, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(minimum.summary.termination, Termination::kGradient);
  EXPECT_LT(minimum.summary.final_gradient_norm, kGoal * 1.0);
}

TEST(ScgLyingPath, BelievesNoPathThatClaimsTheCostGoal) {
  const LyingPathObjective f(1.0, 1e-9);
  ScaledConjugateGradientOptions options;
  options.stopping.cost_goal = 1e-2;
  options.stopping.iterations = 1;
  const Minimum minimum = ScaledConjugateGradient(options).Minimize(
      f, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(minimum.summary.termination, Termination::kIterationLimit);
  EXPECT_EQ(minimum.summary.final_cost, f.Evaluate(minimum.x, nullptr));
  EXPECT_GT(minimum.summary.final_cost, 1e-4);
}

// Trials that fail renew the cost by the path; what is told at the end is the
// objective's own word all the same.
TEST(ScgLyingPath, TellsTheObjectivesCostAfterTrialsThatFailed) {
  const LyingPathObjective f(1.0, 1e6);
  const Eigen::VectorXd start = Eigen::Vector3d(1.0, 2.0, 3.0);
  for (std::int64_t evaluations = 1; evaluations <= 30; ++evaluations) {
    ScaledConjugateGradientOptions options;
    options.stopping.evaluations = evaluations;
    const Minimum minimum = ScaledConjugateGradient(options).Minimize(f, start);
    Eigen::VectorXd gradient;
    EXPECT_EQ(minimum.summary.final_cost, f.Evaluate(minimum.x, &gradient))
        << evaluations;
    EXPECT_EQ(minimum.summary.final_gradient_norm, gradient.norm());
    EXPECT_LE(minimum.summary.evaluations(), evaluations);
  }
}

}  // namespace
}  // namespace errmap::fitting
