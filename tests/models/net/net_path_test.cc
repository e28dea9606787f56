#include "models/net/net_path.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "models/net/net_objective.h"
#include "tests/models/net/net_test_cases.h"
#include "tests/random_matrix.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using errmap::testing::ManyNets;
using errmap::testing::NetCase;
using errmap::testing::RandomMatrix;
using errmap::testing::RiddersCurvature;
using fitting::Path;
using fitting::VectorOf;

// Roundings of sums over patterns and of a number of steps on the way.
template <typename Scalar>
constexpr double kSameButRounding = 500.0 *
                                    std::numeric_limits<Scalar>::epsilon();

// What the path says at its point against the objective asked anew.
template <typename Scalar>
void ExpectAgrees(Path<Scalar>* path,
                  const fitting::BasicObjective<Scalar>& objective,
                  const VectorOf<Scalar>& w) {
  VectorOf<Scalar> gradient;
  const auto cost = static_cast<double>(objective.Evaluate(w, &gradient));
  EXPECT_NEAR(static_cast<double>(path->Value(Scalar(0))),
              cost,
              kSameButRounding<Scalar> * cost);
  const auto difference =
      static_cast<double>((path->Gradient() - gradient).norm());
  EXPECT_LE(difference,
            kSameButRounding<Scalar> *
                std::max(static_cast<double>(gradient.norm()), 1e-2));
}

class NetPathOfShape : public ::testing::TestWithParam<NetCase> {
 protected:
  template <typename Scalar>
  static void ExpectCurvature(double tolerance) {
    const VectorXd w = GetParam().Point();
    const VectorXd p = GetParam().Direction();
    const double expected =
        RiddersCurvature(GetParam().template Objective<double>(), w, p);
    const auto objective = GetParam().template Objective<Scalar>();
    const auto path = objective.NewPath(w.template cast<Scalar>());
    path->SetDirection(p.template cast<Scalar>());
    EXPECT_NEAR(static_cast<double>(path->Curvature()),
                expected,
                tolerance * std::abs(expected));
  }

  // Steps of many kinds, the gradient and the cost asked for at each.
  template <typename Scalar>
  static void ExpectStaysTrue() {
    constexpr int kSteps = 200;  // kept figures are renewed on the way
    const auto objective = GetParam().template Objective<Scalar>();
    VectorOf<Scalar> w = GetParam().Point().template cast<Scalar>();
    const auto path = objective.NewPath(w);
    for (int step = 1; step <= kSteps; ++step) {
      const VectorOf<Scalar> p =
          RandomMatrix(w.size(), 1, static_cast<std::uint64_t>(step) + 100)
              .template cast<Scalar>();
      path->SetDirection(p);
      const auto a = static_cast<Scalar>(step % 2 == 0 ? 0.05 : -0.05);
      if (step % 3 != 0) path->Value(a);              // else never asked
      if (step % 5 == 0) path->Value(Scalar(2) * a);  // and rejected
      if (step % 7 == 0) static_cast<void>(path->Curvature());
      path->Accept(a);
      w += a * p;
      if (step % 40 < 3) {
        SCOPED_TRACE("step " + std::to_string(step));
        ExpectAgrees<Scalar>(path.get(), objective, w);
      }
    }
  }
};

TEST_P(NetPathOfShape, CurvatureAgreesWithRiddersDerivatives) {
  ExpectCurvature<double>(1e-9);
}

TEST_P(NetPathOfShape, CurvatureAgreesWithRiddersInSinglePrecision) {
  ExpectCurvature<float>(1e-3);
}

TEST_P(NetPathOfShape, ValueAndGradientAreThoseOfTheObjective) {
  const auto objective = GetParam().Objective<double>();
  const VectorXd w = GetParam().Point();
  const VectorXd p = GetParam().Direction();
  const auto path = objective.NewPath(w);
  ExpectAgrees<double>(path.get(), objective, w);
  path->SetDirection(p);
  for (const double a : {0.0, 1e-3, -0.5, 3.0}) {
    const double expected = objective.Evaluate(w + a * p, nullptr);
    EXPECT_NEAR(path->Value(a), expected, kSameButRounding<double> * expected);
  }
  // Trials leave the point where it was.
  ExpectAgrees<double>(path.get(), objective, w);
}

TEST_P(NetPathOfShape, StaysTrueOverManySteps) { ExpectStaysTrue<double>(); }

TEST_P(NetPathOfShape, StaysTrueOverManyStepsInSinglePrecision) {
  ExpectStaysTrue<float>();
}

TEST_P(NetPathOfShape, AcceptsAnotherStepThanTheLastOneTried) {
  const auto objective = GetParam().Objective<double>();
  const VectorXd w = GetParam().Point();
  const VectorXd p = GetParam().Direction();
  const auto path = objective.NewPath(w);
  path->SetDirection(p);
  path->Value(0.25);
  path->Value(4.0);
  path->Accept(0.25);
  ExpectAgrees<double>(path.get(), objective, w + 0.25 * p);
  // The same direction serves from there too.
  const double further = objective.Evaluate(w + 2.25 * p, nullptr);
  EXPECT_NEAR(path->Value(2.0), further, kSameButRounding<double> * further);
  // Once more, a step that was not tried.
  path->Accept(-0.75);
  ExpectAgrees<double>(path.get(), objective, w - 0.5 * p);
  const double expected = RiddersCurvature(objective, w - 0.5 * p, p);
  EXPECT_NEAR(path->Curvature(), expected, 1e-9 * std::abs(expected));
}

