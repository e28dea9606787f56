#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "fitting/minimisers/objective.h"

namespace errmap::testing {

/// r (m) of a function and, unless null, J (m x n), both of the right size.
using ResidualCode = std::function<void(
    const Eigen::VectorXd&, Eigen::VectorXd*, Eigen::MatrixXd*)>;

/// An objective in residual form from a function.
class ResidualObjective final : public fitting::Objective,
                                public fitting::ResidualFunction {
 public:
  ResidualObjective(Eigen::Index m, Eigen::Index n, ResidualCode code)
      : m_(m), n_(n), code_(std::move(code)) {}

  Eigen::Index num_parameters() const override { return n_; }
  Eigen::Index num_residuals() const override { return m_; }
  double ridge() const override { return ridge_; }
  void SetRidge(double ridge) { ridge_ = ridge; }
  const fitting::ResidualFunction* residuals() const override { return this; }

  double Evaluate(const Eigen::VectorXd& x,
                  Eigen::VectorXd* gradient) const override {
    Eigen::VectorXd r(m_);
    if (gradient == nullptr) {
      Evaluate(x, &r, nullptr);
    } else {
      Eigen::MatrixXd jacobian(m_, n_);
      Evaluate(x, &r, &jacobian);
      *gradient = jacobian.transpose() * r + ridge_ * x;
    }
    return 0.5 * r.squaredNorm() + 0.5 * ridge_ * x.squaredNorm();
  }

  void Evaluate(const Eigen::VectorXd& x,
                Eigen::VectorXd* residuals,
                Eigen::MatrixXd* jacobian) const override {
    ++(jacobian == nullptr ? values_ : jacobians_);
    residuals->resize(m_);
    if (jacobian != nullptr) jacobian->setZero(m_, n_);
    code_(x, residuals, jacobian);
  }

  std::int64_t values() const { return values_; }
  std::int64_t jacobians() const { return jacobians_; }

 private:
  Eigen::Index m_;
  Eigen::Index n_;
  ResidualCode code_;
  double ridge_ = 0.0;
  mutable std::int64_t values_ = 0;
  mutable std::int64_t jacobians_ = 0;
};

/// A problem of More, Garbow & Hillstrom, ACM Trans. Math. Software 7 (1981)
/// 17-41, in its residuals, with 2 f at minima that may be reached.
struct ResidualProblem {
  std::string name;  // letters only: part of a test's name
  Eigen::Index m = 0;
  Eigen::VectorXd start;
  std::vector<double> least_squares;
  ResidualCode code;

  ResidualObjective Objective() const { return {m, start.size(), code}; }
};

inline void PrintTo(const ResidualProblem& problem, std::ostream* out) {
  *out << problem.name;
}

inline std::vector<ResidualProblem> AllResidualProblems() {
  using Eigen::MatrixXd;
  using Eigen::VectorXd;
  std::vector<ResidualProblem> all;
  all.push_back({"Rosenbrock",
                 2,
                 VectorXd{{-1.2, 1.0}},
                 {0.0},
                 [](const VectorXd& x, VectorXd* r, MatrixXd* j) {
                   *r << 10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0];
                   if (j != nullptr) *j << -20.0 * x[0], 10.0, -1.0, 0.0;
                 }});
  all.push_back({"FreudensteinRoth",
                 2,
                 VectorXd{{0.5, -2.0}},
                 {0.0, 48.98425367924},
                 [](const VectorXd& x, VectorXd* r, MatrixXd* j) {
                   const double y = x[1];
                   *r << -13.0 + x[0] + ((5.0 - y) * y - 2.0) * y,
                       -29.0 + x[0] + ((y + 1.0) * y - 14.0) * y;
                   if (j != nullptr) {
                     *j << 1.0, (10.0 - 3.0 * y) * y - 2.0, 1.0,
                         (3.0 * y + 2.0) * y - 14.0;
                   }
                 }});
  all.push_back({"Beale",
                 3,
                 VectorXd{{1.0, 1.0}},
                 {0.0},
                 [](const VectorXd& x, VectorXd* r, MatrixXd* j) {
                   const Eigen::Vector3d y(1.5, 2.25, 2.625);
                   double power = 1.0;
                   for (int i = 0; i < 3; ++i) {
                     const double slope = (i + 1) * power;
                     power *= x[1];
                     (*r)[i] = y[i] - x[0] * (1.0 - power);
                     if (j != nullptr) {
                       j->row(i) << power - 1.0, x[0] * slope;
                     }
                   }
                 }});
  all.push_back({"Wood",
                 6,
                 VectorXd{{-3.0, -1.0, -3.0, -1.0}},
                 {0.0},
                 [](const VectorXd& x, VectorXd* r, MatrixXd* j) {
                   const double a = std::sqrt(90.0);
                   const double b = std::sqrt(10.0);
                   const double c = 1.0 / b;
                   *r << 10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0],
                       a * (x[3] - x[2] * x[2]), 1.0 - x[2],
                       b * (x[1] + x[3] - 2.0), c * (x[1] - x[3]);
                   if (j != nullptr) {
                     *j << -20.0 * x[0], 10.0, 0.0, 0.0,  //
                         -1.0, 0.0, 0.0, 0.0,             //
                         0.0, 0.0, -2.0 * a * x[2], a,    //
                         0.0, 0.0, -1.0, 0.0,             //
                         0.0, b, 0.0, b,                  //
                         0.0, c, 0.0, -c;
                   }
                 }});
  all.push_back({"PowellSingular",
                 4,
                 VectorXd{{3.0, -1.0, 0.0, 1.0}},
                 {0.0},
                 [](const VectorXd& x, VectorXd* r, MatrixXd* j) {
                   const double a = std::sqrt(5.0);
                   const double b = std::sqrt(10.0);
                   const double c = x[1] - 2.0 * x[2];
                   const double d = x[0] - x[3];
                   *r << x[0] + 10.0 * x[1], a * (x[2] - x[3]), c * c,
                       b * d * d;
                   if (j != nullptr) {
                     *j << 1.0, 10.0, 0.0, 0.0,        //
                         0.0, 0.0, a, -a,              //
                         0.0, 2.0 * c, -4.0 * c, 0.0,  //
                         2.0 * b * d, 0.0, 0.0, -2.0 * b * d;
                   }
                 }});
  // Problem 8, whose residuals do not vanish; three parameters.
  all.push_back({"Bard",
                 15,
                 VectorXd{{1.0, 1.0, 1.0}},
                 {8.214877306578963e-3},
                 [](const VectorXd& x, VectorXd* r, MatrixXd* j) {
                   constexpr double kY[] = {0.14,
                                            0.18,
                                            0.22,
                                            0.25,
                                            0.29,
                                            0.32,
                                            0.35,
                                            0.39,
                                            0.37,
                                            0.58,
                                            0.73,
                                            0.96,
                                            1.34,
                                            2.10,
                                            4.39};
                   for (int i = 0; i < 15; ++i) {
                     const double u = i + 1.0;
                     const double v = 15.0 - i;
                     const double w = std::min(u, v);
                     const double below = v * x[1] + w * x[2];
                     (*r)[i] = kY[i] - (x[0] + u / below);
                     if (j != nullptr) {
                       const double slope = u / (below * below);
                       j->row(i) << -1.0, slope * v, slope * w;
                     }
                   }
                 }});
  return all;
}

}  // namespace errmap::testing
