#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "fitting/minimisers/objective.h"

namespace errmap::testing {

/// An objective from a function: value at x, gradient (n) unless null.
class FunctionObjective final : public fitting::Objective {
 public:
  using Function =
      std::function<double(const Eigen::VectorXd&, Eigen::VectorXd*)>;

  FunctionObjective(Eigen::Index num_parameters, Function function)
      : num_parameters_(num_parameters), function_(std::move(function)) {}

  Eigen::Index num_parameters() const override { return num_parameters_; }
  double Evaluate(const Vector& x, Vector* gradient) const override {
    if (gradient != nullptr) gradient->resize(num_parameters_);
    return function_(x, gradient);
  }

 private:
  Eigen::Index num_parameters_;
  Function function_;
};

/// A problem that every optimizer is run on.
struct TestProblem {
  std::string name;  // letters only: part of a test's name
  std::shared_ptr<const fitting::Objective> objective;
  Eigen::VectorXd start;    // (n) the usual one
  Eigen::VectorXd minimum;  // (n) a minimiser
  double minimum_value = 0.0;
  /// The minimiser is alone and the Hessian there is regular: a small gradient
  /// means that x is near.
  bool regular = true;
};

inline void PrintTo(const TestProblem& problem, std::ostream* out) {
  *out << problem.name;
}

inline TestProblem MakeTestProblem(std::string name,
                                   Eigen::VectorXd start,
                                   Eigen::VectorXd minimum,
                                   FunctionObjective::Function function) {
  TestProblem problem;
  problem.name = std::move(name);
  problem.objective =
      std::make_shared<FunctionObjective>(start.size(), std::move(function));
  problem.start = std::move(start);
  problem.minimum = std::move(minimum);
  return problem;
}

/// More, Garbow & Hillstrom, ACM Trans. Math. Software 7 (1981) 17-41,
/// problem 1: a curved valley.
inline TestProblem Rosenbrock() {
  return MakeTestProblem(
      "Rosenbrock",
      Eigen::VectorXd{{-1.2, 1.0}},
      Eigen::VectorXd{{1.0, 1.0}},
      [](const Eigen::VectorXd& x, Eigen::VectorXd* gradient) {
        const double a = x[1] - x[0] * x[0];
        const double b = 1.0 - x[0];
        if (gradient != nullptr) {
          *gradient << -400.0 * a * x[0] - 2.0 * b, 200.0 * a;
        }
        return 100.0 * a * a + b * b;
      });
}

/// The same paper, problem 5: flat far out, a ravine along x1 = 0.
inline TestProblem Beale() {
  return MakeTestProblem(
      "Beale",
      Eigen::VectorXd{{1.0, 1.0}},
      Eigen::VectorXd{{3.0, 0.5}},
      [](const Eigen::VectorXd& x, Eigen::VectorXd* gradient) {
        const Eigen::Vector3d y(1.5, 2.25, 2.625);
        double value = 0.0;
        double power = 1.0;  // x2^(i - 1)
        if (gradient != nullptr) gradient->setZero();
        for (int i = 1; i <= 3; ++i) {
          const double slope = i * power;
          power *= x[1];
          const double residual = y[i - 1] - x[0] * (1.0 - power);
          value += residual * residual;
          if (gradient != nullptr) {
            (*gradient)[0] -= 2.0 * residual * (1.0 - power);
            (*gradient)[1] += 2.0 * residual * x[0] * slope;
          }
        }
        return value;
      });
}

/// The same paper, problem 14: two valleys, and a saddle that looks like a
/// minimum.
inline TestProblem Wood() {
  return MakeTestProblem(
      "Wood",
      Eigen::VectorXd{{-3.0, -1.0, -3.0, -1.0}},
      Eigen::VectorXd::Ones(4),
      [](const Eigen::VectorXd& x, Eigen::VectorXd* gradient) {
        const double a = x[1] - x[0] * x[0];
        const double b = 1.0 - x[0];
        const double c = x[3] - x[2] * x[2];
        const double d = 1.0 - x[2];
        const double e = x[1] + x[3] - 2.0;
        const double f = x[1] - x[3];
        if (gradient != nullptr) {
          *gradient << -400.0 * a * x[0] - 2.0 * b,
              200.0 * a + 20.0 * e + 0.2 * f, -360.0 * c * x[2] - 2.0 * d,
              180.0 * c + 20.0 * e - 0.2 * f;
        }
        return 100.0 * a * a + b * b + 90.0 * c * c + d * d + 10.0 * e * e +
               0.1 * f * f;
      });
}

/// The same paper, problem 13: the Hessian is singular at the minimum.
inline TestProblem PowellSingular() {
  TestProblem problem =
      MakeTestProblem("PowellSingular",
                      Eigen::VectorXd{{3.0, -1.0, 0.0, 1.0}},
                      Eigen::VectorXd::Zero(4),
                      [](const Eigen::VectorXd& x, Eigen::VectorXd* gradient) {
                        const double a = x[0] + 10.0 * x[1];
                        const double b = x[2] - x[3];
                        const double c = x[1] - 2.0 * x[2];
                        const double d = x[0] - x[3];
                        const double c3 = c * c * c;
                        const double d3 = d * d * d;
                        if (gradient != nullptr) {
                          *gradient << 2.0 * a + 40.0 * d3, 20.0 * a + 4.0 * c3,
                              10.0 * b - 8.0 * c3, -10.0 * b - 40.0 * d3;
                        }
                        return a * a + 5.0 * b * b + c3 * c + 10.0 * d3 * d;
                      });
  problem.regular = false;
  return problem;
}

/// 1/2 (x - c)'H(x - c): eigenvalues 1 to 1e6, axes mirrored so that no
/// coordinate is an eigenvector.
inline TestProblem IllConditionedQuadratic() {
  constexpr Eigen::Index kSize = 7;
  constexpr double kLogCondition = 6.0;
  Eigen::VectorXd eigenvalues(kSize);
  Eigen::VectorXd centre(kSize);
  Eigen::VectorXd mirror(kSize);
  for (Eigen::Index i = 0; i < kSize; ++i) {
    const double share = static_cast<double>(i) / (kSize - 1);
    eigenvalues[i] = std::pow(10.0, kLogCondition * share);
    centre[i] = (i % 2 == 0 ? 1.0 : -1.0) * (1.0 + share);
    mirror[i] = 1.0 + share;
  }
  mirror.normalize();
  const Eigen::MatrixXd reflection = Eigen::MatrixXd::Identity(kSize, kSize) -
                                     2.0 * mirror * mirror.transpose();
  const Eigen::MatrixXd hessian =
      reflection * eigenvalues.asDiagonal() * reflection;
  return MakeTestProblem(
      "IllConditionedQuadratic",
      Eigen::VectorXd::Zero(kSize),
      centre,
      [hessian, centre](const Eigen::VectorXd& x, Eigen::VectorXd* gradient) {
        const Eigen::VectorXd offset = x - centre;
        const Eigen::VectorXd slope = hessian * offset;
        if (gradient != nullptr) *gradient = slope;
        return 0.5 * offset.dot(slope);
      });
}

/// x1 - ln x1 + (x2 - 2)^2 - 1: NaN, gradient too, where x1 <= 0. The first
/// steps from the start are long enough to get there.
inline TestProblem NotANumberOutside() {
  return MakeTestProblem(
      "NotANumberOutside",
      Eigen::VectorXd{{4.0, -30.0}},
      Eigen::VectorXd{{1.0, 2.0}},
      [](const Eigen::VectorXd& x, Eigen::VectorXd* gradient) {
        constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
        if (!(x[0] > 0.0)) {
          if (gradient != nullptr) gradient->setConstant(kNaN);
          return kNaN;
        }
        const double offset = x[1] - 2.0;
        if (gradient != nullptr) *gradient << 1.0 - 1.0 / x[0], 2.0 * offset;
        return x[0] - std::log(x[0]) + offset * offset - 1.0;
      });
}

/// (max(0, |x|^2 - 1))^2 from inside the unit circle: the start is a minimum,
/// its gradient and Hessian are exactly zero.
inline TestProblem FlatFloor() {
  TestProblem problem = MakeTestProblem(
      "FlatFloor",
      Eigen::VectorXd{{0.5, -0.25}},
      Eigen::VectorXd{{0.5, -0.25}},
      [](const Eigen::VectorXd& x, Eigen::VectorXd* gradient) {
        const double rise = std::max(0.0, x.squaredNorm() - 1.0);
        if (gradient != nullptr) *gradient = 4.0 * rise * x;
        return rise * rise;
      });
  problem.regular = false;
  return problem;
}

inline std::vector<TestProblem> AllTestProblems() {
  return {Rosenbrock(),
          IllConditionedQuadratic(),
          Beale(),
          Wood(),
          PowellSingular(),
          NotANumberOutside(),
          FlatFloor()};
}

}  // namespace errmap::testing
