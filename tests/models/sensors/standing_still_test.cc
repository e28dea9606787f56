#include "models/sensors/standing_still.h"

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "stats/random.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Thermometers that warm up by 10 K together, a row each 10 s, in steps.
MatrixXd WarmUp(const std::vector<double>& steps, double noise) {
  constexpr Index kRows = 400;
  stats::Random random(3);
  MatrixXd values(kRows, static_cast<Index>(steps.size()));
  for (Index row = 0; row < kRows; ++row) {
    const double warm =
        20.0 + 10.0 * (1.0 - std::exp(-static_cast<double>(row) / 100.0));
    for (Index i = 0; i < values.cols(); ++i) {
      const double step = steps[static_cast<std::size_t>(i)];
      const double read = warm + noise * (2.0 * random.Uniform() - 1.0);
      values(row, i) = std::round(read / step) * step;
    }
  }
  return values;
}

StandingStill Learn(const MatrixXd& values, const char* symbol = "degC") {
  auto log = std::make_shared<data::SessionLog>();
  log->sessions = {"", {"1"}, std::vector<Index>(values.rows(), 0)};
  log->first_rows = {0};
  log->time = VectorXd::LinSpaced(
      values.rows(), 0.0, 10.0 * static_cast<double>(values.rows() - 1));
  log->time_unit = "s";
  data::Dataset::Parts parts;
  std::vector<Index> columns;
  for (Index i = 0; i < values.cols(); ++i) {
    parts.inputs.push_back(
        {"t" + std::to_string(i), data::UnitOfSymbol(symbol)});
    columns.push_back(i);
  }
  parts.input_values = values;
  parts.target_values = VectorXd::Zero(values.rows());
  parts.log = log;
  for (Index row = 0; row < values.rows(); ++row) parts.log_rows.push_back(row);
  return LearnStandingStill(data::Dataset(std::move(parts)), columns);
}

TEST(StandingStill, GivesASensorOfCoarseStepsFiveOfThem) {
  EXPECT_TRUE(
      (Learn(WarmUp({0.01, 0.01}, 0.0)).others_move.array() == 0.05).all());
  const StandingStill learnt = Learn(WarmUp({0.01, 0.01, 1.0}, 0.0));
  EXPECT_GE(learnt.others_move[2], 0.5);
  EXPECT_LT(learnt.others_move[2], 1.0);
}

TEST(StandingStill, WatchesThermometersAlone) {
  EXPECT_GT(Learn(WarmUp({0.01}, 0.0)).others_move[0], 0.0);
  EXPECT_TRUE(
      (Learn(WarmUp({0.01, 0.01}, 0.0), "mm").others_move.array() == 0.0)
          .all());
}

TEST(StandingStill, GoesByTheNoiseOfThoseAloneThatHaveSome) {
  const StandingStill learnt = Learn(WarmUp({0.01, 0.01, 2.0}, 0.05));
  EXPECT_GE(learnt.quiet[0], 100.0);
  EXPECT_LE(learnt.quiet[0], 300.0);
  EXPECT_EQ(learnt.quiet[2], 0.0);
  EXPECT_TRUE((Learn(WarmUp({0.01, 0.01}, 0.0)).quiet.array() == 0.0).all());
}

// A row warms by 0.1 K at first and by less than the noise after half an hour,
// from when on a sensor turns every few rows; without noise it never does.
TEST(StandingStill, ExpectsSilenceForAsLongAsNoiseLetsIt) {
  const double noisy = Learn(WarmUp({0.01, 0.01, 0.01}, 0.05)).silence;
  EXPECT_GE(noisy, 100.0);
  EXPECT_LE(noisy, 600.0);
  EXPECT_LE(Learn(WarmUp({0.01}, 0.05)).silence, 3600.0);
  EXPECT_GE(Learn(WarmUp({0.01, 0.01, 0.01}, 0.0)).silence, 3.0 * 3990.0);
}

// Of 10 K: the first row warms by 0.1 K, twice that in 10 s is allowed.
TEST(StandingStill, LearnsHowFastASensorChanges) {
  const StandingStill still = Learn(WarmUp({0.01, 1.0}, 0.0));
  EXPECT_DOUBLE_EQ(still.jump[0], 0.05);
  EXPECT_NEAR(still.pace[0], 0.002, 2e-4);
  // One of coarse steps changes by one of them at least.
  EXPECT_GE(still.jump[1], 0.5);
}

}  // namespace
}  // namespace errmap::models
