#include "models/kinematics/volumetric.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stats/random.h"
#include "tests/models/kinematics/lathe_chain.h"
#include "tests/numbers.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// Poses over the work volume, and errors of some micrometres and microradians
// with half-widths of a fifth of them.
struct Case {
  KinematicChain chain = tests::LatheChain();
  MatrixXd coordinates;
  std::vector<ComponentAtPoints> components;

  explicit Case(Index points = 5) : coordinates(points, 2) {
    stats::Random random(1);
    for (Index row = 0; row < points; ++row) {
      coordinates(row, 0) = -400.0 * random.Uniform();
      coordinates(row, 1) = -200.0 * random.Uniform();
    }
    for (const auto& place : chain.errors()) {
      const double size = IsRotation(place.direction) ? 2e-5 : 5e-3;
      ComponentAtPoints component{VectorXd(points), VectorXd(points)};
      for (Index row = 0; row < points; ++row) {
        component.values[row] = size * (2.0 * random.Uniform() - 1.0);
        component.half_widths[row] = 0.2 * size;
      }
      components.push_back(component);
    }
  }

  VolumetricErrors Combine(const VolumetricOptions& options = {}) const {
    return CombineErrors(chain, coordinates, components, options);
  }
};

TEST(CombineErrors, GivesWhatTheChainGivesPointByPoint) {
  constexpr double kFewUlps = 1e-15;
  const Case c;
  const VolumetricErrors combined = c.Combine();
  for (Index row = 0; row < 5; ++row) {
    VectorXd errors(c.chain.num_errors());
    for (Index k = 0; k < errors.size(); ++k) {
      errors[k] = c.components[static_cast<std::size_t>(k)].values[row];
    }
    const VectorXd pose = c.coordinates.row(row);
    const Vector3d exact = c.chain.ExactError(pose, errors);
    const Vector3d first_order = c.chain.Sensitivities(pose) * errors;
    // Processors that fuse a product and a sum round once less in one of them.
    EXPECT_LE((combined.exact.row(row).transpose() - exact).norm(),
              kFewUlps * exact.norm());
    EXPECT_LE((combined.first_order.row(row).transpose() - first_order).norm(),
              kFewUlps * first_order.norm());
  }
  const double difference =
      (combined.exact - combined.first_order).rowwise().norm().maxCoeff();
  EXPECT_GT(difference, 0.0);
  EXPECT_LT(difference, 1e-5);
}

TEST(CombineErrors, ContributionsAddUpToTheFirstOrder) {
  const VolumetricErrors combined = Case().Combine();
  Eigen::MatrixX3d sum = Eigen::MatrixX3d::Zero(5, 3);
  for (const auto& part : combined.contributions) sum += part;
  EXPECT_LT((sum - combined.first_order).cwiseAbs().maxCoeff(), 1e-15);
}

// Two ways to the same interval: the exact form drawn, and the root of the sum
// of squares.
TEST(CombineErrors, DrawsAgreeWithTheFirstOrderUncertainty) {
  const VolumetricErrors combined = Case().Combine({.draws = 20000});
  for (Index row = 0; row < 5; ++row) {
    for (Index d = 0; d < 3; ++d) {
      const double half = combined.half_widths(row, d);
      EXPECT_GT(half, 0.0);
      // A 5 % quantile of 20000 normal draws is good to 0.9 % of a half-width.
      EXPECT_NEAR(
          combined.upper(row, d) - combined.exact(row, d), half, 0.04 * half);
      EXPECT_NEAR(
          combined.exact(row, d) - combined.lower(row, d), half, 0.04 * half);
    }
  }
}

TEST(CombineErrors, OneUncertainComponentKeepsItsHalfWidthTimesItsArm) {
  Case c(1);
  for (ComponentAtPoints& component : c.components) {
    component.half_widths.setZero();
  }
  c.components[3].half_widths[0] = 3e-6;  // EBZ: 386 + x above, -120 along Z
  const VolumetricErrors combined = c.Combine({.draws = 0});
  EXPECT_NEAR(combined.half_widths(0, 0), 3e-6 * 120.0, 1e-15);
  EXPECT_EQ(combined.half_widths(0, 1), 0.0);
  EXPECT_NEAR(
      combined.half_widths(0, 2), 3e-6 * (386.0 + c.coordinates(0, 1)), 1e-15);
}