TEST_P(NetPathOfShape, ComesBackFromATrialToTheSameBits) {
  const auto objective = GetParam().Objective<double>();
  const auto path = objective.NewPath(GetParam().Point());
  path->SetDirection(GetParam().Direction());
  for (const double a : {0.5, -0.25}) {
    path->Accept(a);
    const VectorXd gradient = path->Gradient();
    const double cost = path->Value(0.0);
    const double curvature = path->Curvature();
    path->Value(2.0);
    EXPECT_EQ(path->Curvature(), curvature);
    path->Value(3.0);
    EXPECT_EQ(VectorXd(path->Gradient()), gradient);
    EXPECT_EQ(path->Value(0.0), cost);
  }
}

TEST_P(NetPathOfShape, IsTheSameTwice) {
  const auto objective = GetParam().Objective<double>();
  const auto walk = [&] {
    const auto path = objective.NewPath(GetParam().Point());
    path->SetDirection(GetParam().Direction());
    VectorXd figures(objective.num_parameters() + 2);
    figures[0] = path->Curvature();
    figures[1] = path->Value(0.5);
    path->Accept(0.5);
    figures.tail(objective.num_parameters()) = path->Gradient();
    return figures;
  };
  EXPECT_EQ(walk(), walk());
}

INSTANTIATE_TEST_SUITE_P(
    Shapes,
    NetPathOfShape,
    ::testing::ValuesIn(errmap::testing::WithFreeBiases(ManyNets())),
    [](const ::testing::TestParamInfo<NetCase>& instance) {
      return instance.param.Name();
    });

// A zero direction, as after rounding: nothing happens along it.
TEST(NetPath, HasNoCurvatureAlongNothing) {
  const NetCase net{{3, 4, 1}, 20};
  const auto objective = net.Objective<double>();
  const auto path = objective.NewPath(net.Point());
  path->SetDirection(VectorXd::Zero(objective.num_parameters()));
  EXPECT_EQ(path->Curvature(), 0.0);
  const double cost = path->Value(0.0);
  EXPECT_EQ(path->Value(5.0), cost);
}

TEST(NetPath, StaysFiniteFarOut) {
  const NetCase net{{3, 4, 2}, 20};
  const auto objective = net.Objective<double>();
  const auto path = objective.NewPath(net.Point());
  path->SetDirection(net.Direction());
  for (const double a : {1e3, -1e3, 1e100}) {
    EXPECT_TRUE(std::isfinite(path->Value(a))) << a;
  }
  path->Accept(1e3);
  EXPECT_TRUE(path->Gradient().allFinite());
  EXPECT_TRUE(std::isfinite(path->Curvature()));
}

// Of so many patterns nothing is kept; of each half it still is. The cost is a
// mean over patterns, so the whole is the mean of its halves.
template <typename Scalar>
void ExpectStreamingEqualsKeeping(Index rows) {
  const NetShape shape{2, 60, 2, OutputFunction::kSigmoid, 1.5};
  const MatrixXd inputs = RandomMatrix(rows, 2, 1);
  const MatrixXd targets = RandomMatrix(rows, 2, 2).cwiseAbs();
  const auto objective = [&](Index begin, Index count) {
    return BasicNetObjective<Scalar>(shape,
                                     inputs.middleRows(begin, count),
                                     targets.middleRows(begin, count),
                                     1e-2);
  };
  const auto whole_objective = objective(0, rows);
  const auto first_objective = objective(0, rows / 2);
  const auto second_objective = objective(rows / 2, rows / 2);
  const VectorOf<Scalar> w =
      RandomMatrix(shape.num_weights(), 1, 3).template cast<Scalar>();
  const VectorOf<Scalar> p =
      RandomMatrix(shape.num_weights(), 1, 4).template cast<Scalar>();
  const auto whole = whole_objective.NewPath(w);
  const auto first = first_objective.NewPath(w);
  const auto second = second_objective.NewPath(w);
  const auto all = {whole.get(), first.get(), second.get()};
  const auto expect_mean = [&](auto figure) {
    const auto mean = 0.5 * (static_cast<double>(figure(first.get())) +
                             static_cast<double>(figure(second.get())));
    EXPECT_NEAR(static_cast<double>(figure(whole.get())),
                mean,
                kSameButRounding<Scalar> * std::abs(mean));
  };
  const auto expect_mean_everywhere = [&] {
    expect_mean([](Path<Scalar>* path) { return path->Curvature(); });
    expect_mean([](Path<Scalar>* path) { return path->Value(Scalar(0.3)); });
    const VectorOf<Scalar> mean =
        Scalar(0.5) * (first->Gradient() + second->Gradient());
    EXPECT_LT(static_cast<double>((whole->Gradient() - mean).norm()),
              kSameButRounding<Scalar> * static_cast<double>(mean.norm()));
  };
  for (Path<Scalar>* path : all) path->SetDirection(p);
  expect_mean_everywhere();
  // The step tried last, another one, and one that was never tried.
  for (const double a : {0.3, -0.1, 0.2}) {
    for (Path<Scalar>* path : all) path->Accept(static_cast<Scalar>(a));
    expect_mean_everywhere();
  }
}

TEST(NetPath, GivesTheSameWhereItKeepsNothing) {
  ExpectStreamingEqualsKeeping<double>(20'000);  // 49 MiB, the halves 24
}

TEST(NetPath, GivesTheSameWhereItKeepsNothingInSinglePrecision) {
  ExpectStreamingEqualsKeeping<float>(40'000);
}

}  // namespace
}  // namespace errmap::models