// Component 3 turns the tool, 7 too: along X both by the same arm, 120 mm.
// Degrees of freedom of the sum by hand (JCGM 100:2008, G.4.1).
TEST(CombineErrors, FewDegreesOfFreedomWidenASumLessThanItsParts) {
  Case c(1);
  for (ComponentAtPoints& component : c.components) {
    component.half_widths.setZero();
  }
  constexpr double kT4 = 2.1318467863;  // t of 4 degrees of freedom, 0.95
  constexpr double kT8 = 1.8595480375;  // of 8
  for (const std::size_t k : {std::size_t{3}, std::size_t{7}}) {
    c.components[k].half_widths[0] = kT4 * 1e-6;
    c.components[k].degrees_of_freedom = 4.0;
  }
  const double half = c.Combine({.draws = 0}).half_widths(0, 0);
  EXPECT_NEAR(half, kT8 * std::sqrt(2.0) * 1e-6 * 120.0, 1e-12);
  c.components[7].half_widths[0] = 0.0;
  EXPECT_NEAR(
      c.Combine({.draws = 0}).half_widths(0, 0), kT4 * 1e-6 * 120.0, 1e-12);
}

// One component of few degrees of freedom: the draws are its Student's t.
TEST(CombineErrors, DrawsHaveTheTailsOfFewDegreesOfFreedom) {
  Case c(1);
  for (ComponentAtPoints& component : c.components) {
    component.half_widths.setZero();
  }
  c.components[3].half_widths[0] = 3e-6;
  c.components[3].degrees_of_freedom = 3.0;
  const VolumetricErrors combined = c.Combine({.draws = 20000});
  const double half = combined.half_widths(0, 0);
  EXPECT_NEAR(half, 3e-6 * 120.0, 1e-12);
  EXPECT_NEAR(combined.upper(0, 0) - combined.exact(0, 0), half, 0.05 * half);
}

TEST(CombineErrors, WhatIsNotKnownMakesUnknownWhereItMatters) {
  Case c(1);
  c.components[1].half_widths[0] = kNaN;  // EZZ moves along Z alone
  const VolumetricErrors combined = c.Combine();
  EXPECT_TRUE(std::isnan(combined.half_widths(0, 2)));
  EXPECT_TRUE(std::isnan(combined.lower(0, 2)));
  EXPECT_TRUE(std::isnan(combined.upper(0, 2)));
  EXPECT_GT(combined.half_widths(0, 0), 0.0);
  EXPECT_LT(combined.lower(0, 0), combined.upper(0, 0));
}

TEST(CombineErrors, SameSeedSameBoundsAndNoneWithoutDraws) {
  const Case c;
  EXPECT_EQ(c.Combine({.seed = 7}).lower, c.Combine({.seed = 7}).lower);
  EXPECT_NE(c.Combine({.seed = 7}).lower, c.Combine({.seed = 8}).lower);
  EXPECT_TRUE(c.Combine({.draws = 0}).lower.array().isNaN().all());
  // A point's bounds do not depend on those after it.
  Case one(5);
  one.coordinates.conservativeResize(1, 2);
  for (ComponentAtPoints& component : one.components) {
    component.values.conservativeResize(1);
    component.half_widths.conservativeResize(1);
  }
  EXPECT_EQ(one.Combine().upper.row(0), c.Combine().upper.row(0));
}

TEST(CombineErrors, RefusesShapesThatDoNotAgree) {
  const auto expect = [](const Case& c, const char* says) {
    EXPECT_THAT([&] { c.Combine(); },
                ThrowsMessage<std::invalid_argument>(HasSubstr(says)));
  };
  Case columns;
  columns.coordinates.conservativeResize(5, 3);
  expect(columns, "3 columns of coordinates, expected 2");
  Case fewer;
  fewer.components.pop_back();
  expect(fewer, "12 components, expected 13");
  Case rows;
  rows.components[2].half_widths.conservativeResize(4);
  expect(rows, "4 half-widths of a component, expected 5");
}

TEST(VolumetricOptions, DefaultsPassAndEachBoundBites) {
  VolumetricOptions().Validate();
  for (const VolumetricOptions& options :
       {VolumetricOptions{.coverage = 0.0},
        VolumetricOptions{.coverage = 1.0},
        VolumetricOptions{.draws = -1},
        VolumetricOptions{.draws = 2'000'000}}) {
    EXPECT_THROW(options.Validate(), std::invalid_argument);
  }
}

}  // namespace
}  // namespace errmap::models
